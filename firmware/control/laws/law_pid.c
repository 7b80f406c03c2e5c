/* SPDX-License-Identifier: MIT */
#include "feedforward.h"
#include "laws.h"
#include "servo.h"

static bool check(const drive_config_t *drive)
{
    const law_pid_config_t *c = drive->constants;

    return pid_law_check(&c->pid) && pid_law_check(&c->id_pi);
}

/* The integral starts at the back-EMF, for a bumpless start of a turning motor. */
static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    law_pid_state_t  *s = &state->pid;
    const nodo_meas_t y = sample_measurement(sample);

    pid_law_reset(&s->pid, feedforward_hold_q_V(&drive->motor, &y, 0.0f));
    pid_law_reset(&s->id_pi, 0.0f);
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_pid_config_t *c       = drive->constants;
    law_pid_state_t        *s       = &state->pid;
    const nodo_meas_t       y       = sample_measurement(in->sample);
    const float             e_radps = in->command_e_radps - y.omega_e_radps;
    dq_t                    v_V;

    v_V.d = servo_d_voltage_V(&s->id_pi, &c->id_pi, in, y.id_A);
    pid_law_realise(&s->pid, &c->pid, in->v_V.q);
    v_V.q = pid_law_update(&s->pid, &c->pid, e_radps);
    servo_answer(drive, in, &y, v_V, out);
}

const law_t law_pid = {.check           = check,
                       .reset           = reset,
                       .step            = step,
                       .fields          = law_pid_fields,
                       .number          = 6U,
                       .constants_chars = (uint32_t)sizeof(law_pid_config_t)};
