/* SPDX-License-Identifier: MIT */
#include "fields_near_optimal.h"
#include "law_conventional.h"

static void gains(fields_t *f, conventional_gains_t *c)
{
    const int16_t law_rows      = DOUBLE_SERIES_TERMS_MAX * NOSC_N_U;
    const int16_t observer_rows = DOUBLE_SERIES_TERMS_MAX * NODO_N_X;

    fields_i16(f, &c->nosc_order);
    fields_float(f, &c->i_error_max_A);
    fields_i16(f, &c->nodo_order);
    fields_float(f, &c->i_max_A);
    fields_float(f, &c->i_certified_A);
    for (uint16_t i = 0U; i < (uint16_t)law_rows; i++) {
        fields_floats(f, c->lambda[i], NOSC_N_E);
    }
    for (uint16_t i = 0U; i < (uint16_t)observer_rows; i++) {
        fields_floats(f, c->gain[i], NODO_N_Y);
    }
}

void law_conventional_fields(fields_t *f, void *constants)
{
    law_conventional_config_t *c = constants;

    fields_near_optimal(f, &c->near_optimal);
    gains(f, &c->gains);
}
