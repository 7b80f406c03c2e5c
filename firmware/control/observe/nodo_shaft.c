/* SPDX-License-Identifier: MIT */
#include "nodo_shaft.h"

#include "check.h"
#include "frames.h"

enum { STEP_OMEGA, STEP_LOAD, STEP_TWIST, STEP_THETA };                /* of EQ-SHAFT-2 */
enum { FROM_OMEGA, FROM_LOAD, FROM_TWIST, FROM_TORQUE, FROM_D_OMEGA }; /* its columns */
enum { LOAD_OF_IQ, LOAD_OF_ID, LOAD_OF_THETA };                        /* columns of L */

CTL_PART void nodo_shaft_reset(nodo_shaft_t *s, const nodo_meas_t *y, float theta_rad)
{
    nodo_reset(&s->motor, y);
    s->theta_rad    = frames_wrap(theta_rad);
    s->load_e_radps = y->omega_e_radps;
    s->twist_rad    = 0.0f;
}

/* Both states of the load are odd. */
static float load_change(const float l[2][NODO_ENCODER_N_Y], const nodo_innovation_t *r, float iq_A)
{
    return ((l[0][LOAD_OF_IQ] * r->odd[0]) + (l[0][LOAD_OF_THETA] * r->odd[1])) +
           (l[1][LOAD_OF_ID] * iq_A * r->id);
}

CTL_PART void nodo_shaft_correct(nodo_shaft_t *s, const nodo_shaft_gains_t *g, dq_t i_A,
                                 float angle_error, float ts_s)
{
    const nodo_t           *x    = &s->motor;
    const float             iq_A = base_clamp(x->iq_A, -g->motor.iq_max_A, g->motor.iq_max_A);
    const nodo_innovation_t r    = {.odd = {ts_s * (i_A.q - x->iq_A), ts_s * angle_error},
                                    .id  = ts_s * (i_A.d - x->id_A)};

    s->load_e_radps += load_change(g->load[0], &r, iq_A);
    s->twist_rad += load_change(g->load[1], &r, iq_A);
    nodo_encoder_correct(&s->motor, &s->theta_rad, &g->motor, i_A, angle_error, ts_s);
}

/* A row of EQ-SHAFT-2. */
static inline float stepped(const float *row, const nodo_shaft_t *s, float torque)
{
    return ((row[FROM_OMEGA] * s->motor.omega_e_radps) + (row[FROM_LOAD] * s->load_e_radps)) +
           ((row[FROM_TWIST] * s->twist_rad) + (row[FROM_TORQUE] * torque)) +
           (row[FROM_D_OMEGA] * s->motor.d_omega);
}

/* Derivatives of iq and id, EQ-MOTOR-2; u is the part by voltages and disturbances. */
static inline dq_t current_rates(const motor_reduced_t *m, float w, float iq, float id, dq_t u_Aps)
{
    const dq_t f = {.d = u_Aps.d - (m->l7 * id) + (m->l9 * iq * w),
                    .q = u_Aps.q - (m->l4 * iq) - (w * (m->l5 + (m->l10 * id)))};
    return f;
}

CTL_PART void nodo_shaft_predict(nodo_shaft_t *s, const nodo_shaft_gains_t *g,
                                 const motor_reduced_t *m, dq_t v_V, float ts_s)
{
    nodo_t     *x      = &s->motor;
    const float half_s = 0.5f * ts_s;
    const dq_t  u_Aps  = {.d = (m->l8 * v_V.d) + x->d_d, .q = (m->l6 * v_V.q) + x->d_q};
    const dq_t  f0     = current_rates(m, x->omega_e_radps, x->iq_A, x->id_A, u_Aps);
    const float iq     = x->iq_A + (half_s * f0.q);
    const float id     = x->id_A + (half_s * f0.d);
    const float torque = iq * (m->l1 + (m->l11 * id));
    const float w      = stepped(g->step[STEP_OMEGA], s, torque);
    const float load   = stepped(g->step[STEP_LOAD], s, torque);
    const float twist  = stepped(g->step[STEP_TWIST], s, torque);
    const float turned = stepped(g->step[STEP_THETA], s, torque);
    const dq_t  f1     = current_rates(m, 0.5f * (x->omega_e_radps + w), iq, id, u_Aps);

    x->iq_A += ts_s * f1.q;
    x->id_A += ts_s * f1.d;
    x->omega_e_radps = w;
    s->load_e_radps  = load;
    s->twist_rad     = twist;
    s->theta_rad     = frames_wrap(s->theta_rad + turned);
}

CTL_PART bool nodo_shaft_check(const nodo_shaft_gains_t *g)
{
    bool ok = nodo_encoder_check(&g->motor) && (g->motor.order == 1);

    for (int16_t i = 0; ok && (i < NODO_SHAFT_N_LOAD); i++) {
        ok = check_finite(g->load[i][0], NODO_ENCODER_N_Y) &&
             check_finite(g->load[i][1], NODO_ENCODER_N_Y) &&
             check_parity(g->load[i][0], LOAD_OF_ID, true) &&
             check_parity(g->load[i][1], LOAD_OF_ID, false);
    }
    for (int16_t i = 0; ok && (i < NODO_SHAFT_N_STEP); i++) {
        ok = check_finite(g->step[i], NODO_SHAFT_N_FROM);
    }
    return ok;
}
