/* SPDX-License-Identifier: MIT */
/**
 * @file law_answer.h
 * @brief Answer of a law in a period. The output holds nonsense before the call, so that a member that a law does not set shows.
 */
#ifndef LAW_ANSWER_H
#define LAW_ANSWER_H

#include <string.h>

#include "drive_config.h"
#include "laws.h"

static inline law_output_t law_answer(const drive_config_t *drive, law_state_t *state,
                                      const law_input_t *in)
{
    law_output_t out;

    memset(&out, 0x55, sizeof(out));
    out.plausible = !in->sample->valid;
    drive->law->step(state, drive, in, &out);
    return out;
}

#endif /* LAW_ANSWER_H */
