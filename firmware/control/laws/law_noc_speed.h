/* SPDX-License-Identifier: MIT */
/**
 * @file law_noc_speed.h
 * @brief Near optimal control as in paper A: with measured speed, acting on the measurement.
 */
#ifndef LAW_NOC_SPEED_H
#define LAW_NOC_SPEED_H

#include "near_optimal.h"
#include "nodo.h"

typedef struct {
    near_optimal_config_t near_optimal;
    nodo_gains_t          nodo;
} law_noc_speed_config_t;

/** State, also of the conventional law. */
typedef struct {
    nodo_t         observer;
    near_optimal_t near_optimal;
} law_noc_speed_state_t;

void law_noc_speed_fields(fields_t *f, void *constants); /**< for law_noc_speed.fields */

extern const law_t law_noc_speed;

/** Starts a run from the measured speed. Context: control ISR. */
void law_noc_speed_reset(law_noc_speed_state_t *s, const near_optimal_config_t *c,
                         const drive_sample_t *sample);

/** The measurement as the law sees it; every angle is plausible. Context: control ISR. */
near_optimal_view_t law_noc_speed_view(law_noc_speed_state_t *s, const nodo_meas_t *y,
                                       const drive_sample_t *sample, float ts_s);

#endif /* LAW_NOC_SPEED_H */
