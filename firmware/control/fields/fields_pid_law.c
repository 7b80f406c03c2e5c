/* SPDX-License-Identifier: MIT */
#include "fields_pid_law.h"

void fields_pid_law(fields_t *f, pid_law_config_t *c)
{
    fields_float(f, FIELD(f, c, kp));
    fields_float(f, FIELD(f, c, ki_per_tick));
    fields_float(f, FIELD(f, c, kd_tick));
}
