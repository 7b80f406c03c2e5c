/* SPDX-License-Identifier: MIT */
/**
 * @file fields_near_optimal.h
 * @brief Walk over the constants of reference and law of paper A.
 */
#ifndef FIELDS_NEAR_OPTIMAL_H
#define FIELDS_NEAR_OPTIMAL_H

#include "fields.h"
#include "near_optimal.h"

void fields_near_optimal(fields_t *f, near_optimal_config_t *c);

#endif /* FIELDS_NEAR_OPTIMAL_H */
