/* SPDX-License-Identifier: MIT */
#include "fields_near_optimal.h"
#include "law_noc_speed.h"

static void nodo(fields_t *f, nodo_gains_t *c)
{
    fields_i16(f, &c->order);
    fields_float(f, &c->iq_max_A);
    fields_float(f, &c->iq_certified_A);
    for (uint16_t i = 0U; i <= (uint16_t)NODO_ORDER_MAX; i++) {
        for (uint16_t j = 0U; j < (uint16_t)NODO_N_X; j++) {
            fields_floats(f, c->gain[i][j], NODO_N_Y);
        }
    }
}

void law_noc_speed_fields(fields_t *f, void *constants)
{
    law_noc_speed_config_t *c = constants;

    fields_near_optimal(f, &c->near_optimal);
    nodo(f, &c->nodo);
}
