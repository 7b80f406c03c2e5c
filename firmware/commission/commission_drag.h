/* SPDX-License-Identifier: MIT */
/**
 * @file commission_drag.h
 * @brief Turns a current vector slowly forward and backward: direction, counts of an electrical turn, pole pairs, offset.
 *
 * Friction holds the rotor behind the vector by as much backward as forward; cogging, unequal phases and swinging have no
 * mean over whole turns:
 *
 *     offset = mean of (vector angle - shaft angle), forward and backward alike         EQ-COMMISSION-9
 *
 * The vector is that of the measured current. The same turn shows what it pulls at, since v - R i = j w lambda in its
 * frame. With S = Lq - Ld and lambda_1 the flux along the vector,
 *
 *     x = lambda_1 - Ld I = flux where flux > S I, else S I                              EQ-COMMISSION-10
 *
 * because the rotor stands at the angle e from its d axis to the vector that solves (flux - S I cos e) sin e = 0: at e = 0 as
 * long as the magnet is the stronger one, else at cos e = flux / (S I). x well above S I is therefore the magnet's flux,
 * with the d axis at the vector; otherwise the current is reduced until it is, and when it never is, the q axis is at
 * the vector: a reluctance motor.
 */
#ifndef COMMISSION_DRAG_H
#define COMMISSION_DRAG_H

#include "commission_turns.h"
#include "commission_types.h"
#include "commission_vector.h"

typedef struct {
    commission_vector_t vector;
    commission_turns_t  sums[2]; /**< forward, backward */
    float               theta_rad;
    float               omega_radps;
    float               speed_radps; /**< largest */
    float               way_rad;     /**< since the part began */
    float               length_A;
    float               followed_A; /**< a current with which the rotor followed; 0: none yet */
    int32_t             ticks;
    int32_t             index_cnt; /**< position at the first index */
    int16_t             part;
    int16_t             turns; /**< in the measured parts */
    int16_t             indexes;
    bool                second; /**< pass: counts are known, the offset is wanted */
} commission_drag_t;

/** Context: control ISR. */
void commission_drag_start(commission_drag_t *d, const commission_config_t *c,
                           const commission_result_t *known);

/** One period. */
commission_answer_t commission_drag_tick(commission_drag_t *d, const commission_config_t *c,
                                         const commission_signal_t *s, commission_result_t *found);

#endif /* COMMISSION_DRAG_H */
