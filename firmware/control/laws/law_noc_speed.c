/* SPDX-License-Identifier: MIT */
#include "laws.h"

static bool check(const drive_config_t *drive)
{
    const law_noc_speed_config_t *c = drive->constants;

    return near_optimal_check(&c->near_optimal, drive) && nodo_check(&c->nodo);
}

void law_noc_speed_reset(law_noc_speed_state_t *s, const near_optimal_config_t *c,
                         const drive_sample_t *sample)
{
    const nodo_meas_t y = sample_measurement(sample);

    nodo_reset(&s->observer, &y);
    near_optimal_reset(&s->near_optimal, c, y.omega_e_radps);
}

near_optimal_view_t law_noc_speed_view(law_noc_speed_state_t *s, const nodo_meas_t *y,
                                       const drive_sample_t *sample, float ts_s)
{
    const near_optimal_view_t view = {.est         = &s->observer,
                                      .now         = *y,
                                      .d_omega_dot = 0.0f,
                                      .theta_rad   = sample_middle_angle_rad(sample, ts_s),
                                      .plausible   = true};
    return view;
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_noc_speed_config_t *c = drive->constants;

    law_noc_speed_reset(&state->noc_speed, &c->near_optimal, sample);
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_noc_speed_config_t *c = drive->constants;
    law_noc_speed_state_t        *s = &state->noc_speed;
    const nodo_meas_t             y = sample_measurement(in->sample);

    nodo_update(&s->observer, &c->nodo, &drive->motor, &y, in->v_V, drive->ts_s);

    const near_optimal_view_t view = law_noc_speed_view(s, &y, in->sample, drive->ts_s);
    near_optimal_step(&s->near_optimal, &c->near_optimal, drive, &view, in, out);
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_noc_speed_config_t *c = drive->constants;

    return near_optimal_counts_ok(&c->near_optimal) && (c->nodo.order >= 0) &&
           (c->nodo.order <= NODO_ORDER_MAX);
}

const law_t law_noc_speed = {.check           = check,
                             .reset           = reset,
                             .step            = step,
                             .counts_ok       = counts_ok,
                             .fields          = law_noc_speed_fields,
                             .number          = 2U,
                             .constants_chars = (uint32_t)sizeof(law_noc_speed_config_t)};
