/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "laws.h"
#include "near_optimal_position.h"

static bool check(const drive_config_t *drive)
{
    const law_noc_h_config_t *c = drive->constants;

    return near_optimal_check(&c->near_optimal, drive) && encoder_form_check(&c->plausible) &&
           angle_gate_check(&c->gate) && encoder_form_gains_check(&c->rare) &&
           nodo_harmonic_check(&c->nodo);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_noc_h_config_t *c = drive->constants;
    law_noc_h_state_t        *s = &state->noc_h;
    const nodo_meas_t         y = sample_measurement(sample);

    nodo_harmonic_reset(&s->observer, &y, sample->theta_e_rad);
    nodo_reset(&s->known.total, &y);
    s->known.d_omega_dot = 0.0f;
    encoder_form_edges_reset(&s->edges);
    angle_gate_reset(&s->gate, sample->theta_e_rad);
    near_optimal_reset(&s->near_optimal, &c->near_optimal, y.omega_e_radps);
    s->near_optimal.inertia.gain_most = 1.0f; /* with more and J x3 the loop is unstable */
}

static near_optimal_view_t observe(law_noc_h_state_t *s, const law_noc_h_config_t *c,
                                   const drive_config_t *drive, const law_input_t *in)
{
    const angle_gate_result_t angle =
        encoder_form_innovation(&s->gate, &s->edges, &c->gate, in->sample, &s->observer.base,
                                s->observer.theta_rad, drive->ts_s);
    float used_error = angle.innovation_rad;

    s->observer.theta_rad = encoder_form_jumped_rad(&angle, s->observer.theta_rad);
    const dq_t i_A        = sample_current_A(in->sample, s->observer.theta_rad);
    if (encoder_form_is_rare(in->sample, drive->ts_s)) {
        used_error *= encoder_form_correct_rare(&s->observer.base, &s->observer.theta_rad, &c->rare,
                                                used_error, in->sample->edge_gap_s, drive->ts_s);
    }
    nodo_harmonic_correct(&s->observer, &c->nodo, i_A, used_error);
    nodo_harmonic_predict(&s->observer, &c->nodo, &drive->motor, in->v_V, drive->ts_s, &s->known);

    near_optimal_view_t view = encoder_form_view(
        &c->plausible, &s->known.total, s->observer.theta_rad, angle.error_rad, drive->ts_s);
    view.plausible   = view.plausible && (s->gate.lost == 0);
    view.d_omega_dot = s->known.d_omega_dot;
    return view;
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_noc_h_config_t *c       = drive->constants;
    law_noc_h_state_t        *s       = &state->noc_h;
    const near_optimal_view_t view    = observe(s, c, drive, in);
    const float               d_omega = view.est->d_omega;
    if ((in->aim == NULL) || (in->aim->position == NULL)) { /* it takes no torques */
        near_optimal_step(&s->near_optimal, &c->near_optimal, drive, &view, in, out);
    } else {
        const near_optimal_view_t its_own = view; /* in a speed run the view is in registers */
        near_optimal_position_step(&s->near_optimal, &c->near_optimal, drive, &its_own, in, out);
    }
    s->observer.base.d_omega += view.est->d_omega - d_omega; /* EQ-INERTIA-3 */
    out->ignored_angles = s->gate.ignored;
    out->without_angle  = s->gate.lost != 0;
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_noc_h_config_t *c = drive->constants;

    return near_optimal_counts_ok(&c->near_optimal) && nodo_harmonic_counts_ok(&c->nodo);
}

const law_t law_noc_h = {.check           = check,
                         .reset           = reset,
                         .step            = step,
                         .counts_ok       = counts_ok,
                         .fields          = law_noc_h_fields,
                         .number          = 3U,
                         .constants_chars = (uint32_t)sizeof(law_noc_h_config_t)};
