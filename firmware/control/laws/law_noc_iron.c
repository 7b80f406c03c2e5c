/* SPDX-License-Identifier: MIT */
#include "laws.h"

static bool check(const drive_config_t *drive)
{
    const law_noc_iron_config_t *c = drive->constants;

    return !drive->positions && near_optimal_check(&c->near_optimal, drive) &&
           encoder_form_check(&c->plausible) && angle_gate_check(&c->gate) &&
           encoder_form_gains_check(&c->rare) && nodo_encoder_check(&c->nodo) &&
           nodo_current_check(&c->currents) && iron_check(&c->iron);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_noc_iron_config_t *c = drive->constants;
    law_noc_iron_state_t        *s = &state->noc_iron;
    const nodo_meas_t            y = sample_measurement(sample);

    nodo_reset(&s->observer, &y);
    s->theta_hat_rad = frames_wrap(sample->theta_e_rad);
    s->tangent       = iron_tangent(&c->iron, &drive->motor, y.id_A, y.iq_A);
    encoder_form_edges_reset(&s->edges);
    angle_gate_reset(&s->gate, sample->theta_e_rad);
    nodo_current_reset(&s->without);
    near_optimal_reset(&s->near_optimal, &c->near_optimal, y.omega_e_radps);
}

/* Corrects with an encoder whose angle is used, or ignored for some samples. */
static void correct(law_noc_iron_state_t *s, const law_noc_iron_config_t *c,
                    const drive_config_t *drive, const drive_sample_t *sample,
                    const angle_gate_result_t *angle)
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

/* Predicts with the tangent of the period before. The next one is at the predicted currents. */
static void predict(law_noc_iron_state_t *s, const law_noc_iron_config_t *c,
                    const drive_config_t *drive, dq_t v_V)
{
    const motor_reduced_t *m    = &s->tangent.motor;
    const float            lq_H = m->inv_l6;
    const float            ld_H = m->inv_l8;

    iron_predict(&s->observer, &s->theta_hat_rad, &c->iron, &s->tangent, v_V, drive->ts_s);
    s->tangent = iron_tangent(&c->iron, &drive->motor, s->observer.id_A, s->observer.iq_A);
    s->observer.d_q *= lq_H * m->l6; /* EQ-IRON-4 */
    s->observer.d_d *= ld_H * m->l8;
}

static near_optimal_view_t observe(law_noc_iron_state_t *s, const law_noc_iron_config_t *c,
                                   const drive_config_t *drive, const law_input_t *in)
{
    const angle_gate_result_t angle = encoder_form_innovation(
        &s->gate, &s->edges, &c->gate, in->sample, &s->observer, s->theta_hat_rad, drive->ts_s);

    bool knows = true;
    if (s->gate.lost != 0) {
        knows =
            nodo_current_correct(&s->without, &s->observer, &s->theta_hat_rad, &c->currents,
                                 &s->tangent.motor, sample_current_A(in->sample, s->theta_hat_rad));
    } else {
        correct(s, c, drive, in->sample, &angle);
    }
    predict(s, c, drive, in->v_V);

    const bool held = (s->gate.lost != 0) || (s->gate.beyond > 1); /* and found out about */
    near_optimal_view_t view = encoder_form_view(&c->plausible, &s->observer, s->theta_hat_rad,
                                                 held ? 0.0f : angle.error_rad, drive->ts_s);
    view.plausible           = view.plausible && knows;
    return view;
}

/* The constants of the tangent's motor. The circle is a current over l6, and the gain beyond it
 * keeps the dynamics of the currents. */
static void scale(near_optimal_config_t *now, const near_optimal_config_t *c, float to_l6,
                  float to_lq)
{
    *now = *c;
    now->current_ref.circle_ApVs *= to_l6;
    now->current_ref.flux_A *= to_l6;
    now->current_ref.l1_min *= base_min(to_lq, 1.0f); /* the jerk of the constants */
    now->nosc.lambda[0][0][1] *= to_lq;
}

/* EQ-IRON-3 */
static dq_t iron_V(const iron_tangent_t *t, const motor_reduced_t *plain, dq_t v_V)
{
    const float iq_dot_Aps = plain->l6 * v_V.q;
    const float id_dot_Aps = plain->l8 * v_V.d;
    const dq_t  of_iron_V  = {.d = (t->motor.inv_l8 * id_dot_Aps) + (t->m_H * iq_dot_Aps),
                              .q = (t->motor.inv_l6 * iq_dot_Aps) + (t->m_H * id_dot_Aps)};
    return of_iron_V;
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_noc_iron_config_t *c     = drive->constants;
    law_noc_iron_state_t        *s     = &state->noc_iron;
    near_optimal_t              *n     = &s->near_optimal;
    near_optimal_view_t          view  = observe(s, c, drive, in);
    const motor_reduced_t       *m     = &s->tangent.motor;
    const float                  to_lq = drive->motor.l6 * m->inv_l6;

    near_optimal_config_t scaled;
    drive_config_t        iron = *drive;
    nodo_t                est  = iron_estimates(&c->iron, &s->tangent, &s->observer);

    scale(&scaled, &c->near_optimal, drive->motor.inv_l6 * m->l6, to_lq);
    iron.motor           = *m;
    view.est             = &est;
    const nosc_error_t e = near_optimal_error(n, &scaled, &iron, &view, in);
    const dq_t         feedback_V =
        iron_V(&s->tangent, &drive->motor, nosc_feedback_V(&c->near_optimal.nosc, &e));
    near_optimal_answer(n, &scaled, m, &view, &e, feedback_V, in, out);
    out->d_omega        = s->observer.d_omega;
    out->d_q            = s->observer.d_q;
    out->d_d            = s->observer.d_d;
    out->ignored_angles = s->gate.ignored;
    out->without_angle  = s->gate.lost != 0;
    out->predicted      = s->gate.lost == 0; /* without encoder it would blame the sensors */
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_noc_iron_config_t *c = drive->constants;

    return near_optimal_counts_ok(&c->near_optimal) && (c->nodo.order >= 0) &&
           (c->nodo.order <= NODO_ORDER_MAX);
}

const law_t law_noc_iron = {.check           = check,
                            .reset           = reset,
                            .step            = step,
                            .counts_ok       = counts_ok,
                            .fields          = law_noc_iron_fields,
                            .number          = 10U,
                            .constants_chars = (uint32_t)sizeof(law_noc_iron_config_t)};
