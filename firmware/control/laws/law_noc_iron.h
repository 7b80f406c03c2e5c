/* SPDX-License-Identifier: MIT */
/**
 * @file law_noc_iron.h
 * @brief law_noc.h for a motor whose iron saturates.
 *
 * In every period the motor is linearised at the predicted currents (iron.h). Observer, references,
 * feed-forward and clamp take this motor in place of the constant one. The feedback gives the
 * currents the rates that it gives those of constant inductances:
 *
 *     u_fb = [D M; M Q] (l8 u_d, l6 u_q),  (u_d, u_q) = -Lambda(e_iq) e         EQ-IRON-3
 *     d_q+ = d_q Q / Q+,  d_d+ = d_d D / D+: the voltages stay                  EQ-IRON-4
 *
 * l6 and l8 are those of the constants, which the gains are designed for. It has no positions.
 */
#ifndef LAW_NOC_IRON_H
#define LAW_NOC_IRON_H

#include "encoder_form.h"
#include "iron.h"
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
    iron_map_t            iron;
} law_noc_iron_config_t;

typedef struct {
    nodo_t               observer;      /**< disturbances of the iron's motor */
    float                theta_hat_rad; /**< estimated electrical angle, within +-pi */
    iron_tangent_t       tangent;       /**< at the predicted currents */
    near_optimal_t       near_optimal;
    encoder_form_edges_t edges;
    angle_gate_t         gate;
    nodo_current_t       without; /**< encoder */
} law_noc_iron_state_t;

void law_noc_iron_fields(fields_t *f, void *constants); /**< for law_noc_iron.fields */

extern const law_t law_noc_iron;

#endif /* LAW_NOC_IRON_H */
