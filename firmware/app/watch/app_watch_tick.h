/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_tick.h
 * @brief Detects in the background that ticks are missing.
 *
 * The board opens the bridge by itself when a tick does not come or does not end (board.h). This
 * second check works also with masked interrupts, when only the background runs.
 */
#ifndef APP_WATCH_TICK_H
#define APP_WATCH_TICK_H

#include "base.h"

/** Chosen: 2.5 PWM periods, one period more than the board's own limit. */
#define APP_WATCH_TICK_HALF_PERIODS 5UL

typedef struct {
    uint32_t ticks;        /**< tick count at its last change */
    uint32_t since_cycles; /**< time of that change */
    bool     begun;        /**< a tick has ended since the start */
} app_watch_tick_t;

void app_watch_tick_reset(app_watch_tick_t *w);

/** @return true: ticks have begun, and none has ended for too long. Context: background. */
bool app_watch_tick_is_missing(app_watch_tick_t *w, uint32_t pwm_cycles, uint32_t now_ticks,
                               uint32_t now_cycles);

#endif /* APP_WATCH_TICK_H */
