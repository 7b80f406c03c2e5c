/* SPDX-License-Identifier: MIT */
/**
 * @file commission_wave.h
 * @brief Square-wave voltage along one axis that moves the current between two limits.
 *
 * The inductance need not be known. The amplitude starts very small and grows with each half wave,
 * until three half waves in a row have few enough samples. The sign changes when the extrapolated current of the
 * sample after the next would exceed the limit:
 *
 *     |i_k + 2 (i_k - i_(k-1))| > I                                            EQ-COMMISSION-2
 *
 * The decision acts one period later. A sampled current therefore exceeds I by its noise at most.
 * The first half wave ends at 0.7 I, so that the torque of a q-axis current leaves no mean speed.
 */
#ifndef COMMISSION_WAVE_H
#define COMMISSION_WAVE_H

#include "base.h"

/** Chosen: samples of a half wave from limit to limit. With fewer, the step of two is noisy. */
#define COMMISSION_WAVE_SAMPLES 12

typedef struct {
    float   bound_A;
    float   first_A; /**< bound of the first half wave, then bound_A */
    float   v_V;     /**< present amplitude */
    float   most_V;
    float   sign;
    int16_t last;    /**< sample that ends a half wave at any current */
    int16_t samples; /**< of the present half wave */
    int16_t halves;  /**< since the amplitude was found */
    int16_t proofs;  /**< short half waves in a row */
    int16_t slips;   /**< short half waves that a long one followed */
    bool    lost;    /**< the current does not answer as it did */
    bool    found;
} commission_wave_t;

/**
 * @brief Starts with the smallest amplitude.
 *
 * @param last A half wave with so many samples ends, and the amplitude is searched again. A sensor
 *             that has died lets the current rise for so long.
 * @param most_V Largest amplitude; the dc link limits it too.
 *
 * Context: control ISR.
 */
void commission_wave_start(commission_wave_t *w, float bound_A, int16_t last, float most_V);

/** @return voltage for the next period. Context: control ISR. No division. */
float commission_wave_tick(commission_wave_t *w, float i_A, float di_A, float dc_link_V);

#endif /* COMMISSION_WAVE_H */
