/* SPDX-License-Identifier: MIT */
/**
 * @file law_noc_shaft.h
 * @brief Near optimal speed control of a load behind an elastic shaft whose resonance is known.
 *
 * The observer has the states of the shaft (nodo_shaft.h), and the feedback has two more columns:
 *
 *     iq_s  = -k_slip (w_load - w) - k_twist (twist - twist*)                      EQ-SHAFT-3
 *     twist* = (w_d' - d_w / s) / ((1 - s) w_r^2)                                  EQ-SHAFT-4
 *     e_iq  = iq - (iq_ref + iq_s)
 *
 * s is the load's share of the inertia, w_r the resonance. It has no positions.
 */
#ifndef LAW_NOC_SHAFT_H
#define LAW_NOC_SHAFT_H

#include "encoder_form.h"
#include "near_optimal.h"
#include "nodo_shaft.h"

typedef struct {
    float slip_A_per_radps;  /**< k_slip of EQ-SHAFT-3 */
    float twist_A_per_rad;   /**< k_twist */
    float twist_per_accel;   /**< 1 / ((1 - s) w_r^2) of EQ-SHAFT-4 [s^2], > 0 */
    float accel_per_d_omega; /**< 1 / s, > 1 */
} law_noc_shaft_feedback_t;

typedef struct {
    near_optimal_config_t    near_optimal;
    encoder_form_limits_t    plausible;
    angle_gate_config_t      gate;
    encoder_form_gains_t     rare; /**< for edges that are rarer than samples */
    nodo_shaft_gains_t       nodo;
    law_noc_shaft_feedback_t shaft;
} law_noc_shaft_config_t;

typedef struct {
    nodo_shaft_t         observer;
    near_optimal_t       near_optimal;
    encoder_form_edges_t edges;
    angle_gate_t         gate;
} law_noc_shaft_state_t;

void law_noc_shaft_fields(fields_t *f, void *constants); /**< for law_noc_shaft.fields */

extern const law_t law_noc_shaft;

#endif /* LAW_NOC_SHAFT_H */
