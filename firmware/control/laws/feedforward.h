/* SPDX-License-Identifier: MIT */
/**
 * @file feedforward.h
 * @brief Voltages that cancel everything but the error dynamics: references, cross coupling,
 * disturbances.
 *
 *     u_q = (l4 iq_ref + l5 w_d + iq_ref' + l10 w id - d_q) / l6           EQ-FEEDFORWARD-1
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

/* Inline, as a law calls it twice if a voltage is out of reach. C++ includes it: it needs the
 * members in their order. */

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
static inline dq_t feedforward_V(const motor_reduced_t *m, const current_ref_t *ref,
                                 float w_d_e_radps, const nodo_meas_t *y, const nodo_t *est)
{
    const float w   = y->omega_e_radps;
    const dq_t  u_V = {
         /* EQ-FEEDFORWARD-2, EQ-FEEDFORWARD-1 */
        m->inv_l8 * ((m->l7 * ref->i_A.d) + ref->i_dot_Aps.d - (m->l9 * w * y->iq_A) - est->d_d),
        m->inv_l6 * ((m->l4 * ref->i_A.q) + (m->l5 * w_d_e_radps) + ref->i_dot_Aps.q +
                     (m->l10 * w * y->id_A) - est->d_q)};
    return u_V;
}

/**
 * @brief q voltage that keeps the q current where it is at the present speed:
 *
 *     h_q = (l4 iq + l5 w + l10 w id - d_q) / l6                            EQ-FEEDFORWARD-3
 *
 * It is mostly the back-EMF. The voltage limit must cover it first.
 */
float feedforward_hold_q_V(const motor_reduced_t *m, const nodo_meas_t *y, float d_q);

#endif /* FEEDFORWARD_H */
