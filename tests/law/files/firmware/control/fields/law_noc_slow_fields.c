/* SPDX-License-Identifier: MIT */
#include "law_noc_slow.h"

static void noc(fields_t *f, law_noc_config_t *c)
{
    law_noc_fields(f, c);
}

void law_noc_slow_fields(fields_t *f, void *constants)
{
    law_noc_slow_config_t *c = constants;

    FIELDS_PART(noc, f, c, noc);
    fields_float(f, FIELD(f, c, share));
}
