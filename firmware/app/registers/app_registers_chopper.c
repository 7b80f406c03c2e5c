/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

app_chopper_state_t app_registers_chopper(const app_registers_t *r)
{
#if BOARD_CHOPPER
    return r->status.chopper;
#else
    (void)r;
    return APP_CHOPPER_NONE;
#endif
}

float app_registers_chopper_heat(const app_registers_t *r)
{
#if BOARD_CHOPPER
    return r->status.chopper_heat;
#else
    (void)r;
    return 0.0f;
#endif
}

bool app_registers_chopper_rests(const app_registers_t *r)
{
    const app_chopper_state_t state = app_registers_chopper(r);

    return (state == APP_CHOPPER_HOT) || (state == APP_CHOPPER_STUCK);
}
