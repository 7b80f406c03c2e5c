/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "app_registers.h"

#define ROWS_OF_LD 2

/* Each value is one aligned access. The tick writes them at the end of a stage only. */
float app_registers_mapped(const app_registers_t *r, int16_t row, int16_t bin)
{
    const volatile commission_map_t *m     = r->map;
    uint16_t                         share = 0U;

    if (m != NULL) {
        share = (row < ROWS_OF_LD) ? m->ld[row][bin] : m->lq[row - ROWS_OF_LD][bin];
    }
    return (float)share / (float)COMMISSION_MAP_ONE;
}

float app_registers_map_step_A(const app_registers_t *r)
{
    return (r->map != NULL) ? r->map->step_A : 0.0f;
}

float app_registers_map_bias_A(const app_registers_t *r)
{
    return COMMISSION_MAP_BIAS * app_registers_map_step_A(r);
}
