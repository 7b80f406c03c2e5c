/* SPDX-License-Identifier: MIT */
/**
 * @file app_control_change.h
 * @brief What app_control.c does not do in every tick of a run: changes of state, positions, the start. An image has it in flash.
 *
 * Context: control ISR.
 */
#ifndef APP_CONTROL_CHANGE_H
#define APP_CONTROL_CHANGE_H

#include "app_control.h"

/** What a control word asks for. */
typedef enum {
    APP_CONTROL_ASK_DISABLE_VOLTAGE = 0,
    APP_CONTROL_ASK_QUICK_STOP,
    APP_CONTROL_ASK_SHUT_DOWN,
    APP_CONTROL_ASK_SWITCH_ON,
    APP_CONTROL_ASK_ENABLE,
    APP_CONTROL_ASKS
} app_control_ask_t;

/** The bridge may be on. */
static inline bool app_control_is_enabled(app_control_state_t state)
{
    return (state == APP_CONTROL_OPERATION_ENABLED) || (state == APP_CONTROL_QUICK_STOP_ACTIVE);
}

/** The modes in which the drive has the bridge. */
static inline bool app_control_runs(const app_control_t *c)
{
    return (c->mode == APP_CONTROL_PROFILE_VELOCITY) || (c->mode == APP_CONTROL_PROFILE_POSITION);
}

/** A quick stop after which the drive stays enabled. */
static inline bool app_control_stays_quick(const app_objects_t *o)
{
    return o->quick_option >= APP_CONTROL_QUICK_RAMP_STAY;
}

/** The state that follows: what the modes say first, then what is asked for. */
void app_control_change(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                        app_control_ask_t ask);

/** Profile position. True: on the way to a position, or holding one; halted, or stopping, the drive has a speed, zero in the end. */
bool app_control_position(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                          bool stopping);

#endif /* APP_CONTROL_CHANGE_H */
