/* SPDX-License-Identifier: MIT */
#include "near_optimal.h"

#include <stddef.h>

#include "current_clamp.h"
#include "feedforward.h"
#include "fpu.h"
#include "frames.h"
#include "position_torque.h"
#include "voltage.h"

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
    s->positioning       = false;
    s->theta_error_e_rad = 0.0f;
}

/* Position at the instant of the view: that of the sample, moved by the prediction. */
static position_t seen_position(const near_optimal_view_t *view, const position_command_t *command,
                                float ts_s)
{
    const float theta_rad =
        view->theta_rad - (0.5f * ts_s * view->now.omega_e_radps); /* EQ-DRIVE-2 */
    return position_moved(&command->actual, frames_wrap(theta_rad - command->actual.theta_e_rad));
}

/* Updates the position reference, its speed reference and the angle error. */
static void update_position(near_optimal_t *s, const near_optimal_config_t *c,
                            const drive_config_t *drive, const near_optimal_view_t *view,
                            const position_command_t *command)
{
    const position_t is = seen_position(view, command, drive->ts_s);
    position_ref_t  *r  = &s->position_ref;
    speed_ref_t     *w  = &s->speed_ref;
    /* A copy, so that in other runs the view need not be in memory. */
    const near_optimal_view_t its_own = *view;
    const position_torque_t   torque  = position_torque(s, c, &drive->motor, &its_own);
    const position_profile_t  profile =
        position_ref_profile(r, &command->profile, &c->position.most, &command->target, &torque);

    position_ref_update(r, &profile, &command->target, &is, c->position.near_rad, drive->ts_s);
    w->omega_e_radps         = r->omega_e_radps;
    w->omega_dot_e_radps2    = r->omega_dot_e_radps2;
    w->omega_2dot_e_radps3   = r->omega_2dot_e_radps3;
    w->accel_wanted_e_radps2 = r->omega_dot_e_radps2;
    s->theta_error_e_rad     = position_way_rad(&r->at, &is);
    view->est->d_omega += inertia_ahead(&s->inertia, r->omega_dot_e_radps2); /* EQ-INERTIA-3 */
}

/* A speed run, or a position run that may begin here. All that follows in the period depends on
 * it. */
static void choose_run(near_optimal_t *s, const near_optimal_view_t *view,
                       const position_command_t *command, float ts_s)
{
    if (command == NULL) {
        s->positioning          = false;
        s->theta_error_e_rad    = 0.0f;
        s->position_ref.arrived = false;
        s->position_ref.waits   = false;
    } else if (!s->positioning) {
        const position_t is = seen_position(view, command, ts_s);

        position_ref_start(&s->position_ref, &is, s->speed_ref.omega_e_radps,
                           s->speed_ref.omega_dot_e_radps2);
        s->inertia.accel_e_radps2 = s->speed_ref.omega_dot_e_radps2;
        s->positioning            = true;
    } else {
        /* the position run goes on */
    }
}

/* EQ-POSITION-4: combined error of speed and angle; in a speed run the speed error. */
static float asking_e_radps(const near_optimal_t *s, const near_optimal_config_t *c,
                            float speed_error_e_radps)
{
    return s->positioning
               ? (speed_error_e_radps + (c->position.speed_per_rad * s->theta_error_e_rad))
               : speed_error_e_radps;
}

static void update_references(near_optimal_t *s, const near_optimal_config_t *c,
                              const drive_config_t *drive, const near_optimal_view_t *view,
                              const law_input_t *in)
{
    const float               w    = view->now.omega_e_radps;
    const float               e_w  = w - s->speed_ref.omega_e_radps;
    const current_ref_input_t from = {
        .est         = view->est,
        .state       = &view->now,
        .iq_speed_A  = nosc_speed_current_A(near_optimal_gains(s, c), asking_e_radps(s, c, e_w)),
        .dc_link_V   = in->sample->dc_link_V,
        .v_max_Aps   = c->current_ref.circle_ApVs * in->sample->dc_link_V,
        .d_omega_dot = view->d_omega_dot,
        .derating    = in->derating};
    if (in->position != NULL) {
        update_position(s, c, drive, view, in->position);
    } else {
        const speed_ref_limits_t limits = current_ref_speed_limits(
            &s->current_ref, &c->current_ref, &drive->motor, &from, in->command_e_radps);
        speed_ref_update(&s->speed_ref, &limits, in->command_e_radps, w, drive->ts_s);
    }
    current_ref_update(&s->current_ref, &c->current_ref, &drive->motor, &s->speed_ref, &from);
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

CTL_PART nosc_error_t near_optimal_error(near_optimal_t *s, const near_optimal_config_t *c,
                                         const drive_config_t      *drive,
                                         const near_optimal_view_t *view, const law_input_t *in)
{
    choose_run(s, view, in->position, drive->ts_s);
    update_references(s, c, drive, view, in);

    const current_ref_t *ref = &s->current_ref;
    const float          e_w = view->now.omega_e_radps - s->speed_ref.omega_e_radps;
    nosc_error_t         e   = {.omega_e_radps = asking_e_radps(s, c, e_w),
                                .iq_A          = view->now.iq_A - ref->i_A.q,
                                .id_A          = view->now.id_A - ref->i_A.d};
    if (s->positioning) {
        e.omega_e_radps *= s->inertia.gain; /* EQ-INERTIA-4 */
    }
    nosc_error_t limited =
        nosc_limit_speed_error(near_optimal_gains(s, c), e, ref->i_A.q, ref->iq_lo_A, ref->iq_hi_A);
    if (s->positioning) {
        limited.omega_e_radps = shared_error(s, e_w, e.omega_e_radps, limited.omega_e_radps);
    }
    return limited;
}

/* EQ-FEEDFORWARD-1, 2 for the limited reference. */
static dq_t forward_V(const near_optimal_t *s, const motor_reduced_t *m,
                      const near_optimal_view_t *view, const nosc_error_t *e)
{
    const float w_d = view->now.omega_e_radps - e->omega_e_radps;

    return feedforward_V(m, &s->current_ref, w_d, &view->now, view->est);
}

/* EQ-VOLTAGE-2: the voltage that holds the requested currents (EQ-NOSC-3), and one gain for both
 * axes. It is written relative to the feed-forward. a is the q current requested by the errors
 * (EQ-POSITION-4), and x_q is the distance to it:
 *
 *     u_q = ff_q + (l5 e_w - l4 a - l10 w e_d) / l6 - k x_q,
 *     u_d = ff_d + w x_q / l6 - k l10 e_d,   x_q = e_q + a
 */
static dq_t out_of_reach_V(const near_optimal_t *s, const near_optimal_config_t *c,
                           const motor_reduced_t *m, float w, const nosc_error_t *e, dq_t ff_V)
{
    const nosc_gains_t *g     = near_optimal_gains(s, c);
    const float         k     = nosc_current_gain(g);
    const float         ask_A = g->speed_A_per_radps * asking_e_radps(s, c, e->omega_e_radps);
    const float         x_q   = e->iq_A + ask_A;
    const float         x_d   = m->l10 * e->id_A;
    const float         of_w  = (m->l5 * e->omega_e_radps) - (m->l4 * ask_A);

    const dq_t u_V = {.d = ff_V.d + (m->inv_l6 * w * x_q) - (k * x_d),
                      .q = ff_V.q + (m->inv_l6 * (of_w - (w * x_d))) - (k * x_q)};
    return u_V;
}

/* Clamps the voltage against currents beyond the limit, if the inverter can produce the clamped
 * one. Otherwise EQ-VOLTAGE-2 is the stable choice. Without need for a clamp the voltage stays
 * unchanged. */
static dq_t clamped_V(const near_optimal_config_t *c, const motor_reduced_t *m,
                      const near_optimal_view_t *view, dq_t u_V, bool reached,
                      const law_input_t *in)
{
    const float share =
        reached ? 1.0f
                : (in->sample->dc_link_V * BASE_1_SQRT3 * fpu_inverse_root(voltage_square(u_V)));
    const dq_t v_V  = {.d = share * u_V.d, .q = share * u_V.q};
    const dq_t held = current_clamp_V(m, view->est, &view->now, v_V, in->v_V,
                                      c->current_ref.current_max_A, c->current_ref.samples_1ps);
    const bool same = base_within(held.d - v_V.d, 0.0f) && base_within(held.q - v_V.q, 0.0f);

    return (same || voltage_is_outside(held, in->sample->dc_link_V)) ? u_V : held;
}

CTL_PART void near_optimal_answer(const near_optimal_t *s, const near_optimal_config_t *c,
                                  const motor_reduced_t *m, const near_optimal_view_t *view,
                                  const nosc_error_t *e, dq_t feedback_V, const law_input_t *in,
                                  law_output_t *out)
{
    const float dc_link_V = in->sample->dc_link_V;
    const dq_t  ff_V      = forward_V(s, m, view, e);
    dq_t        u_V     = {.d = feedback_V.d + ff_V.d, .q = feedback_V.q + ff_V.q}; /* EQ-DRIVE-1 */
    bool        reached = !voltage_is_outside(u_V, dc_link_V);

    if (!reached) {
        u_V     = out_of_reach_V(s, c, m, view->now.omega_e_radps, e, ff_V);
        reached = !voltage_is_outside(u_V, dc_link_V);
    }
    out->v_V             = clamped_V(c, m, view, u_V, reached, in);
    out->theta_rad       = view->theta_rad;
    out->now             = view->now;
    out->i_ref_A         = s->current_ref.i_A;
    out->d_omega         = view->est->d_omega;
    out->d_q             = view->est->d_q;
    out->d_d             = view->est->d_d;
    out->ignored_angles  = 0U;
    out->without_angle   = false;
    out->arrived         = s->position_ref.arrived;
    out->waits           = s->position_ref.waits;
    out->profile_e_radps = s->speed_ref.omega_e_radps;
    out->plausible       = view->plausible;
    out->predicted       = false;
}
