/* SPDX-License-Identifier: MIT */
/**
 * @file law_noc.h
 * @brief Near optimal control of paper A with an observer that measures the encoder's angle.
 *
 * This sample corrects the observer. The observer then predicts the instant at which the new
 * voltage takes effect. References and law act on the prediction.
 */
#ifndef LAW_NOC_ENCODER_H
#define LAW_NOC_ENCODER_H

#include "encoder_form.h"
#include "near_optimal.h"
#include "nodo_current.h"
#include "nodo_encoder.h"

typedef struct {
    near_optimal_config_t near_optimal;
    encoder_form_limits_t plausible;
    angle_gate_config_t   gate;
    encoder_form_gains_t  rare; /**< for edges that are rarer than samples */
    nodo_encoder_gains_t  nodo;
    nodo_current_gains_t  currents; /**< for a lost encoder */
} law_noc_config_t;

typedef struct {
    nodo_t               observer;
    float                theta_hat_rad; /**< estimated electrical angle, within +-pi */
    near_optimal_t       near_optimal;
    encoder_form_edges_t edges;
    angle_gate_t         gate;
    nodo_current_t       without; /**< encoder */
} law_noc_state_t;

void law_noc_fields(fields_t *f, void *constants); /**< for law_noc.fields */

extern const law_t law_noc;

#endif /* LAW_NOC_ENCODER_H */
