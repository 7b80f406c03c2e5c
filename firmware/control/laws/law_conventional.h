/* SPDX-License-Identifier: MIT */
/**
 * @file law_conventional.h
 * @brief Paper A's reference for comparison: the speed form with conventional.h.
 */
#ifndef LAW_CONVENTIONAL_H
#define LAW_CONVENTIONAL_H

#include "conventional.h"
#include "law_noc_speed.h"
#include "near_optimal.h"

typedef struct {
    near_optimal_config_t near_optimal; /**< nosc with Lambda_00 alone, for EQ-NOSC-3 */
    conventional_gains_t  gains;
} law_conventional_config_t;

typedef law_noc_speed_state_t law_conventional_state_t;

void law_conventional_fields(fields_t *f, void *constants); /**< for law_conventional.fields */

extern const law_t law_conventional;

#endif /* LAW_CONVENTIONAL_H */
