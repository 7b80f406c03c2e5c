/* SPDX-License-Identifier: MIT */
/**
 * @file fields_foc.h
 * @brief Walks over the constants of field-oriented control.
 */
#ifndef FIELDS_FOC_H
#define FIELDS_FOC_H

#include "fields.h"
#include "foc.h"
#include "speed_difference.h"
#include "speed_observer.h"

void fields_foc(fields_t *f, foc_config_t *c);
void fields_speed_difference(fields_t *f, speed_difference_config_t *c);
void fields_speed_observer(fields_t *f, speed_observer_gains_t *c);

#endif /* FIELDS_FOC_H */
