/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

/* Time limit in quarters of a control period. A control interrupt that is later than 1.5 periods
 * trips by itself (control_isr.c). This limit, 1.75 periods, detects a tick that is missing or
 * never ends. */
#define QUARTERS 7UL

/* SysTick's exception. It may interrupt a tick. */
void tick_is_missing(void)
{
    trip_overdue();
}

void tick_watch_start(uint32_t period_cycles)
{
    CORE_SCB->SHPR3 &= CORE_SHPR3_SYSTICK_0;
    CORE_TICK->RVR = (QUARTERS * (period_cycles / 4UL)) - 1UL;
    tick_watch_serve();
    CORE_TICK->CSR = CORE_TICK_RUN;
}

/* Any write clears the count. The next cycle loads it anew. */
void tick_watch_serve(void)
{
    CORE_TICK->CVR = 0UL;
}
