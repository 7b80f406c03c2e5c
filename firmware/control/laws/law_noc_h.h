/* SPDX-License-Identifier: MIT */
/**
 * @file law_noc_h.h
 * @brief Near optimal control with an observer of angle-periodic disturbances (nodo_harmonic.h).
 */
#ifndef LAW_NOC_H_H
#define LAW_NOC_H_H

#include "encoder_form.h"
#include "near_optimal.h"
#include "nodo_harmonic.h"

typedef struct {
    nodo_harmonic_gains_t nodo; /**< first: a pointer walks through it in every period */
    near_optimal_config_t near_optimal;
    encoder_form_limits_t plausible;
    angle_gate_config_t   gate;
    encoder_form_gains_t  rare; /**< for edges that are rarer than samples */
} law_noc_h_config_t;

typedef struct {
    nodo_harmonic_t      observer;
    nodo_harmonic_view_t known; /**< view of the observer for the law */
    near_optimal_t       near_optimal;
    encoder_form_edges_t edges;
    angle_gate_t         gate;
} law_noc_h_state_t;

void law_noc_h_fields(fields_t *f, void *constants); /**< for law_noc_h.fields */

extern const law_t law_noc_h;

#endif /* LAW_NOC_H_H */
