/* SPDX-License-Identifier: MIT */
#include "foc.h"

#include <math.h>

#include "check.h"
#include "voltage.h"

/* Chosen: a current step requests several times the voltage circle. An excess above this share of
 * it does not increase the weakening. */
#define WEAKENING_SHARE 0.25f

/* Chosen: at the voltage limit, a q current error above this share of the largest current is
 * "short". */
#define SHORT_SHARE 0.05f

/* Chosen by simulation: largest share of the circle for the d axis. It leaves 31 % to brake the q
 * current. A share of 1 overshoots by 39 rad/s after a step to 400 rad/s with 5 A; a smaller share
 * enters flux weakening more slowly. */
#define D_SHARE 0.95f

static bool axis_check(const foc_axis_t *a)
{
    return check_positive(a->kp_V_per_A) && check_not_negative(a->ki_tick) &&
           base_in_range(a->ki_per_kp, 0.0f, 1.0f);
}

bool foc_check(const foc_config_t *c, const drive_config_t *drive)
{
    return axis_check(&c->d) && axis_check(&c->q) &&
           base_in_range(c->current_max_A, drive->current_max_A, drive->current_max_A) &&
           base_in_range(c->iq_max_A, 0.0f, c->current_max_A) && check_positive(c->mtpa_A) &&
           base_in_range(c->id_min_A, -c->current_max_A, 0.0f) &&
           base_in_range(c->voltage_share, 1.0e-3f, 1.0f) &&
           check_not_negative(c->weakening_A_per_V);
}

void foc_reset(foc_t *s)
{
    const dq_t none = {0.0f, 0.0f};

    s->sum_V     = none;
    s->e_A       = none;
    s->u_V       = none;
    s->i_ref_A   = none;
    s->id_fw_A   = 0.0f;
    s->iq_most_A = 0.0f;
    s->limit     = 0.0f;
}

/* EQ-FOC-6 */
static float realised_V(const foc_axis_t *a, float e_A, float cut_V)
{
    return (a->ki_tick * e_A) + (a->ki_per_kp * cut_V);
}

void foc_realise(foc_t *s, const foc_config_t *c, const law_input_t *in)
{
    const float circle_V = in->sample->dc_link_V * BASE_1_SQRT3;
    const float most_V   = WEAKENING_SHARE * circle_V;
    const float left_V   = (c->voltage_share * circle_V) - sqrtf(voltage_square(s->u_V));

    s->sum_V.d += realised_V(&c->d, s->e_A.d, in->v_V.d - s->u_V.d);
    s->sum_V.q += realised_V(&c->q, s->e_A.q, in->v_V.q - s->u_V.q);
    s->id_fw_A =
        base_clamp(s->id_fw_A + (c->weakening_A_per_V * base_clamp(left_V, -most_V, most_V)),
                   c->id_min_A, 0.0f); /* EQ-FOC-3 */

    const float room_A2 =
        (c->current_max_A * c->current_max_A) - (s->i_ref_A.d * s->i_ref_A.d); /* EQ-FOC-4 */
    s->iq_most_A = (room_A2 > 0.0f) ? base_min(sqrtf(room_A2), c->iq_max_A) : 0.0f;
}

static void set_references(foc_t *s, const foc_config_t *c, float iq_wanted_A)
{
    const float iq_A   = base_clamp(iq_wanted_A, -s->iq_most_A, s->iq_most_A); /* EQ-FOC-1 */
    const float iq2    = iq_A * iq_A;
    const float mtpa_A = -iq2 / (c->mtpa_A + sqrtf((c->mtpa_A * c->mtpa_A) + iq2)); /* EQ-FOC-2 */

    s->i_ref_A.d = base_max(mtpa_A + s->id_fw_A, base_min(c->id_min_A, mtpa_A));
    s->i_ref_A.q = iq_A;
}

static float sign_of(float x)
{
    return (x < 0.0f) ? -1.0f : 1.0f;
}

/* The direction in which the current limit, or the voltage limit, stops the q current. */
static float limit_of(const foc_t *s, const foc_config_t *c, float iq_wanted_A, float dc_link_V)
{
    float limit = 0.0f;

    if (!base_within(iq_wanted_A, s->iq_most_A)) {
        limit = sign_of(iq_wanted_A);
    } else if (voltage_is_outside(s->u_V, dc_link_V) &&
               !base_within(s->e_A.q, SHORT_SHARE * c->current_max_A)) {
        limit = sign_of(s->e_A.q);
    } else {
        /* no limit acts against the q current */
    }
    return limit;
}

/* Voltage limit with priority of the d axis. */
static dq_t d_first_V(dq_t u_V, float dc_link_V)
{
    const float circle_V = dc_link_V * BASE_1_SQRT3;
    const float d_max_V  = D_SHARE * circle_V;
    const float d_V      = base_clamp(u_V.d, -d_max_V, d_max_V);
    const float q_max_V  = sqrtf((circle_V * circle_V) - (d_V * d_V));
    const dq_t  v_V      = {d_V, base_clamp(u_V.q, -q_max_V, q_max_V)};
    return v_V;
}

/* Passes a NaN on, which drive_tick() refuses. A limit would turn it into full current or
 * voltage. */
static dq_t answer_V(const foc_t *s, const foc_config_t *c, float accel_wanted_e_radps2,
                     float dc_link_V)
{
    const bool numbers =
        base_within(s->u_V.d, CHECK_LARGEST) && base_within(s->u_V.q, CHECK_LARGEST);
    const bool short_of_d = !base_within(s->e_A.d, SHORT_SHARE * c->current_max_A);
    dq_t       v_V        = s->u_V;

    if (!base_within(accel_wanted_e_radps2, CHECK_LARGEST)) {
        v_V.q = accel_wanted_e_radps2;
    } else if (numbers && short_of_d && voltage_is_outside(s->u_V, dc_link_V)) {
        v_V = d_first_V(s->u_V, dc_link_V);
    } else {
        /* drive_tick() cuts the length */
    }
    return v_V;
}

void foc_answer(foc_t *s, const foc_config_t *c, const drive_config_t *drive, const law_input_t *in,
                const nodo_meas_t *y, float accel_wanted_e_radps2, law_output_t *out)
{
    const motor_reduced_t *m     = &drive->motor;
    const float            w     = y->omega_e_radps;
    const float            per_A = m->l1 + (m->l11 * s->i_ref_A.d); /* id_ref <= 0: at least l1 */
    const float            iq_wanted_A = accel_wanted_e_radps2 / per_A;

    set_references(s, c, iq_wanted_A);
    s->e_A.d = s->i_ref_A.d - y->id_A;
    s->e_A.q = s->i_ref_A.q - y->iq_A;
    /* EQ-FOC-5; 1 / l6 and 1 / l8 are Lq and Ld, l5 / l6 is the flux */
    s->u_V.d = (c->d.kp_V_per_A * s->e_A.d) + s->sum_V.d - (w * m->inv_l6 * y->iq_A);
    s->u_V.q = (c->q.kp_V_per_A * s->e_A.q) + s->sum_V.q +
               (w * ((m->inv_l8 * y->id_A) + (m->inv_l6 * m->l5)));

    s->limit = limit_of(s, c, iq_wanted_A, in->sample->dc_link_V);

    out->v_V             = answer_V(s, c, accel_wanted_e_radps2, in->sample->dc_link_V);
    out->theta_rad       = in->sample->theta_e_rad + (1.5f * drive->ts_s * w); /* EQ-DRIVE-2 */
    out->now             = *y;
    out->i_ref_A         = s->i_ref_A;
    out->d_omega         = 0.0f;
    out->d_q             = 0.0f;
    out->profile_e_radps = 0.0f;
    out->arrived         = false;
    out->waits           = false;
    out->predicted       = false;
    out->d_d             = 0.0f;
    out->ignored_angles  = 0U;
    out->without_angle   = false;
    out->plausible       = true;
}
