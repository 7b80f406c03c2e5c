/* SPDX-License-Identifier: MIT */
#include "nodo_encoder.h"

#include "check.h"

enum { ROW_THETA = NODO_N_X };
enum { OF_IQ, OF_ID, OF_THETA }; /* columns */

CTL_PART void nodo_encoder_correct(nodo_t *x, float *theta_rad, const nodo_encoder_gains_t *g,
                                   dq_t i_A, float angle_error, float ts_s)
{
    const float       iq_A  = base_clamp(x->iq_A, -g->iq_max_A, g->iq_max_A);
    float             theta = *theta_rad;
    nodo_t            sum   = *x; /* local, so that the compiler keeps it in registers */
    nodo_innovation_t r     = {.odd = {ts_s * (i_A.q - x->iq_A), ts_s * angle_error},
                               .id  = ts_s * (i_A.d - x->id_A)};

    /* EQ-NODO-ENCODER-1 and 3: L_n meets iq^^n Ts (y - C x^); L itself is never formed. */
    for (int16_t n = 0; n <= g->order; n = (int16_t)(n + 2)) {
        const float(*l)[NODO_ENCODER_N_Y] = g->gain[n];

        nodo_add_even(&sum, l, OF_ID, &r);
        theta += (l[ROW_THETA][OF_IQ] * r.odd[0]) + (l[ROW_THETA][OF_THETA] * r.odd[1]);
        if (n < g->order) {
            l = g->gain[n + 1];
            r = nodo_next_power(r, iq_A);
            nodo_add_odd(&sum, l, OF_ID, &r);
            theta += l[ROW_THETA][OF_ID] * r.id;
            r = nodo_next_power(r, iq_A);
        }
    }
    *x         = sum;
    *theta_rad = frames_wrap(theta);
}

/* Derivatives of w, iq, id. */
typedef struct {
    float omega_dot_e_radps2;
    float iq_dot_Aps;
    float id_dot_Aps;
} rate_t;

/* EQ-MOTOR-2 at (w, iq, id); u is the part by voltages and disturbances, constant over the
 * period. */
static inline rate_t rates(const motor_reduced_t *m, float w, float iq, float id, const rate_t *u)
{
    const rate_t f = {.omega_dot_e_radps2 =
                          (iq * (m->l1 + (m->l11 * id))) - (m->l2 * w) + u->omega_dot_e_radps2,
                      .iq_dot_Aps = u->iq_dot_Aps - (m->l4 * iq) - (w * (m->l5 + (m->l10 * id))),
                      .id_dot_Aps = u->id_dot_Aps - (m->l7 * id) + (m->l9 * iq * w)};
    return f;
}

CTL_PART void nodo_encoder_predict(nodo_t *x, float *theta_rad, const motor_reduced_t *m, dq_t v_V,
                                   float ts_s)
{
    const float  half_s = 0.5f * ts_s;
    const rate_t u      = {.omega_dot_e_radps2 = x->d_omega,
                           .iq_dot_Aps         = (m->l6 * v_V.q) + x->d_q,
                           .id_dot_Aps         = (m->l8 * v_V.d) + x->d_d};
    const rate_t f0     = rates(m, x->omega_e_radps, x->iq_A, x->id_A, &u);
    const float  w      = x->omega_e_radps + (half_s * f0.omega_dot_e_radps2);
    const rate_t f1     = rates(m, w, x->iq_A + (half_s * f0.iq_dot_Aps),
                                x->id_A + (half_s * f0.id_dot_Aps), &u); /* EQ-NODO-ENCODER-2 */

    x->omega_e_radps += ts_s * f1.omega_dot_e_radps2;
    x->iq_A += ts_s * f1.iq_dot_Aps;
    x->id_A += ts_s * f1.id_dot_Aps;
    *theta_rad = frames_wrap(*theta_rad + (ts_s * w));
}

/* The row of the load has the unit 1/s^3 and reaches 4e13 with a small motor at 20 kHz. It is
 * multiplied by Ts and an angle: products of 1e18 stay finite. */
#define GAIN_LARGEST 1.0e18f

static bool rows_check(const float row[][NODO_ENCODER_N_Y])
{
    bool ok = true;

    for (int16_t i = 0; i < NODO_ENCODER_N_X; i++) {
        for (int16_t k = 0; k < NODO_ENCODER_N_Y; k++) {
            ok = ok && base_within(row[i][k], GAIN_LARGEST);
        }
    }
    return ok;
}

CTL_PART bool nodo_encoder_check(const nodo_encoder_gains_t *g)
{
    const bool order_ok = (g->order >= 0) && (g->order <= NODO_ORDER_MAX);
    bool       ok       = check_positive(g->iq_max_A) && order_ok;

    for (int16_t n = 0; ok && (n <= g->order); n++) {
        ok = rows_check(g->gain[n]) &&
             nodo_parity_check(g->gain[n], NODO_ENCODER_N_X, ((uint16_t)n & 1U) == 0U, OF_ID);
    }
    return ok;
}
