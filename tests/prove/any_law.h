/* SPDX-License-Identifier: MIT */
/**
 * @file any_law.h
 * @brief A law that answers anything, for the analyser: what holds under it holds under every law.
 */
#ifndef ANY_LAW_H
#define ANY_LAW_H

#include "any.h"
#include "drive_tick.h"

volatile law_output_t any_answer;

static bool check(const drive_config_t *c)
{
    (void)c;
    return any_bool();
}

static void reset(law_state_t *state, const drive_config_t *c, const drive_sample_t *sample)
{
    (void)c;
    (void)sample;
    state->own[0] = 0.0f;
}

static void step(law_state_t *state, const drive_config_t *c, const law_input_t *in,
                 law_output_t *out)
{
    (void)state;
    (void)c;
    (void)in;
    *out               = any_answer;
    out->plausible     = any_bool();
    out->without_angle = any_bool();
    out->predicted     = any_bool();
}

static const law_t any_law = {.check = check, .reset = reset, .step = step};

#endif /* ANY_LAW_H */
