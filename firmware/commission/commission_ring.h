/* SPDX-License-Identifier: MIT */
/**
 * @file commission_ring.h
 * @brief Finds the resonance of an elastic shaft, its damping and the inertia behind it.
 *
 *     UP -> SEARCH -> LOOK_CLOSER -> STOP
 *
 * The shaft turns slowly, so that counts and dry friction do not hide a small oscillation. A torque
 * current oscillates at one frequency after another, 5 % apart, from 40 Hz to 600 Hz. A resonance
 * shows in the imaginary part of y (EQ-COMMISSION-18). Around the largest one, 13 frequencies 1.5 %
 * apart give the three values.
 *
 * One frequency at a time has all of the current. The amplitude follows the answer, so that the
 * coupling's torque and the speed's swing stay within their limits near a resonance. A chirp would
 * pass a resonance before its answer is known.
 */
#ifndef COMMISSION_RING_H
#define COMMISSION_RING_H

#include "commission_angle.h"
#include "commission_response.h"
#include "commission_types.h"

/** Answers of the blocks at one frequency. */
typedef struct {
    commission_phasor_t sum;
    float               squares; /**< of the lengths */
    int16_t             n;
} commission_ring_mean_t;

/** Sums and findings of the search. */
typedef struct {
    float   peak;    /**< largest significant imaginary part of y */
    float   peak_Hz; /**< 0: none */
    float   all;     /**< weighted real parts of y .. */
    float   all_w;   /**< .. and their weights */
    float   last;    /**< the same near the upper end */
    float   last_w;
    float   clear_Hz; /**< up to here, noise hid nothing */
    int16_t hidden;   /**< frequencies with too much noise, in a row */
} commission_ring_seen_t;

typedef struct {
    commission_angle_t     angle;
    commission_block_t     block;
    commission_ring_mean_t mean;
    commission_ring_seen_t seen;
    commission_ring_fit_t  fit;
    dq_t                   integral_V;
    int16_t                part;
    int16_t                step;   /**< frequency of the part */
    int16_t                blocks; /**< at this frequency */
    int32_t                ticks;  /**< since the part began */
    int32_t                last_cnt;
    float                  wanted_Hz;
    float                  swing_A; /**< amplitude of the oscillating current */
    float                  dc_A;    /**< current that keeps the speed */
    float                  held_A;  /**< its integral part */
    float                  slow_m_radps;
    bool                   rings; /**< failed: the oscillation does not stay within its limit */
} commission_ring_t;

/** Starts at any speed of the shaft. Context: control ISR. */
void commission_ring_start(commission_ring_t *r, const commission_config_t *c,
                           const commission_signal_t *s, const commission_result_t *known);

/** Executes one period. `found` gets the coupling with COMMISSION_DONE. Context: control ISR. */
commission_answer_t commission_ring_tick(commission_ring_t *r, const commission_config_t *c,
                                         const commission_signal_t *s, commission_result_t *found);

#endif /* COMMISSION_RING_H */
