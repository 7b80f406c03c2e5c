/* SPDX-License-Identifier: MIT */
#include "fields_foc.h"
#include "law_pi_foc.h"

static void gains(fields_t *f, law_pi_foc_gains_t *c)
{
    fields_float(f, FIELD(f, c, kp_1ps));
    fields_float(f, FIELD(f, c, ki_per_kp));
    FIELDS_PART(fields_speed_observer, f, c, load);
}

void law_pi_foc_fields(fields_t *f, void *constants)
{
    law_pi_foc_config_t *c = constants;

    FIELDS_PART(fields_foc, f, c, foc);
    FIELDS_PART(fields_speed_difference, f, c, speed);
    FIELDS_BEGIN(f, gains);
    for (uint16_t i = 0U; i < (uint16_t)SPEED_DIFFERENCE_MODES; i++) {
        FIELDS_PART(gains, f, c, gains[i]);
    }
    FIELDS_END(f);
}
