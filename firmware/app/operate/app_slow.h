/* SPDX-License-Identifier: MIT */
/**
 * @file app_slow.h
 * @brief Work that is due once in a millisecond. While the law runs, a period has one piece of it.
 *
 * To read a command is such a piece too. A change of the mode and a command have priority: the
 * command is read, and obeyed in the next period. Its ramp begins in the third one, or in the
 * fourth after an aim that was due. A piece that had to wait comes in the next free period.
 */
#ifndef APP_SLOW_H
#define APP_SLOW_H

#include "base.h"

/** Pieces of work, as bits. The lowest one that is due comes first; the first one precedes changes
 * and commands too. */
enum {
    APP_SLOW_AIM    = 1, /**< app_control_aim(), after the next */
    APP_SLOW_SINK   = 2, /**< app_warmth_sink() */
    APP_SLOW_HEAT   = 4, /**< app_warmth_heat() */
    APP_SLOW_DECIDE = 8, /**< app_control_decide() */
    APP_SLOW_TURN   = 14 /**< of a millisecond */
};

#define APP_SLOW_PER_s       1000.0f /* chosen: far above every time constant of the work */
#define APP_SLOW_PERIODS_MIN 5.0f    /* the four pieces and a command */
#define APP_SLOW_PERIODS_MAX 100.0f  /* of 10 us */

/** Periods from a piece of work to its next turn: a millisecond, rounded. Context: init. */
static inline uint16_t app_slow_periods(float ts_s)
{
    const float least_s = 1.0f / (APP_SLOW_PER_s * APP_SLOW_PERIODS_MAX);
    const float periods = 1.0f / (APP_SLOW_PER_s * base_clamp(ts_s, least_s, 1.0f));

    return (uint16_t)base_max(periods + 0.5f, APP_SLOW_PERIODS_MIN);
}

/** Time of that many periods [s]. Context: init. */
static inline float app_slow_s(float ts_s)
{
    const float periods = (float)app_slow_periods(ts_s);

    return ts_s * periods;
}

#endif /* APP_SLOW_H */
