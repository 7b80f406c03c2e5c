/* SPDX-License-Identifier: MIT */
#include "laws.h"

static bool check(const drive_config_t *drive)
{
    const law_conventional_config_t *c = drive->constants;

    return near_optimal_check(&c->near_optimal, drive) && conventional_check(&c->gains);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_conventional_config_t *c = drive->constants;

    law_noc_speed_reset(&state->conventional, &c->near_optimal, sample);
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_conventional_config_t *c = drive->constants;
    law_conventional_state_t        *s = &state->conventional;
    const motor_reduced_t           *m = &drive->motor;
    const nodo_meas_t                y = sample_measurement(in->sample);

    conventional_update(&s->observer, &c->gains, m, &y, in->v_V, drive->ts_s);

    const near_optimal_view_t view = law_noc_speed_view(s, &y, in->sample, drive->ts_s);
    const nosc_error_t e = near_optimal_error(&s->near_optimal, &c->near_optimal, drive, &view, in);

    near_optimal_answer(&s->near_optimal, &c->near_optimal, m, &view, &e,
                        conventional_feedback_V(&c->gains, m, &e), in, out);
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_conventional_config_t *c = drive->constants;

    return (c->gains.nosc_order >= 0) && (c->gains.nosc_order <= DOUBLE_SERIES_ORDER_MAX) &&
           (c->gains.nodo_order >= 0) && (c->gains.nodo_order <= DOUBLE_SERIES_ORDER_MAX);
}

const law_t law_conventional = {.check           = check,
                                .reset           = reset,
                                .step            = step,
                                .counts_ok       = counts_ok,
                                .fields          = law_conventional_fields,
                                .number          = 4U,
                                .constants_chars = (uint32_t)sizeof(law_conventional_config_t)};
