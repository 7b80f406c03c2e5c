/* SPDX-License-Identifier: MIT */
#include "feedforward.h"

float feedforward_hold_q_V(const motor_reduced_t *m, const nodo_meas_t *y, float d_q)
{
    const float w = y->omega_e_radps; /* EQ-FEEDFORWARD-3 */
    return m->inv_l6 * ((m->l4 * y->iq_A) + (m->l5 * w) + (m->l10 * w * y->id_A) - d_q);
}
