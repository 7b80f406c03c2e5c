/* SPDX-License-Identifier: MIT */
/**
 * @file app_control_change.h
 * @brief Rare parts of app_control.c: changes of state, positions, the start. They run from flash.
 *
 * Context: control ISR.
 */
#ifndef APP_CONTROL_CHANGE_H
#define APP_CONTROL_CHANGE_H

#include "app_control.h"

/** Requests that a control word can express. */
typedef enum {
    APP_CONTROL_ASK_DISABLE_VOLTAGE = 0,
    APP_CONTROL_ASK_QUICK_STOP,
    APP_CONTROL_ASK_SHUT_DOWN,
    APP_CONTROL_ASK_SWITCH_ON,
    APP_CONTROL_ASK_ENABLE,
    APP_CONTROL_ASKS
} app_control_ask_t;

/** True in the states in which the bridge may be on. */
static inline bool app_control_is_enabled(app_control_state_t state)
{
    return (state == APP_CONTROL_OPERATION_ENABLED) || (state == APP_CONTROL_QUICK_STOP_ACTIVE);
}

/** True in the modes of operation in which the law controls the bridge. */
static inline bool app_control_runs(const app_control_t *c)
{
    return app_control_is_run(c->mode);
}

/** True if the drive stays enabled after a quick stop. */
static inline bool app_control_stays_quick(const app_objects_t *o)
{
    return o->quick_option >= APP_CONTROL_QUICK_RAMP_STAY;
}

/** Count that cyclic position is asked for, before the limits of position. */
static inline int32_t app_control_asked_cnt(const app_objects_t *o)
{
    return app_position_held(app_position_held(o->target_cnt) +
                             app_position_held(o->offset_cnt)); /* 2e9 at most */
}

/** Changes the state: application modes have priority over the requests. */
void app_control_change(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                        app_control_ask_t ask);

/**
 * @brief True during a stop along a ramp, until standstill.
 *
 * Otherwise app_modes ends the run as the drive file says.
 */
bool app_control_brakes(const app_control_t *c, const app_objects_t *o,
                        const app_control_seen_t *seen, app_control_ask_t ask);

/** Takes the requested mode of operation over while the operation is enabled, from a run to a run.
 * Any other change waits for the next start. */
void app_control_hand_over(app_control_t *c, const app_objects_t *o);

/** Returns what the run follows. */
app_follows_t app_control_followed(app_control_t *c, const app_objects_t *o,
                                   const app_control_seen_t *seen);

/** The reference stays at the present speed. */
void app_control_put_speed(app_control_t *c, const app_control_seen_t *seen);

/** Largest acceleration of a path. Context: init. */
float app_control_path_accel(const drive_config_t *drive);

/** Sets path, position or torque of the command, or the ramp of a cyclic velocity. A later stop
 * begins at the present speed. */
void app_control_aim_beyond(app_control_t *c, const app_objects_t *o,
                            const app_control_seen_t *seen, app_command_t *out);

#endif /* APP_CONTROL_CHANGE_H */
