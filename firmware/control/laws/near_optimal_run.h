/* SPDX-License-Identifier: MIT */
/**
 * @file near_optimal_run.h
 * @brief Parts that runs to a speed, a position or a torque share. Internal to near_optimal.c,
 * near_optimal_position.c and noc_torque.c.
 *
 * `positioning` is a constant of each caller: a speed run never asks whether it is one.
 */
#ifndef NEAR_OPTIMAL_RUN_H
#define NEAR_OPTIMAL_RUN_H

#include "current_clamp.h"
#include "feedforward.h"
#include "fpu.h"
#include "near_optimal.h"
#include "voltage.h"

/** Gains in use: of the position design in a position run, otherwise of the speed design. */
static inline const nosc_gains_t *near_optimal_gains(const near_optimal_config_t *c,
                                                     bool                         positioning)
{
    return positioning ? &c->position.nosc : &c->nosc;
}

/** EQ-POSITION-4: combined error of speed and angle; in a speed run the speed error. */
static inline float near_optimal_asking_e_radps(const near_optimal_t        *s,
                                                const near_optimal_config_t *c,
                                                float speed_error_e_radps, bool positioning)
{
    return positioning ? (speed_error_e_radps + (c->position.speed_per_rad * s->theta_error_e_rad))
                       : speed_error_e_radps;
}

/** Inputs of the references, before these move. */
static inline current_ref_input_t near_optimal_inputs(const near_optimal_t        *s,
                                                      const near_optimal_config_t *c,
                                                      const near_optimal_view_t   *view,
                                                      const law_input_t *in, bool positioning)
{
    const nosc_gains_t *g    = near_optimal_gains(c, positioning);
    const float         dc_V = in->sample->dc_link_V;
    const float         e_w  = view->now.omega_e_radps - s->speed_ref.omega_e_radps;
    const float         ask  = near_optimal_asking_e_radps(s, c, e_w, positioning);

    const current_ref_input_t from = {.est         = view->est,
                                      .state       = &view->now,
                                      .iq_speed_A  = nosc_speed_current_A(g, ask),
                                      .dc_link_V   = dc_V,
                                      .v_max_Aps   = c->current_ref.circle_ApVs * dc_V,
                                      .d_omega_dot = view->d_omega_dot,
                                      .derating    = in->derating};
    return from;
}

/** EQ-FEEDFORWARD-1, 2 for the limited reference. */
static inline dq_t near_optimal_forward_V(const near_optimal_t *s, const motor_reduced_t *m,
                                          const near_optimal_view_t *view, const nosc_error_t *e)
{
    const float w_d = view->now.omega_e_radps - e->omega_e_radps;

    return feedforward_V(m, &s->current_ref, w_d, &view->now, view->est);
}

/** EQ-VOLTAGE-2: the voltage that holds the requested currents (EQ-NOSC-3), and one gain for both
 * axes. It is written relative to the feed-forward. a is the q current requested by the errors
 * (EQ-POSITION-4), and x_q is the distance to it:
 *
 *     u_q = ff_q + (l5 e_w - l4 a - l10 w e_d) / l6 - k x_q,
 *     u_d = ff_d + w x_q / l6 - k l10 e_d,   x_q = e_q + a
 */
static inline dq_t near_optimal_out_of_reach_V(const near_optimal_t        *s,
                                               const near_optimal_config_t *c,
                                               const motor_reduced_t *m, float w,
                                               const nosc_error_t *e, dq_t ff_V, bool positioning)
{
    const nosc_gains_t *g = near_optimal_gains(c, positioning);
    const float         k = nosc_current_gain(g);
    const float         ask_A =
        g->speed_A_per_radps * near_optimal_asking_e_radps(s, c, e->omega_e_radps, positioning);
    const float x_q  = e->iq_A + ask_A;
    const float x_d  = m->l10 * e->id_A;
    const float of_w = (m->l5 * e->omega_e_radps) - (m->l4 * ask_A);

    const dq_t u_V = {.d = ff_V.d + (m->inv_l6 * w * x_q) - (k * x_d),
                      .q = ff_V.q + (m->inv_l6 * (of_w - (w * x_d))) - (k * x_q)};
    return u_V;
}

/** Clamps the voltage against currents beyond the limit, if the inverter can produce the clamped
 * one. Otherwise EQ-VOLTAGE-2 is the stable choice. Without need for a clamp the voltage stays
 * unchanged. */
static inline dq_t near_optimal_clamped_V(const near_optimal_config_t *c, const motor_reduced_t *m,
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

/** The members of an answer beside its voltage. */
static inline void near_optimal_run_fill(const near_optimal_t *s, const near_optimal_view_t *view,
                                         law_output_t *out, bool positioning)
{
    out->theta_rad       = view->theta_rad;
    out->now             = view->now;
    out->i_ref_A         = s->current_ref.i_A;
    out->d_omega         = view->est->d_omega;
    out->d_q             = view->est->d_q;
    out->d_d             = view->est->d_d;
    out->ignored_angles  = 0U;
    out->without_angle   = false;
    out->arrived         = positioning && s->position_ref.arrived;
    out->waits           = positioning && s->position_ref.waits;
    out->profile_e_radps = s->speed_ref.omega_e_radps;
    out->plausible       = view->plausible;
    out->predicted       = false;
}

/** near_optimal_answer() of a run to a speed or a position. */
static inline void near_optimal_run_answer(const near_optimal_t *s, const near_optimal_config_t *c,
                                           const motor_reduced_t     *m,
                                           const near_optimal_view_t *view, const nosc_error_t *e,
                                           dq_t feedback_V, const law_input_t *in,
                                           law_output_t *out, bool positioning)
{
    const float dc_link_V = in->sample->dc_link_V;
    const dq_t  ff_V      = near_optimal_forward_V(s, m, view, e);
    dq_t        u_V     = {.d = feedback_V.d + ff_V.d, .q = feedback_V.q + ff_V.q}; /* EQ-DRIVE-1 */
    bool        reached = !voltage_is_outside(u_V, dc_link_V);

    if (!reached) {
        u_V = near_optimal_out_of_reach_V(s, c, m, view->now.omega_e_radps, e, ff_V, positioning);
        reached = !voltage_is_outside(u_V, dc_link_V);
    }
    near_optimal_run_fill(s, view, out, positioning);
    out->v_V = near_optimal_clamped_V(c, m, view, u_V, reached, in);
}

#endif /* NEAR_OPTIMAL_RUN_H */
