/* SPDX-License-Identifier: MIT */
/**
 * @file fields_encoder_form.h
 * @brief Walks over the constants of the encoder form other than the gains.
 */
#ifndef FIELDS_ENCODER_FORM_H
#define FIELDS_ENCODER_FORM_H

#include "angle_gate.h"
#include "encoder_form.h"
#include "fields.h"

void fields_angle_limits(fields_t *f, encoder_form_limits_t *c);
void fields_rare_edges(fields_t *f, encoder_form_gains_t *c);
void fields_angle_gate(fields_t *f, angle_gate_config_t *c);

#endif /* FIELDS_ENCODER_FORM_H */
