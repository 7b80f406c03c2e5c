/* SPDX-License-Identifier: MIT */
#include "feedforward.h"

dq_t feedforward_V(const motor_reduced_t *m, const current_ref_t *ref, float w_d_e_radps,
                   const nodo_meas_t *y, const nodo_t *est)
{
    const float w   = y->omega_e_radps;
    const dq_t  u_V = {/* EQ-FEEDFORWARD-1, EQ-FEEDFORWARD-2 */
                       .d = m->inv_l8 * ((m->l7 * ref->i_A.d) + ref->i_dot_Aps.d -
                                        (m->l9 * w * y->iq_A) - est->d_d),
                       .q = m->inv_l6 * ((m->l4 * ref->i_A.q) + (m->l5 * w_d_e_radps) +
                                        ref->i_dot_Aps.q + (m->l10 * w * y->id_A) - est->d_q)};
    return u_V;
}

float feedforward_hold_q_V(const motor_reduced_t *m, const nodo_meas_t *y, float d_q)
{
    const float w = y->omega_e_radps; /* EQ-FEEDFORWARD-3 */
    return m->inv_l6 * ((m->l4 * y->iq_A) + (m->l5 * w) + (m->l10 * w * y->id_A) - d_q);
}
