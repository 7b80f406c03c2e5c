/* SPDX-License-Identifier: MIT */
/**
 * @file feedforward.h
 * @brief Voltages that cancel everything but the error dynamics: references, cross coupling, disturbances.
 *
 *     u_q = (l4 iq_ref + l5 w_d + iq_ref' + l10 w id - d_q) / l6            EQ-FEEDFORWARD-1, paper A (41), (42)
 *     u_d = (l7 id_ref + id_ref' - l9 w iq - d_d) / l8                      EQ-FEEDFORWARD-2
 *
 * These are the printed sums with their products collected (docs/equations.md).
 */
#ifndef FEEDFORWARD_H
#define FEEDFORWARD_H

#include "base.h"
#include "current_ref.h"
#include "motor.h"
#include "nodo.h"

/**
 * @param m           Reduced parameters.
 * @param ref         Current references and derivatives.
 * @param w_d_e_radps Speed reference, electrical.
 * @param y           Measured speed and currents.
 * @param est         Observer, for d_q and d_d.
 * @return            Voltage [V].
 *
 * Context: control ISR. Pure, no division.
 */
dq_t feedforward_V(const motor_reduced_t *m, const current_ref_t *ref, float w_d_e_radps,
                   const nodo_meas_t *y, const nodo_t *est);

/**
 * @brief q voltage that keeps the q current where it is at the present speed:
 *
 *     h_q = (l4 iq + l5 w + l10 w id - d_q) / l6                            EQ-FEEDFORWARD-3
 *
 * Mostly the back-EMF: a voltage limit has to cover this first.
 */
float feedforward_hold_q_V(const motor_reduced_t *m, const nodo_meas_t *y, float d_q);

#endif /* FEEDFORWARD_H */
