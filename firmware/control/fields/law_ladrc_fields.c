/* SPDX-License-Identifier: MIT */
#include "fields_foc.h"
#include "law_ladrc.h"

static void gains(fields_t *f, law_ladrc_gains_t *c)
{
    fields_float(f, &c->gain_w);
    fields_float(f, &c->gain_f_1ps);
    fields_float(f, &c->w_c_1ps);
}

void law_ladrc_fields(fields_t *f, void *constants)
{
    law_ladrc_config_t *c = constants;

    fields_foc(f, &c->foc);
    fields_speed_difference(f, &c->speed);
    for (uint16_t i = 0U; i < (uint16_t)SPEED_DIFFERENCE_MODES; i++) {
        gains(f, &c->gains[i]);
    }
}
