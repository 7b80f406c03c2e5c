/* SPDX-License-Identifier: MIT */
#include "nodo_encoder.h"

#include "check.h"

enum {
    OBSERVED_D_OMEGA,
    OBSERVED_D_Q,
    OBSERVED_D_D,
    OBSERVED_OMEGA,
    OBSERVED_IQ,
    OBSERVED_ID,
    OBSERVED_THETA
};
enum { OF_IQ, OF_ID, OF_THETA }; /* columns */

/* A row of an odd state: L_0 meets the odd signals, L_1 the even one. */
static inline float odd_state(float x, const float *l0, const float *l1, const nodo_innovation_t *r,
                              float id_1)
{
    return x + ((l0[OF_IQ] * r->odd[0]) + (l0[OF_THETA] * r->odd[1])) + (l1[OF_ID] * id_1);
}

/* A row of d_d or id. */
static inline float even_state(float x, const float *l0, const float *l1, float id,
                               const nodo_innovation_t *r_1)
{
    return x + (l0[OF_ID] * id) + ((l1[OF_IQ] * r_1->odd[0]) + (l1[OF_THETA] * r_1->odd[1]));
}

/* EQ-NODO-ENCODER-3 of order 1, row by row: no value waits for another row in a register. */
static void add_linear(nodo_t *x, float *theta, const nodo_encoder_gains_t *g,
                       const nodo_innovation_t *r, float iq_A)
{
    const float(*l0)[NODO_ENCODER_N_Y] = g->gain[0];
    const float(*l1)[NODO_ENCODER_N_Y] = g->gain[1];
    const nodo_innovation_t r_1        = nodo_next_power(*r, iq_A);

    x->d_omega = odd_state(x->d_omega, l0[OBSERVED_D_OMEGA], l1[OBSERVED_D_OMEGA], r, r_1.id);
    x->d_q     = odd_state(x->d_q, l0[OBSERVED_D_Q], l1[OBSERVED_D_Q], r, r_1.id);
    x->omega_e_radps =
        odd_state(x->omega_e_radps, l0[OBSERVED_OMEGA], l1[OBSERVED_OMEGA], r, r_1.id);
    x->iq_A = odd_state(x->iq_A, l0[OBSERVED_IQ], l1[OBSERVED_IQ], r, r_1.id);
    *theta  = odd_state(*theta, l0[OBSERVED_THETA], l1[OBSERVED_THETA], r, r_1.id);
    x->d_d  = even_state(x->d_d, l0[OBSERVED_D_D], l1[OBSERVED_D_D], r->id, &r_1);
    x->id_A = even_state(x->id_A, l0[OBSERVED_ID], l1[OBSERVED_ID], r->id, &r_1);
}

CTL_PART void nodo_encoder_correct(nodo_t *x, float *theta_rad, const nodo_encoder_gains_t *g,
                                   dq_t i_A, float angle_error, float ts_s)
{
    const float             iq_A = base_clamp(x->iq_A, -g->iq_max_A, g->iq_max_A);
    const nodo_innovation_t r    = {.odd = {ts_s * (i_A.q - x->iq_A), ts_s * angle_error},
                                    .id  = ts_s * (i_A.d - x->id_A)};

    /* EQ-NODO-ENCODER-1 and 3: L_n meets iq^^n Ts (y - C x^); L itself is never formed. */
    if (g->order == 1) {
        add_linear(x, theta_rad, g, &r, iq_A);
    } else {
        nodo_encoder_add_series(x, theta_rad, g, &r, iq_A);
    }
    *theta_rad = frames_wrap(*theta_rad);
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
