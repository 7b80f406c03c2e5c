/* SPDX-License-Identifier: MIT */
#include "current_ref.h"

#include <math.h>

/* Chosen: where the back-EMF is below this share of the voltage circle, no current inside the circle of
 * the shipped motors needs flux weakening; it also keeps every division by the speed away from zero. */
#define FW_SPEED_SHARE 0.25f

/* The voltage circle in amperes of q-axis flux linkage, around the present operating point. */
typedef struct {
    bool  active; /**< fast enough to matter */
    float f_A;    /**< radius */
    float y_A;    /**< resistive drop and disturbance on the d axis */
    float x_A;    /**< the same on the q axis */
} circle_t;

void current_ref_reset(current_ref_t *r)
{
    const dq_t zero = {0.0f, 0.0f};
    r->i_A          = zero;
    r->i_dot_Aps    = zero;
    r->filter_A     = zero;
    r->iq_lo_A      = 0.0f;
    r->iq_hi_A      = 0.0f;
}

static float positive_sqrt(float x)
{
    return (x > 0.0f) ? sqrtf(x) : 0.0f;
}

static circle_t voltage_circle(const current_ref_config_t *c, const motor_reduced_t *m,
                               const current_ref_input_t *in)
{
    const float w      = in->meas->omega_e_radps;
    const float v_6    = m->l6 * c->voltage_share * in->v_max_V;
    circle_t    circle = {.active = (FW_SPEED_SHARE * v_6) < (m->l5 * fabsf(w)),
                          .f_A    = 0.0f,
                          .y_A    = 0.0f,
                          .x_A    = 0.0f};

    if (circle.active) {
        const float inv_w = 1.0f / w;
        circle.f_A        = v_6 * fabsf(inv_w);
        circle.y_A        = m->l10 * ((m->l7 * in->meas->id_A) - in->est->d_d) * inv_w;
        circle.x_A        = ((m->l4 * in->meas->iq_A) - in->est->d_q) * inv_w;
    }
    return circle;
}

/* EQ-CURRENT-REF-1 to 3. Weakening makes room for the current that is wanted, not for what fits already. */
static float id_target_A(const current_ref_config_t *c, const motor_reduced_t *m, const circle_t *v,
                         float iq_A, float iq_wanted_A)
{
    float id_A = c->mtpa_gain_1pA * iq_A * iq_A;

    if (v->active) {
        const float dq   = iq_wanted_A - v->y_A;
        const float fw_A = m->l9 * (positive_sqrt((v->f_A * v->f_A) - (dq * dq)) - m->l5 - v->x_A);
        id_A             = (fw_A < id_A) ? fw_A : id_A;
    }
    return base_clamp(id_A, -c->current_max_A, 0.0f);
}

/* The current circle and EQ-CURRENT-REF-5. */
static void limit_iq(current_ref_t *r, const current_ref_config_t *c, const motor_reduced_t *m,
                     const circle_t *v, float id_A)
{
    const float room_A2 = (c->current_max_A * c->current_max_A) - (r->i_A.d * r->i_A.d);
    const float hi_A    = fminf(c->iq_max_A, positive_sqrt(room_A2));
    r->iq_lo_A          = -hi_A;
    r->iq_hi_A          = hi_A;

    if (v->active) {
        const float q_A    = m->l5 + (m->l10 * id_A) + v->x_A;
        const float half_A = positive_sqrt((v->f_A * v->f_A) - (q_A * q_A));
        r->iq_lo_A         = base_clamp(v->y_A - half_A, -hi_A, 0.0f);
        r->iq_hi_A         = base_clamp(v->y_A + half_A, 0.0f, hi_A);
    }
}

void current_ref_update(current_ref_t *r, const current_ref_config_t *c, const motor_reduced_t *m,
                        const speed_ref_t *w, const current_ref_input_t *in)
{
    const circle_t v = voltage_circle(c, m, in);

    /* EQ-CURRENT-REF-4. The denominator vanishes at id = l1 / -l11 > 0; it is held well above. */
    const float l1_id = m->l1 + (m->l11 * in->meas->id_A);
    const float iq_A  = ((m->l2 * w->omega_e_radps) + w->omega_dot_e_radps2 - in->est->d_omega) /
                       ((l1_id > c->l1_min) ? l1_id : c->l1_min);
    const float wanted_A = base_clamp(iq_A + in->iq_speed_A, -c->iq_max_A, c->iq_max_A);

    /* The filtered target is the reference, so its derivative is exact. */
    const float id_step_A = id_target_A(c, m, &v, r->i_A.q, wanted_A) - r->filter_A.d;
    r->i_dot_Aps.d        = c->filter_1ps * id_step_A;
    r->filter_A.d += c->filter_per_period * id_step_A;
    r->i_A.d = r->filter_A.d;

    limit_iq(r, c, m, &v, in->meas->id_A);
    r->i_A.q = base_clamp(iq_A, r->iq_lo_A, r->iq_hi_A);

    const float iq_step_A = r->i_A.q - r->filter_A.q;
    r->i_dot_Aps.q        = c->filter_1ps * iq_step_A;
    r->filter_A.q += c->filter_per_period * iq_step_A;
}
