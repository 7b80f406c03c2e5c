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
#include "torque_loop.h"

/** Certified range of the believed inertia over the drive's. */
typedef struct {
    float least; /**< 0.5 .. 1 */
    float most;  /**< 1 .. 5 */
} law_noc_inertia_t;

typedef struct {
    near_optimal_config_t near_optimal;
    encoder_form_limits_t plausible;
    angle_gate_config_t   gate;
    encoder_form_gains_t  rare; /**< for edges that are rarer than samples */
    nodo_encoder_gains_t  nodo;
    nodo_current_gains_t  currents; /**< for a lost encoder */
    law_noc_inertia_t     inertia;
    torque_gains_t        torque; /**< only for a drive that takes torques */
} law_noc_config_t;

typedef struct {
    nodo_t               observer;
    float                theta_hat_rad; /**< estimated electrical angle, within +-pi */
    near_optimal_t       near_optimal;
    encoder_form_edges_t edges;
    angle_gate_t         gate;
    nodo_current_t       without; /**< encoder */
    torque_loop_t        torque;
} law_noc_state_t;

/**
 * @brief The constants for k times the drive's inertia, as law_t.believe.
 *
 *     l1, l2, l3, l11, l1_min, P over k;  e_w times sqrt k;  row of d_w over sqrt k    EQ-INERTIA-8
 *
 * They take no positions.
 */
float law_noc_believe(drive_config_t *to, void *constants, const drive_config_t *from, float ratio);

/**
 * @brief The same acceleration before and after, as law_t.adopt.
 *
 *     d_w += (l1 iq + l11 id iq - l2 w) of `from` - the same of `to`                   EQ-INERTIA-9
 */
void law_noc_adopt(law_state_t *state, const drive_config_t *from, const drive_config_t *to);

void law_noc_fields(fields_t *f, void *constants); /**< for law_noc.fields */

extern const law_t law_noc;

#endif /* LAW_NOC_ENCODER_H */
