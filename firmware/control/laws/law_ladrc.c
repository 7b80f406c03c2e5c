/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "laws.h"

static bool gains_check(const law_ladrc_gains_t *g)
{
    return speed_observer_check(&g->observer) && check_positive(g->observer.gain_w) &&
           check_positive(g->observer.gain_f_1ps) && check_positive(g->w_c_1ps);
}

static bool check(const drive_config_t *drive)
{
    const law_ladrc_config_t *c = drive->constants;

    return foc_check(&c->foc, drive) && speed_difference_check(&c->speed, drive->ts_s) &&
           gains_check(&c->gains[SPEED_DIFFERENCE_COUNTED]) &&
           gains_check(&c->gains[SPEED_DIFFERENCE_TIMED]);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_ladrc_config_t *c = drive->constants;
    law_ladrc_state_t        *s = &state->ladrc;
    const nodo_meas_t         y = sample_measurement(sample);

    foc_reset(&s->foc);
    speed_difference_reset(&s->speed, &c->speed, sample, drive->ts_s);
    speed_observer_reset(&s->observer, &drive->motor, &y);
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_ladrc_config_t *c = drive->constants;
    law_ladrc_state_t        *s = &state->ladrc;
    nodo_meas_t               y = sample_measurement(in->sample);

    const law_ladrc_gains_t *g = &c->gains[speed_difference_update(&s->speed, &c->speed, in->sample,
                                                                   drive->ts_s, &y.omega_e_radps)];
    speed_observer_update(&s->observer, &g->observer, &drive->motor, &y, drive->ts_s);

    const float wanted_e_radps2 = (g->w_c_1ps * (in->command_e_radps - s->observer.z_e_radps)) -
                                  s->observer.z_f_e_radps2; /* EQ-LADRC-3 */
    foc_realise(&s->foc, &c->foc, in);
    foc_answer(&s->foc, &c->foc, drive, in, &y, wanted_e_radps2, out);
    out->d_omega = s->observer.z_f_e_radps2;
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_ladrc_config_t *c = drive->constants;

    return (c->speed.periods >= 1) && (c->speed.periods <= SPEED_DIFFERENCE_PERIODS_MAX);
}

const law_t law_ladrc = {.check           = check,
                         .reset           = reset,
                         .step            = step,
                         .counts_ok       = counts_ok,
                         .fields          = law_ladrc_fields,
                         .number          = 8U,
                         .constants_chars = (uint32_t)sizeof(law_ladrc_config_t)};
