/* SPDX-License-Identifier: MIT */
#include "laws.h"

/* The drive as law_noc knows it. */
static drive_config_t as_noc(const drive_config_t *drive)
{
    const law_noc_slow_config_t *c   = drive->constants;
    drive_config_t               noc = *drive;

    noc.law       = &law_noc;
    noc.constants = &c->noc;
    return noc;
}

static bool check(const drive_config_t *drive)
{
    const law_noc_slow_config_t *c   = drive->constants;
    const drive_config_t         noc = as_noc(drive);

    return law_noc.check(&noc) && base_in_range(c->share, 1.0e-6f, 1.0f);
}

static void reset(law_state_t *state, const drive_config_t *drive, const drive_sample_t *sample)
{
    const drive_config_t noc = as_noc(drive);

    law_noc.reset(state, &noc, sample);
    state->noc_slow.command_e_radps = sample->omega_e_radps;
}

static void step(law_state_t *state, const drive_config_t *drive, const law_input_t *in,
                 law_output_t *out)
{
    const law_noc_slow_config_t *c        = drive->constants;
    const drive_config_t         noc      = as_noc(drive);
    law_input_t                  filtered = *in;

    filtered.command_e_radps = state->noc_slow.command_e_radps;
    filtered.command_e_radps += c->share * (in->command_e_radps - filtered.command_e_radps);
    state->noc_slow.command_e_radps = filtered.command_e_radps;
    law_noc.step(state, &noc, &filtered, out);
}

static bool counts_ok(const drive_config_t *drive)
{
    const drive_config_t noc = as_noc(drive);

    return law_noc.counts_ok(&noc);
}

const law_t law_noc_slow = {.check           = check,
                            .reset           = reset,
                            .step            = step,
                            .counts_ok       = counts_ok,
                            .fields          = law_noc_slow_fields,
                            .number          = 11U,
                            .constants_chars = (uint32_t)sizeof(law_noc_slow_config_t)};
