/* SPDX-License-Identifier: MIT */
#include "fields_pid_law.h"
#include "law_dobc.h"

static void dobc(fields_t *f, dobc_config_t *c)
{
    fields_i16(f, &c->n_x);
    fields_float(f, &c->direct_Vs);
    fields_float(f, &c->ld_H);
    fields_float(f, &c->k_omega_Vs);
    fields_floats(f, c->k_x, (uint16_t)(sizeof c->k_x / sizeof(float)));
    for (uint16_t i = 0U; i < (uint16_t)DOBC_N_X_MAX; i++) {
        fields_floats(f, c->m[i], DOBC_N_X_MAX);
    }
    fields_floats(f, c->g, (uint16_t)(sizeof c->g / sizeof(float)));
    fields_floats(f, c->h, (uint16_t)(sizeof c->h / sizeof(float)));
}

void law_dobc_fields(fields_t *f, void *constants)
{
    law_dobc_config_t *c = constants;

    dobc(f, &c->dobc);
    fields_pid_law(f, &c->id_pi);
}
