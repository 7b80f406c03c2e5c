/* SPDX-License-Identifier: MIT */
#include "nodo_encoder.h"

enum { ROW_D_OMEGA, ROW_D_Q, ROW_D_D, ROW_OMEGA, ROW_IQ, ROW_ID, ROW_THETA };

float nodo_encoder_wrap(float angle_rad)
{
    if (angle_rad > BASE_PI) {
        return angle_rad - BASE_TWO_PI;
    }
    return (angle_rad < -BASE_PI) ? (angle_rad + BASE_TWO_PI) : angle_rad;
}

void nodo_encoder_correct(nodo_t *x, float *theta_rad, const nodo_encoder_gains_t *g, dq_t i_A,
                          float angle_error, float ts_s)
{
    const float iq_A                 = base_clamp(x->iq_A, -g->iq_max_A, g->iq_max_A);
    const float r_iq                 = i_A.q - x->iq_A;
    const float r_id                 = i_A.d - x->id_A;
    float       lr[NODO_ENCODER_N_X] = {0.0f};

    /* EQ-NODO-ENCODER-3 by Horner on the vectors L_n (y - C x^). */
    for (int16_t n = g->order; n >= 0; n--) {
        for (int16_t row = 0; row < NODO_ENCODER_N_X; row++) {
            const float *l = g->gain[n][row];
            lr[row] = (lr[row] * iq_A) + ((l[0] * r_iq) + (l[1] * r_id) + (l[2] * angle_error));
        }
    }
    x->d_omega += ts_s * lr[ROW_D_OMEGA]; /* EQ-NODO-ENCODER-1 */
    x->d_q += ts_s * lr[ROW_D_Q];
    x->d_d += ts_s * lr[ROW_D_D];
    x->omega_e_radps += ts_s * lr[ROW_OMEGA];
    x->iq_A += ts_s * lr[ROW_IQ];
    x->id_A += ts_s * lr[ROW_ID];
    *theta_rad = nodo_encoder_wrap(*theta_rad + (ts_s * lr[ROW_THETA]));
}

/* EQ-MOTOR-2 at (w, iq, id) with the disturbances of x. */
static nodo_meas_t derivative(const nodo_t *x, const nodo_meas_t *at, const motor_reduced_t *m,
                              dq_t v_V)
{
    const float       w  = at->omega_e_radps;
    const float       iq = at->iq_A;
    const float       id = at->id_A;
    const nodo_meas_t f  = {
         .omega_e_radps = (m->l1 * iq) - (m->l2 * w) + (m->l11 * iq * id) + x->d_omega,
         .iq_A          = (m->l6 * v_V.q) - (m->l4 * iq) - (m->l5 * w) - (m->l10 * id * w) + x->d_q,
         .id_A          = (m->l8 * v_V.d) - (m->l7 * id) + (m->l9 * iq * w) + x->d_d};
    return f;
}

void nodo_encoder_predict(nodo_t *x, float *theta_rad, const motor_reduced_t *m, dq_t v_V,
                          float ts_s)
{
    const float       half_s = 0.5f * ts_s;
    const nodo_meas_t start  = {x->omega_e_radps, x->iq_A, x->id_A};
    const nodo_meas_t f0     = derivative(x, &start, m, v_V);
    const nodo_meas_t middle = {start.omega_e_radps + (half_s * f0.omega_e_radps),
                                start.iq_A + (half_s * f0.iq_A), start.id_A + (half_s * f0.id_A)};
    const nodo_meas_t f1     = derivative(x, &middle, m, v_V); /* EQ-NODO-ENCODER-2 */

    x->omega_e_radps += ts_s * f1.omega_e_radps;
    x->iq_A += ts_s * f1.iq_A;
    x->id_A += ts_s * f1.id_A;
    *theta_rad = nodo_encoder_wrap(*theta_rad + (ts_s * middle.omega_e_radps));
}
