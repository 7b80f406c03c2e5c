/* SPDX-License-Identifier: MIT */
/**
 * @file commission_response.h
 * @brief Answer of the shaft to a torque of one frequency, and the resonance that the answers show.
 *
 * Over a block of N periods with n whole oscillations, delta = 2 pi n / N and w = delta / Ts:
 *
 *     P = sum (theta_k - theta_k-1) e^(-j k delta)
 *
 *     Q = sum T_k e^(-j k delta)
 *
 *     J acceleration / torque = j J (w delta)^2 e^(j delta/2) P / ((2 sin(delta/2))^3 Q)
 *                                                                               EQ-COMMISSION-17
 *
 * One delta^2 over the squared sine is the straight line that the current follows between two
 * samples. With two masses, resonance w_r, damping ratio z and ratio mu of load to motor inertia
 *
 *     y = J acceleration / torque - 1 = -mu w^2 / (w_r^2 - w^2 + 2 j z w_r w)     EQ-COMMISSION-18
 *
 * The product of y and its denominator is linear in w_r^2, 2 z w_r and mu: least squares give them.
 */
#ifndef COMMISSION_RESPONSE_H
#define COMMISSION_RESPONSE_H

#include "commission_types.h"

typedef struct {
    float re;
    float im;
} commission_phasor_t;

/** Sums of one block. */
typedef struct {
    int32_t             samples; /**< N, of the block */
    int16_t             cycles;  /**< n */
    int32_t             at;      /**< periods of the block so far */
    int32_t             turned_cnt;
    commission_phasor_t way_cnt;   /**< P */
    commission_phasor_t torque_Nm; /**< Q */
} commission_block_t;

/** One block's answer. */
typedef struct {
    commission_phasor_t y;       /**< EQ-COMMISSION-18 */
    float               cnt;     /**< amplitude of the angle */
    float               j_Nm;    /**< amplitude of J times the acceleration of the motor */
    float               m_radps; /**< amplitude of the motor's speed */
} commission_response_t;

#define COMMISSION_RING_ANSWERS 13 /**< of a fit at most */

/** Answers for EQ-COMMISSION-18. */
typedef struct {
    float               at_Hz; /**< frequencies are ratios to this one */
    float               ratio[COMMISSION_RING_ANSWERS];
    commission_phasor_t y[COMMISSION_RING_ANSWERS];
    int16_t             n;
} commission_ring_fit_t;

/** Begins a block of two oscillations or more. @param hz frequency wanted, > 0, up to 0.2 / Ts.
 * @param least_s its duration at least. Context: control ISR. */
void commission_block_start(commission_block_t *b, float ts_s, float hz, float least_s);

/** Frequency of a block [Hz]: the wanted one within 1 % of it. */
float commission_block_Hz(const commission_block_t *b, float ts_s);

/** Cosine of the oscillation at the next sample. */
float commission_block_wave(const commission_block_t *b);

/** Adds a period: the count's step until this sample, and the torque at it. @return true: the
 * block is whole. Context: control ISR. */
bool commission_block_add(commission_block_t *b, int32_t step_cnt, float torque_Nm);

/** Answer of a whole block. Zero without a torque. @param rad_per_cnt mechanical, signed. */
commission_response_t commission_block_response(const commission_block_t  *b,
                                                const commission_config_t *c,
                                                const commission_result_t *known);

/** Begins a fit about a frequency [Hz], > 0. */
void commission_ring_fit_start(commission_ring_fit_t *f, float at_Hz);

/** Adds the answer y at a frequency [Hz]. One beyond COMMISSION_RING_ANSWERS is left out. */
void commission_ring_fit_add(commission_ring_fit_t *f, float hz, commission_phasor_t y);

/**
 * @brief Resonance, damping ratio and share of the load's inertia, each with twice its standard
 * deviation.
 *
 * An answer's weight is its length. The errors of all rows are then alike.
 *
 * @return false: the answers are not those of two masses. `found` is then untouched.
 */
bool commission_ring_fit_solve(const commission_ring_fit_t *f, commission_result_t *found);

#endif /* COMMISSION_RESPONSE_H */
