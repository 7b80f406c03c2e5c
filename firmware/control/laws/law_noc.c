/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "laws.h"
#include "near_optimal_position.h"
#include "noc_torque.h"

static bool check(const drive_config_t *drive)
{
    const law_noc_config_t *c = drive->constants;

    return near_optimal_check(&c->near_optimal, drive) &&
           (!drive->torques || torque_loop_check(&c->torque)) &&
           encoder_form_check(&c->plausible) && angle_gate_check(&c->gate) &&
           encoder_form_gains_check(&c->rare) && nodo_encoder_check(&c->nodo) &&
           nodo_current_check(&c->currents) &&
           base_in_range(c->inertia.least, INERTIA_LEAST, 1.0f) &&
           base_in_range(c->inertia.most, 1.0f, INERTIA_MOST);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_noc_config_t *c = drive->constants;
    law_noc_state_t        *s = &state->noc;
    const nodo_meas_t       y = sample_measurement(sample);

    nodo_reset(&s->observer, &y);
    s->theta_hat_rad = frames_wrap(sample->theta_e_rad);
    encoder_form_edges_reset(&s->edges);
    angle_gate_reset(&s->gate, sample->theta_e_rad);
    nodo_current_reset(&s->without);
    near_optimal_reset(&s->near_optimal, &c->near_optimal, y.omega_e_radps);
}

/* Corrects with an encoder whose angle is used, or ignored for some samples. */
static void correct(law_noc_state_t *s, const law_noc_config_t *c, const drive_config_t *drive,
                    const drive_sample_t *sample, const angle_gate_result_t *angle)
{
    float used_error = angle->innovation_rad;

    s->theta_hat_rad = encoder_form_jumped_rad(angle, s->theta_hat_rad);
    const dq_t i_A   = sample_current_A(sample, s->theta_hat_rad);
    if (encoder_form_is_rare(sample, drive->ts_s)) {
        used_error *= encoder_form_correct_rare(&s->observer, &s->theta_hat_rad, &c->rare,
                                                used_error, sample->edge_gap_s, drive->ts_s);
    }
    nodo_encoder_correct(&s->observer, &s->theta_hat_rad, &c->nodo, i_A, used_error, drive->ts_s);
}

static near_optimal_view_t observe(law_noc_state_t *s, const law_noc_config_t *c,
                                   const drive_config_t *drive, const law_input_t *in)
{
    const angle_gate_result_t angle = encoder_form_innovation(
        &s->gate, &s->edges, &c->gate, in->sample, &s->observer, s->theta_hat_rad, drive->ts_s);

    bool knows = true;
    if (s->gate.lost != 0) {
        knows = nodo_current_correct(&s->without, &s->observer, &s->theta_hat_rad, &c->currents,
                                     &drive->motor, sample_current_A(in->sample, s->theta_hat_rad));
    } else {
        correct(s, c, drive, in->sample, &angle);
    }
    nodo_encoder_predict(&s->observer, &s->theta_hat_rad, &drive->motor, in->v_V, drive->ts_s);

    const bool held = (s->gate.lost != 0) || (s->gate.beyond > 1); /* and found out about */
    near_optimal_view_t view = encoder_form_view(&c->plausible, &s->observer, s->theta_hat_rad,
                                                 held ? 0.0f : angle.error_rad, drive->ts_s);
    view.plausible           = view.plausible && knows;
    return view;
}

/* A run to a position or a torque. */
static void other_step(law_noc_state_t *s, const law_noc_config_t *c, const drive_config_t *drive,
                       const near_optimal_view_t *view, const law_input_t *in, law_output_t *out)
{
    if (in->aim->position != NULL) {
        near_optimal_position_step(&s->near_optimal, &c->near_optimal, drive, view, in, out);
    } else {
        noc_torque_step(s, c, drive, view, in, out);
    }
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_noc_config_t   *c    = drive->constants;
    law_noc_state_t          *s    = &state->noc;
    const near_optimal_view_t view = observe(s, c, drive, in);
    if (in->aim == NULL) {
        near_optimal_step(&s->near_optimal, &c->near_optimal, drive, &view, in, out);
    } else {
        const near_optimal_view_t its_own = view; /* in a speed run the view is in registers */
        other_step(s, c, drive, &its_own, in, out);
    }
    out->ignored_angles = s->gate.ignored;
    out->without_angle  = s->gate.lost != 0;
    out->predicted      = s->gate.lost == 0; /* without encoder it would blame the sensors */
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_noc_config_t *c = drive->constants;

    return near_optimal_counts_ok(&c->near_optimal) && (c->nodo.order >= 0) &&
           (c->nodo.order <= NODO_ORDER_MAX);
}

const law_t law_noc = {.check           = check,
                       .reset           = reset,
                       .step            = step,
                       .believe         = law_noc_believe,
                       .adopt           = law_noc_adopt,
                       .counts_ok       = counts_ok,
                       .fields          = law_noc_fields,
                       .takes_torque    = true,
                       .number          = 1U,
                       .constants_chars = (uint32_t)sizeof(law_noc_config_t)};
