/* SPDX-License-Identifier: MIT */
/**
 * @file app_homing.h
 * @brief Homing by CiA 402: finds a switch or the index mark, and makes it the zero of positions.
 *
 * - FIND goes to the switch until it is active. A limit switch in the way reverses methods 7 to 14
 *   once.
 * - LEAVE goes off the switch, to the side from which it is passed.
 * - RETURN goes onto it again, for methods that pass it from its active side.
 * - PASS goes slowly over the edge of the switch.
 * - INDEX goes on to the next index mark, for methods with one.
 *
 * FIND and LEAVE have the speed for the switch, the others that for the zero. A method names
 * the edge, its side and the direction. Directions and limit switches are those of the operator,
 * whom the polarity may turn round.
 *
 *     zero = home + offset                                                        EQ-APP-HOMING-1
 *
 * The switches are read once in a millisecond. So an edge is found within the way of a millisecond
 * at the speed for the zero. The index mark is found to the count.
 */
#ifndef APP_HOMING_H
#define APP_HOMING_H

#include "app_angle.h"
#include "app_objects.h"
#include "app_position.h"
#include "board.h"

typedef enum {
    APP_HOMING_IDLE = 0, /**< waits for bit 4 of the control word to rise */
    APP_HOMING_FIND,
    APP_HOMING_LEAVE,
    APP_HOMING_RETURN,
    APP_HOMING_PASS,
    APP_HOMING_INDEX,
    APP_HOMING_ATTAINED,
    APP_HOMING_FAILED /**< no such input, a limit switch in the way, or the time is over */
} app_homing_stage_t;

/** It sees these. */
typedef struct {
    const app_position_t *position;
    const app_angle_t    *angle;
    uint16_t              active; /**< BOARD_INPUT_ bits of the inputs that are in use */
    uint32_t              ticks;  /**< wraps */
    float                 ts_s;
} app_homing_seen_t;

typedef struct {
    app_homing_stage_t stage;
    bool               start_high; /**< bit 4 in the previous call */
    bool               reversed;   /**< FIND has met a limit switch */
    bool               fresh;      /**< `zero` is new; its taker clears this */
    position_t         zero;       /**< of positions, by the last homing */
    uint32_t           began_ticks;
    int16_t            off_cnt; /**< INDEX: counts from the mark to the shaft, previous call */
    bool               known;   /**< INDEX: the mark was known in the previous call */
    bool               looked;  /**< INDEX: there was a previous call */
} app_homing_t;

/** True for the methods of 6098h that exist. Context: any. */
bool app_homing_knows(int16_t method);

/** A run in this mode of operation begins, or ends. Context: control ISR, or init. */
void app_homing_reset(app_homing_t *h);

/** True in the stages that move the shaft. */
static inline bool app_homing_moves(app_homing_stage_t stage)
{
    return (stage > APP_HOMING_IDLE) && (stage < APP_HOMING_ATTAINED);
}

/** Waits a millisecond in its place: a start that rises meanwhile acts after it. */
static inline void app_homing_wait(app_homing_t *h, const app_objects_t *o)
{
    h->start_high = h->start_high && app_control_has(o->controlword, APP_CONTROL_NEW_SETPOINT);
}

/**
 * @brief Executes a millisecond.
 *
 * @return Speed to go to [electrical rad/s].
 *
 * Context: control ISR, slow work.
 */
float app_homing_tick(app_homing_t *h, const app_objects_t *o, const app_homing_seen_t *seen);

#endif /* APP_HOMING_H */
