/* SPDX-License-Identifier: MIT */
#include "laws.h"
#include "servo.h"

static bool check(const drive_config_t *drive)
{
    const law_dobc_config_t *c = drive->constants;

    return dobc_check(&c->dobc) && pid_law_check(&c->id_pi);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    law_dobc_state_t *s = &state->dobc;

    (void)drive;
    (void)sample;
    dobc_reset(&s->dobc);
    pid_law_reset(&s->id_pi, 0.0f);
    s->direct_V = 0.0f;
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_dobc_config_t *c       = drive->constants;
    law_dobc_state_t        *s       = &state->dobc;
    const nodo_meas_t        y       = sample_measurement(in->sample);
    const float              e_radps = in->command_e_radps - y.omega_e_radps;
    dq_t                     v_V;

    v_V.d = servo_d_voltage_V(&s->id_pi, &c->id_pi, in, y.id_A);
    dobc_realise(&s->dobc, in->v_V.q - s->direct_V);
    s->direct_V = dobc_direct_V(&c->dobc, y.omega_e_radps, y.id_A);
    v_V.q       = s->direct_V + dobc_update(&s->dobc, &c->dobc, e_radps);
    servo_answer(drive, in, &y, v_V, out);
}

static bool counts_ok(const drive_config_t *drive)
{
    const law_dobc_config_t *c = drive->constants;

    return (c->dobc.n_x >= 1) && (c->dobc.n_x <= DOBC_N_X_MAX);
}

const law_t law_dobc = {.check           = check,
                        .reset           = reset,
                        .step            = step,
                        .counts_ok       = counts_ok,
                        .fields          = law_dobc_fields,
                        .number          = 5U,
                        .constants_chars = (uint32_t)sizeof(law_dobc_config_t)};
