/* SPDX-License-Identifier: MIT */
#include "app_brake.h"

#include "app_slow.h"

#define MS_s 0.001f

/* Chosen: 20 ms, four times the settling time of the shipped drive. A shaft that swings through
 * zero does not stand. */
#define STILL_TURNS 20U

#define TURNS_MAX 60000.0f /* 5 s have 5000 */

/* Turns of the slow work that last at least as long. */
static uint16_t slow_turns(uint16_t time_ms, float ts_s)
{
    const float turns = (MS_s * (float)time_ms) / app_slow_s(ts_s);

    return (uint16_t)base_clamp(turns + 1.0f, 1.0f, TURNS_MAX);
}

static void become(app_brake_t *b, app_brake_state_t state, uint16_t left)
{
    b->state = state;
    b->left  = left;
}

static void bridge_off(app_brake_t *b, const app_objects_t *o)
{
    become(b, (o->brake_used != 0U) ? APP_BRAKE_CLOSED : APP_BRAKE_NONE, 0U);
}

/* A shaft that the brake may still hold stands. */
static bool closes(const app_brake_t *b, bool over)
{
    return (b->state == APP_BRAKE_RELEASING) || (over && (b->state == APP_BRAKE_RELEASED));
}

/* EQ-APP-BRAKE-1 */
void app_brake_tick(app_brake_t *b, const app_objects_t *o, app_brake_ask_t ask, bool turn,
                    float ts_s)
{
    const bool over = turn && (b->left == 0U);

    if (turn && !over) {
        b->left = (uint16_t)(b->left - 1U);
    }
    if (ask == APP_BRAKE_BRIDGE_OFF) {
        bridge_off(b, o);
    } else if ((ask == APP_BRAKE_RELEASE) && app_brake_may_hold(b->state) &&
               !app_brake_output(b->state)) {
        become(b, APP_BRAKE_RELEASING, slow_turns(o->brake_release_ms, ts_s));
    } else if ((ask == APP_BRAKE_CLOSE) && closes(b, over)) {
        become(b, APP_BRAKE_CLOSING, slow_turns(o->brake_close_ms, ts_s));
    } else if ((ask != APP_BRAKE_CLOSE) && (b->state == APP_BRAKE_RELEASED)) {
        b->left = STILL_TURNS;
    } else if (over && (b->state == APP_BRAKE_RELEASING)) {
        become(b, APP_BRAKE_RELEASED, STILL_TURNS);
    } else if (over && (b->state == APP_BRAKE_CLOSING)) {
        b->state = APP_BRAKE_CLOSED;
    } else {
        /* on its way, or there */
    }
}
