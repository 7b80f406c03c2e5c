/* SPDX-License-Identifier: MIT */
#include "current_ref.h"

#include "check.h"
#include "fpu.h"

/* Chosen: share of the circle for the d current. The rest is for the noise of v_q. Without it the
 * limit of iq cuts noise on one side, and the mean speed is low (docs/theory/references.md). */
#define WEAKENING_SHARE 0.965f
/* Chosen: least slew rate of the q current, as a share of the one at rest. */
#define SLEW_SHARE_MIN 0.4f

/* Chosen: with it, the drive recovers from a dip of the dc link as without the least voltage, in
 * 18 ms. Without it the recovery takes a third longer. */
#define LOW_SHARE_MIN 0.8f

/* l1_min is half of l1 without load. */
#define L1_PER_MIN 2.0f

/* The voltage circle in amperes of q-axis flux linkage, around the present operating point. */
typedef struct {
    bool  active;      /**< the speed is high enough; only then the rest is set */
    float inv_w_accel; /**< 1 / (speed times acceleration per ampere) */
    float f_A;         /**< radius */
    float low_A;       /**< the same of the least voltage */
    float y_A;         /**< resistive drop and disturbance on the d axis */
    float x_A;         /**< the same on the q axis */
} circle_t;

CTL_PART void current_ref_reset(current_ref_t *r, const current_ref_config_t *c)
{
    const dq_t zero = {0.0f, 0.0f};
    r->i_A          = zero;
    r->i_dot_Aps    = zero;
    r->iq_lo_A      = 0.0f;
    r->iq_hi_A      = 0.0f;
    r->iq_circle_A  = c->current_max_A;
    r->v_low_Aps    = CHECK_LARGEST; /* the first voltage is the least */
}

/* Below this share of k^2, two terms of the series are more accurate than the difference in single
 * precision. */
#define SERIES_SHARE 1.0e-3f

/* sqrt(k^2 + x) - k, x >= 0. */
static float root_beyond_k(const current_ref_config_t *c, float x)
{
    const float half  = c->mtpa_half_1pA * x;
    const float share = c->mtpa_half_1pA * half; /* x / (2 k)^2 */

    return (share < (0.25f * SERIES_SHARE)) ? (half * (1.0f - share))
                                            : (fpu_root((c->mtpa_A * c->mtpa_A) + x) - c->mtpa_A);
}

/* Acceleration per ampere of iq. It vanishes at id = l1 / -l11 > 0, so it is limited from below. */
static float accel_per_A(const current_ref_config_t *c, const motor_reduced_t *m, float id_A)
{
    const float l1_id = m->l1 + (m->l11 * id_A);
    return base_max(l1_id, c->l1_min);
}

/* EQ-CURRENT-REF-10. A dc link that ripples then has the d current of its least voltage. */
static float least_voltage_Aps(current_ref_t *r, const current_ref_config_t *c, float v_max_Aps)
{
    const float low_Aps = base_clamp(r->v_low_Aps, LOW_SHARE_MIN * v_max_Aps, v_max_Aps);

    r->v_low_Aps = low_Aps + (c->weakening_per_period * (v_max_Aps - low_Aps));
    return low_Aps;
}

static circle_t voltage_circle(current_ref_t *r, const current_ref_config_t *c,
                               const motor_reduced_t *m, const current_ref_input_t *in, float accel)
{
    const float w      = in->state->omega_e_radps;
    const float low    = least_voltage_Aps(r, c, in->v_max_Aps);
    circle_t    circle = {.active = in->v_max_Aps < (c->flux_A * fabsf(w))};

    if (circle.active) {
        const float both   = fpu_inverse(w * accel); /* one division for both reciprocals */
        const float inv_w  = accel * both;
        circle.inv_w_accel = both;
        const float abs_w  = fabsf(inv_w);
        circle.f_A         = in->v_max_Aps * abs_w;
        circle.low_A       = low * abs_w;
        circle.y_A         = m->l10 * ((m->l7 * in->state->id_A) - in->est->d_d) * inv_w;
        circle.x_A         = ((m->l4 * in->state->iq_A) - in->est->d_q) * inv_w;
    }
    return circle;
}

/* EQ-CURRENT-REF-3 and 4 for the requested iq, not for the limited one. */
static float id_weakening_A(const current_ref_config_t *c, const motor_reduced_t *m,
                            const circle_t *v, float iq_A)
{
    const float dq = fabsf(iq_A - v->y_A);
    const float g  = WEAKENING_SHARE * v->low_A;
    const float g2 = g * g;
    float       q_flux;

    if (dq > (c->chord_from * g)) {
        const float u = 0.5f * root_beyond_k(c, 2.0f * g2);
        q_flux        = -base_min(c->chord_slope * (dq - g), u);
    } else {
        q_flux = fpu_root(g2 - (dq * dq));
    }
    return m->l9 * (q_flux - m->l5 - v->x_A);
}

/* EQ-CURRENT-REF-2. */
static float id_mtpa_A(const current_ref_config_t *c, float iq2)
{
    return -(c->mtpa_exact ? root_beyond_k(c, iq2) : (c->mtpa_half_1pA * iq2));
}

/* True if id is below EQ-CURRENT-REF-2. It compares squares to avoid the root. False for a NaN. */
static bool is_below_mtpa(const current_ref_config_t *c, float id_A, float iq2)
{
    const float beyond = base_max(-id_A, 0.0f); /* 0 is never below */
    const float square =
        c->mtpa_exact ? (beyond * ((2.0f * c->mtpa_A) + beyond)) : (beyond * 2.0f * c->mtpa_A);

    return square > iq2;
}

/* EQ-CURRENT-REF-5, 8 and 9. id_ref is the output of a first-order filter, so its derivative is
 * exact. */
static void move_id(current_ref_t *r, const current_ref_config_t *c, const motor_reduced_t *m,
                    const circle_t *v, float iq_wanted_A, float max_A)
{
    const float iq2   = r->i_A.q * r->i_A.q;
    const float fw_A  = v->active ? id_weakening_A(c, m, v, iq_wanted_A) : 0.0f;
    const bool  fw    = is_below_mtpa(c, fw_A, iq2);
    const float id_A  = fw ? fw_A : id_mtpa_A(c, iq2);
    const float share = fw ? c->weakening_per_period : c->mtpa_per_period;
    const float step  = share * (base_max(base_min(id_A, c->id_rest_A), -max_A) - r->i_A.d);

    r->i_dot_Aps.d = c->samples_1ps * step;
    r->i_A.d += step;
}

/* EQ-CURRENT-REF-7: the least iq w. */
static float limit_regeneration(const current_ref_config_t *c, const circle_t *v, float w_accel,
                                float dc_link_V, float iq_A)
{
    const float share =
        base_clamp(1.0f - (c->regen_per_V * (dc_link_V - c->regen_start_V)), 0.0f, 1.0f);
    const float power = share * c->regen_max_W_norm;

    if (-iq_A * w_accel > power) {
        return -power * (v->active ? v->inv_w_accel : fpu_inverse(w_accel));
    }
    return iq_A;
}

/* Limits iq by the current circle, EQ-CURRENT-REF-6 and 7. */
static void limit_iq(current_ref_t *r, const current_ref_config_t *c, const motor_reduced_t *m,
                     const circle_t *v, float accel, const current_ref_input_t *in, float allowed,
                     float max_A)
{
    const float w        = in->state->omega_e_radps;
    const float room_A2  = (max_A * max_A) - (r->i_A.d * r->i_A.d);
    const float circle_A = fpu_root(room_A2);
    const float hi_A     = base_min(circle_A, allowed * c->iq_max_A);
    float       from_A   = -hi_A;
    float       to_A     = hi_A;

    if (v->active) {
        const float q_A    = m->l5 + (m->l10 * in->state->id_A) + v->x_A;
        const float half_A = fpu_root((v->f_A * v->f_A) - (q_A * q_A));
        from_A             = base_clamp(v->y_A - half_A, -hi_A, 0.0f);
        to_A               = base_clamp(v->y_A + half_A, 0.0f, hi_A);
    }
    /* from <= 0 <= to: only the limit against the speed regenerates. */
    const bool  forwards = w > 0.0f;
    const float back_A =
        limit_regeneration(c, v, w * accel, in->dc_link_V, forwards ? from_A : to_A);
    r->iq_circle_A = circle_A;
    r->iq_lo_A     = forwards ? back_A : from_A;
    r->iq_hi_A     = forwards ? to_A : back_A;
}

CTL_PART speed_ref_limits_t current_ref_speed_limits(const current_ref_t        *r,
                                                     const current_ref_config_t *c,
                                                     const motor_reduced_t      *m,
                                                     const current_ref_input_t  *in,
                                                     float                       command_e_radps)
{
    const float w        = in->state->omega_e_radps;
    const float accel    = c->torque_share * accel_per_A(c, m, r->i_A.d);
    const float unforced = in->est->d_omega - (m->l2 * w);
    const float top      = in->v_max_Aps;
    /* The voltage available at both ends of the speed change. The EMF's help is not counted, as the
     * d axis needs some voltage. Simulation: 1.5 times the slew rate overshoots a step of 200 rad/s
     * by 1.5 rad/s and is not faster. */
    const float highest = base_max(w, command_e_radps);
    const float lowest  = base_min(w, command_e_radps);
    const float up      = base_max(top - (m->l5 * highest), SLEW_SHARE_MIN * top);
    const float down    = base_max(top + (m->l5 * lowest), SLEW_SHARE_MIN * top);

    const speed_ref_limits_t limits = {
        .accel_hi_e_radps2  = base_max(unforced + (accel * r->iq_hi_A), 0.0f),
        .accel_lo_e_radps2  = base_min(unforced + (accel * r->iq_lo_A), 0.0f),
        .jerk_up_e_radps3   = L1_PER_MIN * c->l1_min * base_min(up, top),
        .jerk_down_e_radps3 = L1_PER_MIN * c->l1_min * base_min(down, top),
        .near_e_radps       = c->near_e_radps,
        .samples_1ps        = c->samples_1ps};
    return limits;
}

CTL_PART void current_ref_update(current_ref_t *r, const current_ref_config_t *c,
                                 const motor_reduced_t *m, const speed_ref_t *w,
                                 const current_ref_input_t *in)
{
    const float    accel = accel_per_A(c, m, in->state->id_A);
    const circle_t v     = voltage_circle(r, c, m, in, accel);
    const float    inv = v.active ? (in->state->omega_e_radps * v.inv_w_accel) : fpu_inverse(accel);
    const float    load  = (m->l2 * w->omega_e_radps) - in->est->d_omega;
    const float    iq_A  = inv * (load + w->omega_dot_e_radps2); /* EQ-CURRENT-REF-1 */
    const float    all_A = inv * (load + w->accel_wanted_e_radps2) + in->iq_speed_A;
    const float    hi_A  = r->iq_circle_A; /* for the previous id_ref */

    const float allowed = 1.0f - in->derating;
    const float max_A   = allowed * c->current_max_A;

    move_id(r, c, m, &v, base_clamp(all_A, -hi_A, hi_A), max_A);
    limit_iq(r, c, m, &v, accel, in, allowed, max_A);
    const float limited_A = base_clamp(iq_A, r->iq_lo_A, r->iq_hi_A);

    r->i_A.q       = limited_A;
    r->i_dot_Aps.q = base_within(iq_A - limited_A, 0.0f)
                         ? (inv * (w->omega_2dot_e_radps3 - in->d_omega_dot))
                         : 0.0f;
}

CTL_PART bool current_ref_check(const current_ref_config_t *c)
{
    return check_positive(c->current_max_A) && check_positive(c->iq_max_A) &&
           (c->iq_max_A <= c->current_max_A) && check_positive(c->mtpa_A) &&
           base_in_range(2.0f * c->mtpa_A * c->mtpa_half_1pA, 0.999f, 1.001f) &&
           check_positive(c->circle_ApVs) && base_in_range(c->torque_share, 1.0e-3f, 1.0f) &&
           check_positive(c->near_e_radps) &&
           base_in_range(c->id_rest_A, -c->current_max_A, 0.0f) && check_positive(c->flux_A) &&
           check_positive(c->l1_min) && base_in_range(c->mtpa_per_period, 1.0e-6f, 1.0f) &&
           base_in_range(c->weakening_per_period, 1.0e-6f, 1.0f) &&
           base_in_range(c->chord_from, 0.0f, 1.0f) && check_not_negative(c->chord_slope) &&
           check_positive(c->samples_1ps) &&
           base_in_range(c->regen_max_W_norm, 0.0f, CHECK_LARGEST) &&
           check_positive(c->regen_start_V) && check_positive(c->regen_per_V);
}
