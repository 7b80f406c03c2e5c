/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "laws.h"

static bool gains_check(const law_pi_foc_gains_t *g)
{
    return check_positive(g->kp_1ps) && base_in_range(g->ki_per_kp, 1.0e-9f, 1.0f) &&
           speed_observer_check(&g->load);
}

static bool check(const drive_config_t *drive)
{
    const law_pi_foc_config_t *c = drive->constants;

    return foc_check(&c->foc, drive) && speed_difference_check(&c->speed, drive->ts_s) &&
           gains_check(&c->gains[SPEED_DIFFERENCE_COUNTED]) &&
           gains_check(&c->gains[SPEED_DIFFERENCE_TIMED]);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const law_pi_foc_config_t *c = drive->constants;
    law_pi_foc_state_t        *s = &state->pi_foc;
    const nodo_meas_t          y = sample_measurement(sample);

    foc_reset(&s->foc);
    speed_difference_reset(&s->speed, &c->speed, sample, drive->ts_s);
    speed_observer_reset(&s->load, &drive->motor, &y);
    s->r_e_radps    = sample->omega_e_radps;
    s->sum_e_radps2 = 0.0f;
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_pi_foc_config_t *c = drive->constants;
    law_pi_foc_state_t        *s = &state->pi_foc;
    nodo_meas_t                y = sample_measurement(in->sample);

    const law_pi_foc_gains_t *g = &c->gains[speed_difference_update(
        &s->speed, &c->speed, in->sample, drive->ts_s, &y.omega_e_radps)];
    speed_observer_update(&s->load, &g->load, &drive->motor, &y, drive->ts_s);

    const float p_e_radps2 = g->kp_1ps * (s->r_e_radps - y.omega_e_radps);

    foc_realise(&s->foc, &c->foc, in);
    foc_answer(&s->foc, &c->foc, drive, in, &y,
               (p_e_radps2 + s->sum_e_radps2) - s->load.z_f_e_radps2, out); /* EQ-PI-FOC-2, 5 */
    out->d_omega = s->load.z_f_e_radps2;
    if (p_e_radps2 * s->foc.limit <= 0.0f) { /* EQ-PI-FOC-3 */
        s->sum_e_radps2 += g->ki_per_kp * p_e_radps2;
    }
    s->r_e_radps += g->ki_per_kp * (in->command_e_radps - s->r_e_radps); /* EQ-PI-FOC-1 */
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_pi_foc_config_t *c = drive->constants;

    return (c->speed.periods >= 1) && (c->speed.periods <= SPEED_DIFFERENCE_PERIODS_MAX);
}

const law_t law_pi_foc = {.check           = check,
                          .reset           = reset,
                          .step            = step,
                          .counts_ok       = counts_ok,
                          .fields          = law_pi_foc_fields,
                          .number          = 7U,
                          .constants_chars = (uint32_t)sizeof(law_pi_foc_config_t)};
