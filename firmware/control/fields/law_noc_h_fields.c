/* SPDX-License-Identifier: MIT */
#include "fields_encoder_form.h"
#include "fields_near_optimal.h"
#include "law_noc_h.h"

static void order(fields_t *f, nodo_harmonic_order_t *c)
{
    uint16_t channel = (uint16_t)c->channel;

    FIELDS_NAME(f, channel);
    fields_u16(f, &channel);
    c->channel = (nodo_harmonic_channel_t)channel;
    fields_float(f, FIELD(f, c, order));
}

static void nodo(fields_t *f, nodo_harmonic_gains_t *c)
{
    const int16_t states = NODO_HARMONIC_N_X_MAX;

    fields_i16(f, FIELD(f, c, n_pairs));
    fields_i16(f, FIELD(f, c, n_nodes));
    fields_float(f, FIELD(f, c, iq_max_A));
    fields_float(f, FIELD(f, c, nodes_per_root));
    fields_float(f, FIELD(f, c, keep));
    fields_float(f, FIELD(f, c, keep_fast));
    FIELDS_BEGIN(f, pair);
    for (uint16_t i = 0U; i < (uint16_t)NODO_HARMONIC_PAIRS_MAX; i++) {
        FIELDS_PART(order, f, c, pair[i]);
    }
    FIELDS_END(f);
    FIELDS_BEGIN(f, gain);
    for (uint16_t i = 0U; i < (uint16_t)states; i++) {
        for (uint16_t j = 0U; j < (uint16_t)NODO_HARMONIC_NODES_MAX; j++) {
            fields_floats(f, c->gain[i][j], NODO_HARMONIC_N_G);
        }
    }
    FIELDS_END(f);
}

void law_noc_h_fields(fields_t *f, void *constants)
{
    law_noc_h_config_t *c = constants;

    FIELDS_PART(fields_near_optimal, f, c, near_optimal);
    FIELDS_PART(fields_angle_limits, f, c, plausible);
    FIELDS_PART(fields_angle_gate, f, c, gate);
    FIELDS_PART(fields_rare_edges, f, c, rare);
    FIELDS_PART(nodo, f, c, nodo);
}
