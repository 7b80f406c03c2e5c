/* SPDX-License-Identifier: MIT */
#include "near_optimal_position.h"

#include "frames.h"
#include "near_optimal_run.h"
#include "position_torque.h"

/* Position at the instant of the view: that of the sample, moved by the prediction. */
static position_t seen_position(const near_optimal_view_t *view, const position_command_t *command,
                                float ts_s)
{
    const float theta_rad =
        view->theta_rad - (0.5f * ts_s * view->now.omega_e_radps); /* EQ-DRIVE-2 */
    return position_moved(&command->actual, frames_wrap(theta_rad - command->actual.theta_e_rad));
}

/* Advances the reference within the profile, which follows from the torque that is there. */
static void advance(near_optimal_t *s, const near_optimal_config_t *c, const drive_config_t *drive,
                    const near_optimal_view_t *view, const position_command_t *command,
                    const position_t *is)
{
    position_ref_t          *r      = &s->position_ref;
    const position_torque_t  torque = position_torque(s, c, &drive->motor, view);
    const position_profile_t profile =
        position_ref_profile(r, &command->profile, &c->position.most, &command->target, &torque);

    position_ref_update(r, &profile, &command->target, is, c->position.near_rad, drive->ts_s);
}

/* Updates the position reference, its speed reference and the angle error. */
static void update_position(near_optimal_t *s, const near_optimal_config_t *c,
                            const drive_config_t *drive, const near_optimal_view_t *view,
                            const position_command_t *command)
{
    const position_t is = seen_position(view, command, drive->ts_s);
    position_ref_t  *r  = &s->position_ref;
    speed_ref_t     *w  = &s->speed_ref;

    if (command->moves) {
        position_ref_take(r, &command->motion, &is, c->position.near_rad);
    } else {
        advance(s, c, drive, view, command, &is);
    }
    w->omega_e_radps         = r->omega_e_radps;
    w->omega_dot_e_radps2    = r->omega_dot_e_radps2;
    w->omega_2dot_e_radps3   = r->omega_2dot_e_radps3;
    w->accel_wanted_e_radps2 = r->omega_dot_e_radps2;
    s->theta_error_e_rad     = position_way_rad(&r->at, &is);
    view->est->d_omega += inertia_ahead(&s->inertia, r->omega_dot_e_radps2); /* EQ-INERTIA-3 */
}

/* A position run begins here, or goes on. */
static void begin_run(near_optimal_t *s, const near_optimal_view_t *view,
                      const position_command_t *command, float ts_s)
{
    if (s->follows != NEAR_OPTIMAL_POSITION) {
        const position_t is = seen_position(view, command, ts_s);

        position_ref_start(&s->position_ref, &is, s->speed_ref.omega_e_radps,
                           s->speed_ref.omega_dot_e_radps2);
        s->inertia.accel_e_radps2 = s->speed_ref.omega_dot_e_radps2;
        s->theta_error_e_rad      = 0.0f;
        s->follows                = NEAR_OPTIMAL_POSITION;
    }
}

/* Speed error and angle error share one limit. Both are scaled by the same factor, which contains
 * EQ-INERTIA-4. */
static float shared_error(near_optimal_t *s, float e_w, float asked, float allowed)
{
    float share = s->inertia.gain;

    if (!base_within(asked - allowed, 0.0f)) {
        /* the limits include zero, hence asked is not zero here */
        share *= allowed * fpu_inverse(asked);
    }

    s->theta_error_e_rad *= share;
    return share * e_w;
}

nosc_error_t near_optimal_position_error(near_optimal_t *s, const near_optimal_config_t *c,
                                         const drive_config_t      *drive,
                                         const near_optimal_view_t *view, const law_input_t *in)
{
    begin_run(s, view, in->aim->position, drive->ts_s);

    const current_ref_input_t from = near_optimal_inputs(s, c, view, in, true);
    const current_ref_t      *ref  = &s->current_ref;

    update_position(s, c, drive, view, in->aim->position);
    current_ref_update(&s->current_ref, &c->current_ref, &drive->motor, &s->speed_ref, &from);

    const float  e_w = view->now.omega_e_radps - s->speed_ref.omega_e_radps;
    nosc_error_t e   = {.omega_e_radps = near_optimal_asking_e_radps(s, c, e_w, true),
                        .iq_A          = view->now.iq_A - ref->i_A.q,
                        .id_A          = view->now.id_A - ref->i_A.d};
    e.omega_e_radps *= s->inertia.gain; /* EQ-INERTIA-4 */
    nosc_error_t limited =
        nosc_limit_speed_error(&c->position.nosc, e, ref->i_A.q, ref->iq_lo_A, ref->iq_hi_A);
    limited.omega_e_radps = shared_error(s, e_w, e.omega_e_radps, limited.omega_e_radps);
    return limited;
}

void near_optimal_position_answer(const near_optimal_t *s, const near_optimal_config_t *c,
                                  const motor_reduced_t *m, const near_optimal_view_t *view,
                                  const nosc_error_t *e, dq_t feedback_V, const law_input_t *in,
                                  law_output_t *out)
{
    near_optimal_run_answer(s, c, m, view, e, feedback_V, in, out, true);
}

void near_optimal_position_step(near_optimal_t *s, const near_optimal_config_t *c,
                                const drive_config_t *drive, const near_optimal_view_t *view,
                                const law_input_t *in, law_output_t *out)
{
    const nosc_error_t e          = near_optimal_position_error(s, c, drive, view, in);
    const dq_t         theta_V    = position_loop_V(&c->position, s->theta_error_e_rad, e.iq_A);
    dq_t               feedback_V = nosc_feedback_V(&c->position.nosc, &e);

    feedback_V.d += theta_V.d;
    feedback_V.q += theta_V.q;
    near_optimal_position_answer(s, c, &drive->motor, view, &e, feedback_V, in, out);
}
