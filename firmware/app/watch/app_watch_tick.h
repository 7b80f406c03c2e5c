/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_tick.h
 * @brief The background's look at the ticks: whether one is missing.
 *
 * The board opens the bridge by itself when a tick does not come or does not end (board.h). This is the second look, for a
 * program that has masked its interrupts: then only the background runs.
 */
#ifndef APP_WATCH_TICK_H
#define APP_WATCH_TICK_H

#include "base.h"

/** Chosen: two and a half PWM periods, one more than what the board finds by itself. */
#define APP_WATCH_TICK_HALF_PERIODS 5UL

typedef struct {
    uint32_t ticks;        /**< that had ended when the count moved last */
    uint32_t since_cycles; /**< when that was seen */
    bool     begun;        /**< a tick has ended since the start */
} app_watch_tick_t;

void app_watch_tick_reset(app_watch_tick_t *w);

/** @return Whether no tick has ended for too long; once one has. Context: background. */
bool app_watch_tick_is_missing(app_watch_tick_t *w, uint32_t pwm_cycles, uint32_t now_ticks,
                               uint32_t now_cycles);

#endif /* APP_WATCH_TICK_H */
