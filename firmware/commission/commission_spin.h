/* SPDX-License-Identifier: MIT */
/**
 * @file commission_spin.h
 * @brief Runs the motor with the encoder angle and measures flux, offset, inertia and friction.
 *
 * The current loops use the measured R and L. The motor accelerates with a known current and coasts
 * with zero current, in both directions, then again from a lower speed. While it coasts, the
 * voltage that keeps the current at zero is the back-EMF:
 *
 *     flux = sum(v_q w) / sum(w^2)                                             EQ-COMMISSION-12
 *     offset error = atan(sum(v_d w) / sum(v_q w)), mean of both directions     EQ-COMMISSION-13
 *
 * A delayed angle turns v by opposite angles in the two directions: the mean removes it. In a
 * reluctance motor the current is at 135 degrees, where the torque is largest.
 */
#ifndef COMMISSION_SPIN_H
#define COMMISSION_SPIN_H

#include "commission_angle.h"
#include "commission_emf.h"
#include "commission_motion.h"
#include "commission_types.h"

typedef struct {
    commission_angle_t  angle;
    commission_motion_t motion;
    commission_emf_t    emf[2]; /**< forward, backward */
    dq_t                integral_V;
    int16_t             part;
    int32_t             ticks; /**< since the part began */
    int32_t             start_cnt;
    int32_t             coast_ticks;
    int32_t             window_ticks; /**< while driven */
    float               current_A;
    float               top_radps;   /**< electrical */
    float               begun_radps; /**< speed at which the part began */
} commission_spin_t;

/** Starts with the rotor at rest. Context: control ISR. */
void commission_spin_start(commission_spin_t *p, const commission_config_t *c,
                           const commission_signal_t *s, const commission_result_t *known);

/** Executes one period. `found` gets the results with COMMISSION_DONE. Context: control ISR. */
commission_answer_t commission_spin_tick(commission_spin_t *p, const commission_config_t *c,
                                         const commission_signal_t *s, commission_result_t *found);

#endif /* COMMISSION_SPIN_H */
