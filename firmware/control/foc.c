/* SPDX-License-Identifier: MIT */
#include "foc.h"

#include <math.h>

#include "check.h"
#include "voltage.h"

/* Chosen: a current step asks for several times the voltage circle; what is beyond this share of it does not weaken more. */
#define WEAKENING_SHARE 0.25f

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

    s->sum_V          = none;
    s->e_A            = none;
    s->u_V            = none;
    s->i_ref_A        = none;
    s->id_fw_A        = 0.0f;
    s->iq_most_A      = 0.0f;
    s->accel_e_radps2 = 0.0f;
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

static void set_references(foc_t *s, const foc_config_t *c, const motor_reduced_t *m,
                           float accel_wanted_e_radps2)
{
    const float per_A = m->l1 + (m->l11 * s->i_ref_A.d); /* at least l1: id_ref <= 0 */
    const float iq_ref_A =
        base_clamp(accel_wanted_e_radps2 / per_A, -s->iq_most_A, s->iq_most_A); /* EQ-FOC-1 */
    const float iq2    = iq_ref_A * iq_ref_A;
    const float mtpa_A = -iq2 / (c->mtpa_A + sqrtf((c->mtpa_A * c->mtpa_A) + iq2)); /* EQ-FOC-2 */

    s->accel_e_radps2 = per_A * iq_ref_A;
    s->i_ref_A.d      = base_max(mtpa_A + s->id_fw_A, base_min(c->id_min_A, mtpa_A));
    s->i_ref_A.q      = iq_ref_A;
}

void foc_answer(foc_t *s, const foc_config_t *c, const drive_config_t *drive, const law_input_t *in,
                const nodo_meas_t *y, float accel_wanted_e_radps2, law_output_t *out)
{
    const motor_reduced_t *m = &drive->motor;
    const float            w = y->omega_e_radps;

    set_references(s, c, m, accel_wanted_e_radps2);
    s->e_A.d = s->i_ref_A.d - y->id_A;
    s->e_A.q = s->i_ref_A.q - y->iq_A;
    /* EQ-FOC-5; 1 / l6 and 1 / l8 are Lq and Ld, l5 / l6 is the flux */
    s->u_V.d = (c->d.kp_V_per_A * s->e_A.d) + s->sum_V.d - (w * m->inv_l6 * y->iq_A);
    s->u_V.q = (c->q.kp_V_per_A * s->e_A.q) + s->sum_V.q +
               (w * ((m->inv_l8 * y->id_A) + (m->inv_l6 * m->l5)));

    /* The limit would turn a NaN into full current. */
    out->v_V.d = s->u_V.d;
    out->v_V.q =
        base_within(accel_wanted_e_radps2, CHECK_LARGEST) ? s->u_V.q : accel_wanted_e_radps2;
    out->theta_rad = in->sample->theta_e_rad + (1.5f * drive->ts_s * w); /* EQ-DRIVE-2 */
    out->now       = *y;
    out->i_ref_A   = s->i_ref_A;
    out->d_omega   = 0.0f;
    out->d_q       = 0.0f;
    out->d_d       = 0.0f;
    out->plausible = true;
}
