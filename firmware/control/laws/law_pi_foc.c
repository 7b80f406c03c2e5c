/* SPDX-License-Identifier: MIT */
#include <stddef.h>

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

/* EQ-PI-FOC-6, before z_f is taken off: what is not a number then stays so. */
static float torque_e_radps2(const law_pi_foc_state_t *s, const law_pi_foc_gains_t *g,
                             const drive_config_t *drive, const torque_command_t *command,
                             float omega_e_radps)
{
    const float most  = command->speed_max_e_radps;
    const float asked = command->share * drive->rated_torque_Nm * drive->motor.l3;

    return base_clamp(asked + s->load.z_f_e_radps2, -g->kp_1ps * (most + omega_e_radps),
                      g->kp_1ps * (most - omega_e_radps));
}

static void speed_follows_command(law_pi_foc_state_t *s, const law_pi_foc_gains_t *g,
                                  float command_e_radps, float p_e_radps2)
{
    if (p_e_radps2 * s->foc.limit <= 0.0f) { /* EQ-PI-FOC-3 */
        s->sum_e_radps2 += g->ki_per_kp * p_e_radps2;
    }
    s->r_e_radps += g->ki_per_kp * (command_e_radps - s->r_e_radps); /* EQ-PI-FOC-1 */
}

/* A speed run that begins here has this torque. */
static void speed_follows_torque(law_pi_foc_state_t *s, const motor_reduced_t *m,
                                 float omega_e_radps)
{
    const dq_t i_A = s->foc.i_ref_A;

    s->r_e_radps    = omega_e_radps;
    s->sum_e_radps2 = ((m->l1 + (m->l11 * i_A.d)) * i_A.q) + s->load.z_f_e_radps2;
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

    const torque_command_t *torque = (in->aim == NULL) ? NULL : in->aim->torque;

    const float w          = y.omega_e_radps;
    const float p_e_radps2 = g->kp_1ps * (s->r_e_radps - w);
    const float wish       = (torque == NULL) ? (p_e_radps2 + s->sum_e_radps2) /* EQ-PI-FOC-2 */
                                              : torque_e_radps2(s, g, drive, torque, w);

    foc_realise(&s->foc, &c->foc, in);
    foc_answer(&s->foc, &c->foc, drive, in, &y, wish - s->load.z_f_e_radps2, out); /* EQ-PI-FOC-5 */
    out->d_omega = s->load.z_f_e_radps2;
    if (torque == NULL) {
        speed_follows_command(s, g, in->command_e_radps, p_e_radps2);
    } else {
        speed_follows_torque(s, &drive->motor, w);
        out->profile_e_radps = w;
    }
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
                          .takes_torque    = true,
                          .number          = 7U,
                          .constants_chars = (uint32_t)sizeof(law_pi_foc_config_t)};
