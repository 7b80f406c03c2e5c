/* SPDX-License-Identifier: MIT */
#include "fields_pid_law.h"
#include "law_dobc.h"

static void dobc(fields_t *f, dobc_config_t *c)
{
    fields_i16(f, FIELD(f, c, n_x));
    fields_float(f, FIELD(f, c, direct_Vs));
    fields_float(f, FIELD(f, c, ld_H));
    fields_float(f, FIELD(f, c, k_omega_Vs));
    FIELDS_BEGIN(f, k_x);
    fields_floats(f, c->k_x, (uint16_t)(sizeof c->k_x / sizeof(float)));
    FIELDS_END(f);
    FIELDS_BEGIN(f, m);
    for (uint16_t i = 0U; i < (uint16_t)DOBC_N_X_MAX; i++) {
        fields_floats(f, c->m[i], DOBC_N_X_MAX);
    }
    FIELDS_END(f);
    FIELDS_BEGIN(f, g);
    fields_floats(f, c->g, (uint16_t)(sizeof c->g / sizeof(float)));
    FIELDS_END(f);
    FIELDS_BEGIN(f, h);
    fields_floats(f, c->h, (uint16_t)(sizeof c->h / sizeof(float)));
    FIELDS_END(f);
}

void law_dobc_fields(fields_t *f, void *constants)
{
    law_dobc_config_t *c = constants;

    FIELDS_PART(dobc, f, c, dobc);
    FIELDS_PART(fields_pid_law, f, c, id_pi);
}
