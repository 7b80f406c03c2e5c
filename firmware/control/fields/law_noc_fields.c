/* SPDX-License-Identifier: MIT */
#include "fields_encoder_form.h"
#include "fields_near_optimal.h"
#include "law_noc.h"

static void nodo(fields_t *f, nodo_encoder_gains_t *c)
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

static void currents(fields_t *f, nodo_current_gains_t *c)
{
    fields_float(f, FIELD(f, c, from_e_radps));
    fields_float(f, FIELD(f, c, root));
    fields_float(f, FIELD(f, c, nodes_per_root));
    FIELDS_BEGIN(f, gain);
    for (uint16_t i = 0U; i < (uint16_t)NODO_CURRENT_NODES; i++) {
        for (uint16_t j = 0U; j < (uint16_t)NODO_CURRENT_N_X; j++) {
            fields_floats(f, c->gain[i][j], NODO_CURRENT_N_Y);
        }
    }
    FIELDS_END(f);
}

static void inertia(fields_t *f, law_noc_inertia_t *c)
{
    fields_float(f, FIELD(f, c, least));
    fields_float(f, FIELD(f, c, most));
}

static void torque(fields_t *f, torque_gains_t *c)
{
    fields_float(f, FIELD(f, c, iq_VpA));
    fields_float(f, FIELD(f, c, id_VpA));
    fields_float(f, FIELD(f, c, id_max_A));
}

void law_noc_fields(fields_t *f, void *constants)
{
    law_noc_config_t *c = constants;

    FIELDS_PART(fields_near_optimal, f, c, near_optimal);
    FIELDS_PART(fields_angle_limits, f, c, plausible);
    FIELDS_PART(fields_angle_gate, f, c, gate);
    FIELDS_PART(fields_rare_edges, f, c, rare);
    FIELDS_PART(nodo, f, c, nodo);
    FIELDS_PART(currents, f, c, currents);
    FIELDS_PART(inertia, f, c, inertia);
    FIELDS_PART(torque, f, c, torque);
}
