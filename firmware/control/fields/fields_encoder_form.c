/* SPDX-License-Identifier: MIT */
#include "fields_encoder_form.h"

void fields_angle_limits(fields_t *f, encoder_form_limits_t *c)
{
    fields_float(f, FIELD(f, c, angle_rad));
    fields_float(f, FIELD(f, c, d_omega));
}

void fields_rare_edges(fields_t *f, encoder_form_gains_t *c)
{
    fields_float(f, FIELD(f, c, theta));
    fields_float(f, FIELD(f, c, omega_1ps));
    fields_float(f, FIELD(f, c, d_omega_1ps2));
    fields_float(f, FIELD(f, c, count_rad));
}

void fields_angle_gate(fields_t *f, angle_gate_config_t *c)
{
    fields_float(f, FIELD(f, c, gate_rad));
    fields_float(f, FIELD(f, c, step_rad));
    fields_float(f, FIELD(f, c, count_rad));
    fields_float(f, FIELD(f, c, slow_e_radps2));
}
