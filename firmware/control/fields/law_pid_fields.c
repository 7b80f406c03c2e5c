/* SPDX-License-Identifier: MIT */
#include "fields_pid_law.h"
#include "law_pid.h"

void law_pid_fields(fields_t *f, void *constants)
{
    law_pid_config_t *c = constants;

    FIELDS_PART(fields_pid_law, f, c, pid);
    FIELDS_PART(fields_pid_law, f, c, id_pi);
}
