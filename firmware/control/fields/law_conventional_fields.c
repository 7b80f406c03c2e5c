/* SPDX-License-Identifier: MIT */
#include "fields_near_optimal.h"
#include "law_conventional.h"

static void gains(fields_t *f, conventional_gains_t *c)
{
    const int16_t law_rows      = DOUBLE_SERIES_TERMS_MAX * NOSC_N_U;
    const int16_t observer_rows = DOUBLE_SERIES_TERMS_MAX * NODO_N_X;

    fields_i16(f, FIELD(f, c, nosc_order));
    fields_float(f, FIELD(f, c, i_error_max_A));
    fields_i16(f, FIELD(f, c, nodo_order));
    fields_float(f, FIELD(f, c, i_max_A));
    fields_float(f, FIELD(f, c, i_certified_A));
    FIELDS_BEGIN(f, lambda);
    for (uint16_t i = 0U; i < (uint16_t)law_rows; i++) {
        fields_floats(f, c->lambda[i], NOSC_N_E);
    }
    FIELDS_END(f);
    FIELDS_BEGIN(f, gain);
    for (uint16_t i = 0U; i < (uint16_t)observer_rows; i++) {
        fields_floats(f, c->gain[i], NODO_N_Y);
    }
    FIELDS_END(f);
}

void law_conventional_fields(fields_t *f, void *constants)
{
    law_conventional_config_t *c = constants;

    FIELDS_PART(fields_near_optimal, f, c, near_optimal);
    FIELDS_PART(gains, f, c, gains);
}
