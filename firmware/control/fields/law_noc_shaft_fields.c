/* SPDX-License-Identifier: MIT */
#include "fields_encoder_form.h"
#include "fields_near_optimal.h"
#include "law_noc_shaft.h"

static void motor(fields_t *f, nodo_encoder_gains_t *c)
{
    fields_i16(f, FIELD(f, c, order));
    fields_float(f, FIELD(f, c, iq_max_A));
    FIELDS_BEGIN(f, gain);
    for (uint16_t i = 0U; i <= (uint16_t)NODO_ORDER_MAX; i++) {
        for (uint16_t j = 0U; j < (uint16_t)NODO_ENCODER_N_X; j++) {
            fields_floats(f, c->gain[i][j], NODO_ENCODER_N_Y);
        }
    }
    FIELDS_END(f);
}

static void nodo(fields_t *f, nodo_shaft_gains_t *c)
{
    FIELDS_PART(motor, f, c, motor);
    FIELDS_BEGIN(f, load);
    for (uint16_t i = 0U; i < (uint16_t)NODO_SHAFT_N_LOAD; i++) {
        fields_floats(f, c->load[i][0], NODO_ENCODER_N_Y);
        fields_floats(f, c->load[i][1], NODO_ENCODER_N_Y);
    }
    FIELDS_END(f);
    FIELDS_BEGIN(f, step);
    for (uint16_t i = 0U; i < (uint16_t)NODO_SHAFT_N_STEP; i++) {
        fields_floats(f, c->step[i], NODO_SHAFT_N_FROM);
    }
    FIELDS_END(f);
}

static void shaft(fields_t *f, law_noc_shaft_feedback_t *c)
{
    fields_float(f, FIELD(f, c, slip_A_per_radps));
    fields_float(f, FIELD(f, c, twist_A_per_rad));
    fields_float(f, FIELD(f, c, twist_per_accel));
    fields_float(f, FIELD(f, c, accel_per_d_omega));
}

void law_noc_shaft_fields(fields_t *f, void *constants)
{
    law_noc_shaft_config_t *c = constants;

    FIELDS_PART(fields_near_optimal, f, c, near_optimal);
    FIELDS_PART(fields_angle_limits, f, c, plausible);
    FIELDS_PART(fields_angle_gate, f, c, gate);
    FIELDS_PART(fields_rare_edges, f, c, rare);
    FIELDS_PART(nodo, f, c, nodo);
    FIELDS_PART(shaft, f, c, shaft);
}
