/* SPDX-License-Identifier: MIT */
/**
 * @file commission_wave.h
 * @brief A square wave of voltage along one axis that swings the current between two bounds, without knowing the inductance.
 *
 * It begins with a voltage so small that no motor notices, and grows from half wave to half wave until one has few enough
 * samples. The sign changes when the next sample but one would be beyond the bound:
 *
 *     |i_k + 2 (i_k - i_(k-1))| > I                                            EQ-COMMISSION-2
 *
 * because what is decided now acts one period later. The current of a sample then never exceeds I by more than its noise.
 * The first half wave turns at 0.7 I: so the torque of a current that goes through the q axis leaves no mean speed.
 */
#ifndef COMMISSION_WAVE_H
#define COMMISSION_WAVE_H

#include "base.h"

typedef struct {
    float   bound_A;
    float   first_A; /**< bound of the first half wave, then bound_A */
    float   v_V;     /**< present height */
    float   sign;
    int16_t samples; /**< of the present half wave */
    int16_t halves;  /**< since the height was found */
    bool    found;
} commission_wave_t;

/** Begin with the smallest height. Context: control ISR. */
void commission_wave_start(commission_wave_t *w, float bound_A);

/** Voltage for the next period. Context: control ISR. No division. */
float commission_wave_tick(commission_wave_t *w, float i_A, float di_A, float dc_link_V);

#endif /* COMMISSION_WAVE_H */
