/* SPDX-License-Identifier: MIT */
/**
 * @file torque_loop.h
 * @brief Command and gains of a torque run, and the speed limit that takes the torque away.
 *
 *     T = s T_rated within +-T_max,  T_max = J / np (l1 + l11 id_max) iq_max     EQ-TORQUE-1
 *     T J^-1 np within  k (-w_max - w) + l2 (-w_max) - d_w .. k (w_max - w) + l2 w_max - d_w,
 *     k = 0.8 (k_w / k_iq) (l1 + l11 id)                                         EQ-TORQUE-2
 *     u_fb = -(k_q e_iq, k_d e_id), within the limit with the speed law's k      EQ-TORQUE-3
 *     v:   u within the hexagon's corner, the d voltage first                    EQ-TORQUE-4
 *     e = i - (i_ref(k-1) - Ts (l6 (u_q - v_q), l8 (u_d - v_d))),
 *     within the limit e = i - i_ref                                             EQ-TORQUE-5
 *
 * (id_max, iq_max) is where the MTPA curve meets the current circle. EQ-TORQUE-2 is the torque that
 * the speed law has near the speed w_max. Its estimate of the load is the observer's, and nothing
 * is integrated: the limit takes over and gives back without a step.
 */
#ifndef TORQUE_LOOP_H
#define TORQUE_LOOP_H

#include "base.h"

/** Chosen: what per mille of the rated torque are in 16 bits. */
#define TORQUE_SHARE_MAX 33.0f

/** Chosen: the limit has this share of the speed law's gain, because its references have no
 * feed-forward. With all of it the 10 kHz drive that has learned 0.7 of its inertia is unstable
 * with half of that. With 0.8 it is as stable as the speed law. */
#define TORQUE_LIMIT_SHARE 0.8f

/** Torque command to a law. */
typedef struct {
    float share;             /**< of the rated torque, within +-TORQUE_SHARE_MAX */
    float speed_max_e_radps; /**< speed limit either way, electrical, 0 .. that of the drive */
} torque_command_t;

typedef struct {
    float iq_VpA;   /**< k_q, > 0 */
    float id_VpA;   /**< k_d, > 0 */
    float id_max_A; /**< d current of the largest torque [A], <= 0 */
} torque_gains_t;

/** State of a torque run. */
typedef struct {
    dq_t asked_V; /**< voltage for the references of the last period, before any limit */
} torque_loop_t;

/** true when every constant is in its documented range. Context: init. */
bool torque_loop_check(const torque_gains_t *g);

#endif /* TORQUE_LOOP_H */
