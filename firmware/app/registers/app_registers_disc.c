/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

app_disc_state_t app_registers_disc(const app_registers_t *r)
{
#if APP_DISC_MAP
    return r->status.disc;
#else
    (void)r;
    return APP_DISC_ABSENT;
#endif
}
