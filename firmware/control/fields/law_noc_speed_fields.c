/* SPDX-License-Identifier: MIT */
#include "fields_near_optimal.h"
#include "law_noc_speed.h"

static void nodo(fields_t *f, nodo_gains_t *c)
{
    fields_i16(f, FIELD(f, c, order));
    fields_float(f, FIELD(f, c, iq_max_A));
    fields_float(f, FIELD(f, c, iq_certified_A));
    FIELDS_BEGIN(f, gain);
    for (uint16_t i = 0U; i <= (uint16_t)NODO_ORDER_MAX; i++) {
        for (uint16_t j = 0U; j < (uint16_t)NODO_N_X; j++) {
            fields_floats(f, c->gain[i][j], NODO_N_Y);
        }
    }
    FIELDS_END(f);
}

void law_noc_speed_fields(fields_t *f, void *constants)
{
    law_noc_speed_config_t *c = constants;

    FIELDS_PART(fields_near_optimal, f, c, near_optimal);
    FIELDS_PART(nodo, f, c, nodo);
}
