/* SPDX-License-Identifier: MIT */
/**
 * @file position_loop.h
 * @brief Near optimal control of the position: nosc.h with the angle error as a fourth state.
 *
 *     theta' = w,   e = (e_theta, e_w, e_iq, e_id)                          EQ-POSITION-2
 *     u_fb = -Lambda(e_iq) (e_w, e_iq, e_id) - (lambda_0 + lambda_1 e_iq ..) e_theta  EQ-POSITION-3
 *
 * The gains have their own design and differ from those of the speed controller. The angle has the
 * parity
 * of speed and iq. It acts on v_q with even powers of e_iq, and on v_d with odd powers. As in
 * EQ-NOSC-3,
 *
 *     e_w + (k_theta / k_w) e_theta                                         EQ-POSITION-4
 *
 * is the combined request of the errors, and it is limited as a whole.
 */
#ifndef POSITION_LOOP_H
#define POSITION_LOOP_H

#include "nosc.h"
#include "position_ref.h"

typedef struct {
    nosc_gains_t nosc;              /**< Lambda_n and its limits */
    float        theta[NOSC_TERMS]; /**< lambda_n: of v_q for an even n, of v_d for an odd one */
    float        speed_per_rad;     /**< k_theta / k_w of n = 0 [1/s], > 0 */
    float        near_rad;          /**< a reference further away waits for the shaft, (0, pi] */
    position_profile_t most;        /**< limits of every profile */
} position_gains_t;

/** Position command to a law: a target within a profile, or the motion itself. */
typedef struct {
    position_t         actual; /**< of the sample's angle */
    position_t         target;
    position_profile_t profile;
    position_motion_t  motion; /**< reference at the end of this period */
    bool               moves;  /**< true: the motion is the reference; target and profile are not */
} position_command_t;

/** true when every constant is in its documented range. Context: init. */
bool position_loop_check(const position_gains_t *g);

/**
 * @brief Part of EQ-POSITION-3 by the angle error.
 *
 * Context: control ISR. N + 1 multiply-adds.
 */
dq_t position_loop_V(const position_gains_t *g, float theta_error_e_rad, float iq_error_A);

#endif /* POSITION_LOOP_H */
