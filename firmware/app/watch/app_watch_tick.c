/* SPDX-License-Identifier: MIT */
#include "app_watch_tick.h"

void app_watch_tick_reset(app_watch_tick_t *w)
{
    const app_watch_tick_t start = {.ticks = 0UL, .since_cycles = 0UL, .begun = false};

    *w = start;
}

bool app_watch_tick_is_missing(app_watch_tick_t *w, uint32_t pwm_cycles, uint32_t now_ticks,
                               uint32_t now_cycles)
{
    const uint32_t longest_cycles = APP_WATCH_TICK_HALF_PERIODS * (pwm_cycles / 2UL);

    if (now_ticks != w->ticks) {
        w->ticks        = now_ticks;
        w->since_cycles = now_cycles;
        w->begun        = true;
    }
    return w->begun && ((uint32_t)(now_cycles - w->since_cycles) > longest_cycles);
}
