/* SPDX-License-Identifier: MIT */
/**
 * @file pi_foc_tick.h
 * @brief Plain field-oriented control from the core's parts: the yardstick for the cost of a tick.
 *
 * i_d = 0, a PI for the speed, one PI per current axis with decoupling left out, back-calculated
 * anti-windup, space vector modulation. C and single precision, like the core, so that it runs wherever
 * the core runs.
 */
#ifndef PI_FOC_TICK_H
#define PI_FOC_TICK_H

#include "drive_tick.h"

typedef struct {
    float ts_s;
    float speed_p; /**< A per rad/s */
    float speed_i; /**< times Ts */
    float d_p;     /**< V per A */
    float d_i;     /**< times Ts */
    float q_p;
    float q_i;
    float current_max_A;
} pi_foc_gains_t;

typedef struct {
    pi_foc_gains_t gains;
    float          speed_sum_A;
    float          d_sum_V;
    float          q_sum_V;
} pi_foc_t;

/** The sums start at zero. */
void pi_foc_init(pi_foc_t *c, const pi_foc_gains_t *gains);

/** One control period; reads speed and angle of the sample. */
bridge_t pi_foc_tick(pi_foc_t *c, const drive_sample_t *sample, const drive_command_t *command);

#endif /* PI_FOC_TICK_H */
