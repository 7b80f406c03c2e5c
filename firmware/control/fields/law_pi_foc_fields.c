/* SPDX-License-Identifier: MIT */
#include "fields_foc.h"
#include "law_pi_foc.h"

static void gains(fields_t *f, law_pi_foc_gains_t *c)
{
    fields_float(f, &c->kp_1ps);
    fields_float(f, &c->ki_per_kp);
}

void law_pi_foc_fields(fields_t *f, void *constants)
{
    law_pi_foc_config_t *c = constants;

    fields_foc(f, &c->foc);
    fields_speed_difference(f, &c->speed);
    for (uint16_t i = 0U; i < (uint16_t)SPEED_DIFFERENCE_MODES; i++) {
        gains(f, &c->gains[i]);
    }
}
