/* SPDX-License-Identifier: MIT */
#include "laws.h"

#include "check.h"

static bool feedback_check(const law_noc_shaft_feedback_t *c)
{
    return check_finite(&c->slip_A_per_radps, 1) && check_finite(&c->twist_A_per_rad, 1) &&
           check_positive(c->twist_per_accel) && check_positive(c->accel_per_d_omega);
}

static bool check(const drive_config_t *drive)
{
    const law_noc_shaft_config_t *c = drive->constants;

    return !drive->positions && near_optimal_check(&c->near_optimal, drive) &&
           encoder_form_check(&c->plausible) && angle_gate_check(&c->gate) &&
           encoder_form_gains_check(&c->rare) && nodo_shaft_check(&c->nodo) &&
           feedback_check(&c->shaft);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_noc_shaft_config_t *c = drive->constants;
    law_noc_shaft_state_t        *s = &state->noc_shaft;
    const nodo_meas_t             y = sample_measurement(sample);

    nodo_shaft_reset(&s->observer, &y, sample->theta_e_rad);
    encoder_form_edges_reset(&s->edges);
    angle_gate_reset(&s->gate, sample->theta_e_rad);
    near_optimal_reset(&s->near_optimal, &c->near_optimal, y.omega_e_radps);
}

static near_optimal_view_t observe(law_noc_shaft_state_t *s, const law_noc_shaft_config_t *c,
                                   const drive_config_t *drive, const law_input_t *in)
{
    nodo_shaft_t             *o     = &s->observer;
    const angle_gate_result_t angle = encoder_form_innovation(
        &s->gate, &s->edges, &c->gate, in->sample, &o->motor, o->theta_rad, drive->ts_s);
    float used_error = angle.innovation_rad;

    o->theta_rad   = encoder_form_jumped_rad(&angle, o->theta_rad);
    const dq_t i_A = sample_current_A(in->sample, o->theta_rad);
    if (encoder_form_is_rare(in->sample, drive->ts_s)) {
        used_error *= encoder_form_correct_rare(&o->motor, &o->theta_rad, &c->rare, used_error,
                                                in->sample->edge_gap_s, drive->ts_s);
    }
    nodo_shaft_correct(o, &c->nodo, i_A, used_error, drive->ts_s);
    nodo_shaft_predict(o, &c->nodo, &drive->motor, in->v_V, drive->ts_s);

    near_optimal_view_t view =
        encoder_form_view(&c->plausible, &o->motor, o->theta_rad, angle.error_rad, drive->ts_s);
    view.plausible = view.plausible && (s->gate.lost == 0);
    return view;
}

/* EQ-SHAFT-3, 4 with the acceleration of the reference. */
static float shaft_current_A(const law_noc_shaft_feedback_t *c, const nodo_shaft_t *o,
                             float accel_e_radps2)
{
    const float slip_e_radps = o->load_e_radps - o->motor.omega_e_radps;
    const float twist_ref_rad =
        c->twist_per_accel * (accel_e_radps2 - (c->accel_per_d_omega * o->motor.d_omega));

    return -(c->slip_A_per_radps * slip_e_radps) -
           (c->twist_A_per_rad * (o->twist_rad - twist_ref_rad));
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_noc_shaft_config_t *c    = drive->constants;
    law_noc_shaft_state_t        *s    = &state->noc_shaft;
    near_optimal_t               *n    = &s->near_optimal;
    const nosc_gains_t           *g    = &c->near_optimal.nosc;
    const near_optimal_view_t     view = observe(s, c, drive, in);
    nosc_error_t                  e    = near_optimal_error(n, &c->near_optimal, drive, &view, in);

    /* Speed and shaft together request no more than the limits of the q current allow. */
    const float iq_A    = n->current_ref.i_A.q - (g->speed_A_per_radps * e.omega_e_radps);
    const float shaft_A = shaft_current_A(&c->shaft, &s->observer, n->speed_ref.omega_dot_e_radps2);
    e.iq_A -= base_clamp(shaft_A, n->current_ref.iq_lo_A - iq_A, n->current_ref.iq_hi_A - iq_A);

    near_optimal_answer(n, &c->near_optimal, &drive->motor, &view, &e, nosc_feedback_V(g, &e), in,
                        out);
    out->ignored_angles = s->gate.ignored;
    out->without_angle  = s->gate.lost != 0;
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_noc_shaft_config_t *c = drive->constants;

    return near_optimal_counts_ok(&c->near_optimal) && (c->nodo.motor.order == 1);
}

const law_t law_noc_shaft = {.check           = check,
                             .reset           = reset,
                             .step            = step,
                             .counts_ok       = counts_ok,
                             .fields          = law_noc_shaft_fields,
                             .number          = 9U,
                             .constants_chars = (uint32_t)sizeof(law_noc_shaft_config_t)};
