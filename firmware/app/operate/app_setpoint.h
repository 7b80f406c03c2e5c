/* SPDX-License-Identifier: MIT */
/**
 * @file app_setpoint.h
 * @brief Set-points of profile position and their hand-shake, as CiA 402 has it: one is on the way, one more may wait.
 *
 * New set-point (bit 4 of the control word) rises: taken, when there is room, and acknowledged (bit 12 of the status word)
 * until bit 4 has fallen and there is room again. With bit 5 it takes the place of the one on the way, else it follows it. With
 * bit 6 it counts from the set-point before.
 */
#ifndef APP_SETPOINT_H
#define APP_SETPOINT_H

#include "app_objects.h"
#include "app_position.h"
#include "position_ref.h"

typedef struct {
    int32_t            target_cnt;
    position_profile_t profile;
} app_setpoint_one_t;

typedef struct {
    app_setpoint_one_t now;
    app_setpoint_one_t next;
    position_t         target; /**< of now */
    bool               waits;  /**< next is one */
    bool               acknowledged;
    bool               new_high; /**< bit 4 was there before */
} app_setpoint_t;

/** Start of a run: what holds the shaft where it is; bit 4 has to rise anew. Context: control ISR. */
void app_setpoint_start(app_setpoint_t *s, const app_objects_t *o, const app_position_t *position);

/** One period of a run; `arrived` at the target of now. Context: control ISR. */
void app_setpoint_tick(app_setpoint_t *s, const app_objects_t *o, const app_position_t *position,
                       bool arrived);

#endif /* APP_SETPOINT_H */
