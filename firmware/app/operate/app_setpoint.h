/* SPDX-License-Identifier: MIT */
/**
 * @file app_setpoint.h
 * @brief Set-points of profile position and their handshake by CiA 402: one active, one waiting.
 *
 * A rising bit 4 of the control word offers a new set-point. It is taken if there is room, and
 * acknowledged by bit 12 of the status word. The acknowledge ends when bit 4 is low and there is
 * room. With bit 5 the new set-point replaces the active one, otherwise it follows it. With bit 6
 * it is relative to the previous set-point.
 */
#ifndef APP_SETPOINT_H
#define APP_SETPOINT_H

#include "app_objects.h"
#include "app_position.h"
#include "position_ref.h"

typedef struct {
    int32_t            target_cnt;
    position_profile_t profile;
    bool               limited; /**< by the limits of position */
} app_setpoint_one_t;

typedef struct {
    app_setpoint_one_t now;
    app_setpoint_one_t next;
    position_t         target; /**< active set-point */
    bool               waits;  /**< `next` holds a waiting set-point */
    bool               acknowledged;
    bool               new_high; /**< bit 4 in the previous tick */
} app_setpoint_t;

/** Starts a run: holds the present position until bit 4 rises again. Context: control ISR. */
void app_setpoint_start(app_setpoint_t *s, const app_objects_t *o, const app_position_t *position);

/** Executes one period. @param arrived The active target is reached. Context: control ISR. */
void app_setpoint_tick(app_setpoint_t *s, const app_objects_t *o, const app_position_t *position,
                       bool arrived);

#endif /* APP_SETPOINT_H */
