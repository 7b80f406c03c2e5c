/* SPDX-License-Identifier: MIT */
#include "fields_foc.h"
#include "law_ladrc.h"

static void gains(fields_t *f, law_ladrc_gains_t *c)
{
    FIELDS_PART(fields_speed_observer, f, c, observer);
    fields_float(f, FIELD(f, c, w_c_1ps));
}

void law_ladrc_fields(fields_t *f, void *constants)
{
    law_ladrc_config_t *c = constants;

    FIELDS_PART(fields_foc, f, c, foc);
    FIELDS_PART(fields_speed_difference, f, c, speed);
    FIELDS_BEGIN(f, gains);
    for (uint16_t i = 0U; i < (uint16_t)SPEED_DIFFERENCE_MODES; i++) {
        FIELDS_PART(gains, f, c, gains[i]);
    }
    FIELDS_END(f);
}
