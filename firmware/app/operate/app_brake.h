/* SPDX-License-Identifier: MIT */
/**
 * @file app_brake.h
 * @brief Holding brake that a spring closes: releases it while the bridge holds the shaft.
 *
 * The output releases the brake while it is high. A magnet needs time either way, so the bridge
 * holds the shaft alone only while the brake is known to be open:
 *
 *     start   the law holds speed zero, output high, release time, set-points act
 *     stop    standstill for 20 turns, output low, close time, bridge open       EQ-APP-BRAKE-1
 *
 * A turn is that of app_slow.h. Each time is at least that of the objects, and at most three turns
 * longer. A bridge that opens otherwise closes the brake at once.
 */
#ifndef APP_BRAKE_H
#define APP_BRAKE_H

#include "app_objects.h"

typedef enum {
    APP_BRAKE_NONE = 0,  /**< no brake is used; the output is low */
    APP_BRAKE_CLOSED,    /**< output low, long enough */
    APP_BRAKE_RELEASING, /**< output high, not long enough */
    APP_BRAKE_RELEASED,  /**< output high, long enough */
    APP_BRAKE_CLOSING    /**< output low, not long enough */
} app_brake_state_t;

/** A mode wants one of these of it. */
typedef enum {
    APP_BRAKE_BRIDGE_OFF = 0, /**< closed at once; the only instant at which it comes into use */
    APP_BRAKE_KEEP,
    APP_BRAKE_RELEASE,
    APP_BRAKE_CLOSE /**< the shaft stands */
} app_brake_ask_t;

typedef struct {
    app_brake_state_t state;
    uint16_t left; /**< turns of the slow work until the next state; RELEASED: of standstill */
} app_brake_t;

/** Context: init. */
static inline void app_brake_init(app_brake_t *b)
{
    b->state = APP_BRAKE_NONE;
    b->left  = 0U;
}

/**
 * @brief Does what the modes want, as far as the times allow.
 *
 * @param turn True once in a turn of the slow work: time passes.
 * @param ts_s Control period [s].
 *
 * Context: control ISR. It runs from flash.
 */
void app_brake_tick(app_brake_t *b, const app_objects_t *o, app_brake_ask_t ask, bool turn,
                    float ts_s);

/** Level of the output. */
static inline bool app_brake_output(app_brake_state_t state)
{
    return (state == APP_BRAKE_RELEASING) || (state == APP_BRAKE_RELEASED);
}

/** True while the brake may hold the shaft: no set-point acts. */
static inline bool app_brake_may_hold(app_brake_state_t state)
{
    return (state != APP_BRAKE_NONE) && (state != APP_BRAKE_RELEASED);
}

/** True while the brake may be open: the bridge has to hold the shaft. */
static inline bool app_brake_may_be_open(app_brake_state_t state)
{
    return state > APP_BRAKE_CLOSED;
}

#endif /* APP_BRAKE_H */
