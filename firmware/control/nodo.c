/* SPDX-License-Identifier: MIT */
#include "nodo.h"

enum { ROW_D_OMEGA, ROW_D_Q, ROW_D_D, ROW_OMEGA, ROW_IQ, ROW_ID };

void nodo_reset(nodo_t *x, const nodo_meas_t *y)
{
    x->d_omega       = 0.0f;
    x->d_q           = 0.0f;
    x->d_d           = 0.0f;
    x->omega_e_radps = y->omega_e_radps;
    x->iq_A          = y->iq_A;
    x->id_A          = y->id_A;
}

/* L(iq^) (y - C_d x^) of EQ-NODO-2 by Horner on the vectors L_n (y - C_d x^). */
static void correction(const nodo_gains_t *g, const nodo_t *x, const nodo_meas_t *y, float iq_A,
                       float out[NODO_N_X])
{
    const float r_omega = y->omega_e_radps - x->omega_e_radps;
    const float r_iq    = y->iq_A - x->iq_A;
    const float r_id    = y->id_A - x->id_A;

    for (int16_t row = 0; row < NODO_N_X; row++) {
        out[row] = 0.0f;
    }
    for (int16_t n = g->order; n >= 0; n--) {
        for (int16_t row = 0; row < NODO_N_X; row++) {
            const float *l = g->gain[n][row];
            out[row]       = (out[row] * iq_A) + ((l[0] * r_omega) + (l[1] * r_iq) + (l[2] * r_id));
        }
    }
}

void nodo_update(nodo_t *x, const nodo_gains_t *g, const motor_reduced_t *m, const nodo_meas_t *y,
                 dq_t v_V, float ts_s)
{
    /* Beyond the range in which the held gain is certified, the products of estimates would outrun it. */
    const float iq_s = base_clamp(x->iq_A, -g->iq_certified_A, g->iq_certified_A);
    float       lr[NODO_N_X];
    correction(g, x, y, base_clamp(x->iq_A, -g->iq_max_A, g->iq_max_A), lr);

    /* EQ-NODO-1: the rows of A_d(iq^) x^ + u_d. */
    const float w    = x->omega_e_radps;
    const float iq   = x->iq_A;
    const float id   = x->id_A;
    const float w_p  = (m->l1 * iq) - (m->l2 * w) + (m->l11 * iq_s * id) + x->d_omega;
    const float iq_p = (m->l6 * v_V.q) - (m->l4 * iq) - (m->l5 * w) -
                       (m->l10 * y->id_A * y->omega_e_radps) + x->d_q;
    const float id_p = (m->l8 * v_V.d) - (m->l7 * id) + (m->l9 * iq_s * w) + x->d_d;

    x->d_omega += ts_s * lr[ROW_D_OMEGA];
    x->d_q += ts_s * lr[ROW_D_Q];
    x->d_d += ts_s * lr[ROW_D_D];
    x->omega_e_radps = w + (ts_s * (w_p + lr[ROW_OMEGA]));
    x->iq_A          = iq + (ts_s * (iq_p + lr[ROW_IQ]));
    x->id_A          = id + (ts_s * (id_p + lr[ROW_ID]));
}
