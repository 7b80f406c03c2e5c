/* SPDX-License-Identifier: MIT */
#include "nodo_encoder.h"

#include "check.h"

enum { ROW_THETA = NODO_N_X };

void nodo_encoder_correct(nodo_t *x, float *theta_rad, const nodo_encoder_gains_t *g, dq_t i_A,
                          float angle_error, float ts_s)
{
    const float iq_A                = base_clamp(x->iq_A, -g->iq_max_A, g->iq_max_A);
    float       r[NODO_ENCODER_N_Y] = {ts_s * (i_A.q - x->iq_A), ts_s * (i_A.d - x->id_A),
                                       ts_s * angle_error};
    float       theta               = *theta_rad;

    /* EQ-NODO-ENCODER-1 and 3: L_n meets iq^^n Ts (y - C x^); L itself is never formed. */
    for (int16_t n = 0; n <= g->order; n++) {
        const float *l = g->gain[n][ROW_THETA];
        nodo_add_correction(x, g->gain[n], r);
        theta += (l[0] * r[0]) + (l[1] * r[1]) + (l[2] * r[2]);
        r[0] *= iq_A;
        r[1] *= iq_A;
        r[2] *= iq_A;
    }
    *theta_rad = frames_wrap(theta);
}

/* EQ-MOTOR-2 at (w, iq, id); u is the part that voltages and disturbances hold constant over the period. */
static inline nodo_meas_t derivative(const motor_reduced_t *m, float w, float iq, float id,
                                     const nodo_meas_t *u)
{
    const nodo_meas_t f = {.omega_e_radps =
                               (iq * (m->l1 + (m->l11 * id))) - (m->l2 * w) + u->omega_e_radps,
                           .iq_A = u->iq_A - (m->l4 * iq) - (w * (m->l5 + (m->l10 * id))),
                           .id_A = u->id_A - (m->l7 * id) + (m->l9 * iq * w)};
    return f;
}

void nodo_encoder_predict(nodo_t *x, float *theta_rad, const motor_reduced_t *m, dq_t v_V,
                          float ts_s)
{
    const float       half_s = 0.5f * ts_s;
    const nodo_meas_t u      = {.omega_e_radps = x->d_omega,
                                .iq_A          = (m->l6 * v_V.q) + x->d_q,
                                .id_A          = (m->l8 * v_V.d) + x->d_d};
    const nodo_meas_t f0     = derivative(m, x->omega_e_radps, x->iq_A, x->id_A, &u);
    const float       w      = x->omega_e_radps + (half_s * f0.omega_e_radps);
    const nodo_meas_t f1     = derivative(m, w, x->iq_A + (half_s * f0.iq_A),
                                          x->id_A + (half_s * f0.id_A), &u); /* EQ-NODO-ENCODER-2 */

    x->omega_e_radps += ts_s * f1.omega_e_radps;
    x->iq_A += ts_s * f1.iq_A;
    x->id_A += ts_s * f1.id_A;
    *theta_rad = frames_wrap(*theta_rad + (ts_s * w));
}

bool nodo_encoder_check(const nodo_encoder_gains_t *g)
{
    const bool order_ok = (g->order >= 0) && (g->order <= NODO_ORDER_MAX);
    bool       ok       = check_positive(g->iq_max_A) && order_ok;

    for (int16_t n = 0; ok && (n <= g->order); n++) {
        ok = check_rows(g->gain[n], NODO_ENCODER_N_X);
    }
    return ok;
}
