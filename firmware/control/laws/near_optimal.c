/* SPDX-License-Identifier: MIT */
#include "near_optimal.h"

#include "near_optimal_run.h"

CTL_PART bool near_optimal_check(const near_optimal_config_t *c, const drive_config_t *drive)
{
    const float max_A = c->current_ref.current_max_A;

    return current_ref_check(&c->current_ref) && nosc_check(&c->nosc) &&
           (!drive->positions || position_loop_check(&c->position)) &&
           base_in_range(max_A, drive->current_max_A, drive->current_max_A) &&
           base_in_range(c->current_ref.samples_1ps * drive->ts_s, 0.999f, 1.001f);
}

CTL_PART void near_optimal_reset(near_optimal_t *s, const near_optimal_config_t *c,
                                 float omega_e_radps)
{
    speed_ref_reset(&s->speed_ref, omega_e_radps);
    current_ref_reset(&s->current_ref, &c->current_ref);
    inertia_reset(&s->inertia);
    s->follows           = NEAR_OPTIMAL_SPEED;
    s->theta_error_e_rad = 0.0f;
}

CTL_PART nosc_error_t near_optimal_error(near_optimal_t *s, const near_optimal_config_t *c,
                                         const drive_config_t      *drive,
                                         const near_optimal_view_t *view, const law_input_t *in)
{
    const float               w      = view->now.omega_e_radps;
    const current_ref_input_t from   = near_optimal_inputs(s, c, view, in, false);
    const speed_ref_limits_t  limits = current_ref_speed_limits(
         &s->current_ref, &c->current_ref, &drive->motor, &from, in->command_e_radps);
    const current_ref_t *ref = &s->current_ref;

    s->follows = NEAR_OPTIMAL_SPEED;
    speed_ref_update(&s->speed_ref, &limits, in->command_e_radps, w, drive->ts_s);
    current_ref_update(&s->current_ref, &c->current_ref, &drive->motor, &s->speed_ref, &from);

    const nosc_error_t e = {.omega_e_radps = w - s->speed_ref.omega_e_radps,
                            .iq_A          = view->now.iq_A - ref->i_A.q,
                            .id_A          = view->now.id_A - ref->i_A.d};
    return nosc_limit_speed_error(&c->nosc, e, ref->i_A.q, ref->iq_lo_A, ref->iq_hi_A);
}

CTL_PART void near_optimal_answer(const near_optimal_t *s, const near_optimal_config_t *c,
                                  const motor_reduced_t *m, const near_optimal_view_t *view,
                                  const nosc_error_t *e, dq_t feedback_V, const law_input_t *in,
                                  law_output_t *out)
{
    near_optimal_run_answer(s, c, m, view, e, feedback_V, in, out, false);
}
