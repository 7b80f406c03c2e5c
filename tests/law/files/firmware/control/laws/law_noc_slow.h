/* SPDX-License-Identifier: MIT */
/**
 * @file law_noc_slow.h
 * @brief A law for the test of the recipe: law_noc with a filtered speed command.
 */
#ifndef LAW_NOC_SLOW_H
#define LAW_NOC_SLOW_H

#include "law_noc.h"

typedef struct {
    law_noc_config_t noc;
    float            share; /**< of the way to the command in a period, (0, 1] */
} law_noc_slow_config_t;

typedef struct {
    law_noc_state_t noc;             /**< first: where law_noc looks for its state */
    float           command_e_radps; /**< filtered */
} law_noc_slow_state_t;

void law_noc_slow_fields(fields_t *f, void *constants); /**< for law_noc_slow.fields */

extern const law_t law_noc_slow;

#endif /* LAW_NOC_SLOW_H */
