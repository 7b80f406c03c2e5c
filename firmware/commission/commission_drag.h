/* SPDX-License-Identifier: MIT */
/**
 * @file commission_drag.h
 * @brief Turns a current vector slowly forward and backward and observes the rotor.
 *
 * It finds direction, counts per electrical turn, pole pairs and offset. Friction makes the rotor
 * lag by the same angle in both directions. Cogging, unequal phases and oscillation average out
 * over whole turns:
 *
 *     offset = mean of (vector angle - shaft angle), forward and backward alike         EQ-COMMISSION-9
 *
 * The vector is the measured current. In its frame v - R i = j w lambda, so the same turn also
 * shows the flux. With S = Lq - Ld and lambda_1 the flux along the vector:
 *
 *     x = lambda_1 - Ld I = flux where flux > S I, else S I                              EQ-COMMISSION-10
 *
 * The rotor settles at the angle e between its d axis and the vector with
 *
 *     (flux - S I cos e) sin e = 0
 *
 * If the magnet dominates, e = 0 and the d axis is at the vector; else cos e = flux / (S I). A
 * value of x well above S I is therefore the magnet's flux. Otherwise the current is reduced. If x
 * never exceeds S I, the motor is a reluctance motor and its q axis is at the vector.
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
    float               followed_A; /**< current with which the rotor followed; 0: none yet */
    int32_t             ticks;
    int32_t             index_cnt; /**< position at the first index */
    int16_t             part;
    int16_t             turns; /**< electrical turns in the measured parts */
    int16_t             indexes;
    bool                second; /**< second pass: counts are known, the offset is measured */
} commission_drag_t;

/** Starts the first pass. Context: control ISR. */
void commission_drag_start(commission_drag_t *d, const commission_config_t *c,
                           const commission_result_t *known);

/** False when a current sensor or a phase cannot be right. Context: control ISR. */
bool commission_drag_follows(const commission_drag_t *d, const commission_config_t *c,
                             const commission_result_t *known);

/** Executes one period. `found` gets the results with COMMISSION_DONE. Context: control ISR. */
commission_answer_t commission_drag_tick(commission_drag_t *d, const commission_config_t *c,
                                         const commission_signal_t *s, commission_result_t *found);

#endif /* COMMISSION_DRAG_H */
