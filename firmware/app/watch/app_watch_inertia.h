/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_inertia.h
 * @brief Inertia of the shaft over the drive's, shown by changes of speed.
 *
 * The observer believes one inertia. A shaft with k times that one shows d_w = d_0 + (1 - k) w', as
 * in EQ-INERTIA-1, with the load in d_0. Blocks of 10 ms have a mean of d_w and a speed at their
 * end. Between two rests the speed changes by D within the time T. With the mean d_0 and the range
 * r_0 of five blocks before, and d_1 and r_1 of five after,
 *
 *     k = k_b (1 - (integral of d_w - T (d_0 + d_1) / 2) / D)                        EQ-INERTIA-5
 *     u = k_b T (r_0 + r_1 + |d_1 - d_0|) / (2 |D|)                                  EQ-INERTIA-6
 *     ratio += 0.75 (k - ratio) if u <= 0.2 k, within 0.5 .. 5                       EQ-INERTIA-7
 *
 * u estimates what a load that changes adds to k. A load step, and a load that swings, teach
 * nothing. k_b is the inertia over the drive's that the law believes (app_believe.h). When it
 * changes, a rest begins. Context: background.
 */
#ifndef APP_WATCH_INERTIA_H
#define APP_WATCH_INERTIA_H

#include "app_options.h"
#include "base.h"

#define APP_WATCH_INERTIA_REST  5U /**< blocks of a rest, chosen: a load of 20 Hz shows its range */
#define APP_WATCH_INERTIA_LEAST 0.5f
#define APP_WATCH_INERTIA_MOST  5.0f

typedef struct {
    float mean; /**< of d_w in the block [rad/s^2] */
    float time_s;
} app_watch_inertia_block_t;

typedef struct {
    app_watch_inertia_block_t block[APP_WATCH_INERTIA_REST]; /**< the last ones, a ring */
    uint16_t                  next;                          /**< place of the next one */
    uint16_t                  still;         /**< blocks at rest, one after the other */
    uint16_t                  moved;         /**< blocks of the present change; 0: at rest */
    bool                      begun;         /**< the members below are of a run */
    uint32_t                  ticks;         /**< of the pass before */
    float                     way;           /**< integral of d_w in the present block [rad/s] */
    float                     time_s;        /**< passed of the present block */
    float                     omega_e_radps; /**< at the end of the block before */
    float                     from_e_radps;  /**< at the begin of the change */
    float                     rest_mean;     /**< d_0 */
    float                     rest_range;    /**< r_0 */
    float                     integral; /**< of d_w, of the blocks that left the ring [rad/s] */
    float                     moved_s;  /**< their time */
    float                     believed; /**< of the pass before */
    float                     ratio;    /**< 0.5 .. 5; 1 until something was learned */
    uint16_t                  changes;  /**< that taught, up to 65535 */
} app_watch_inertia_t;

/** Input of a pass of the background. */
typedef struct {
    uint32_t ticks;         /**< control periods since the start */
    float    believed;      /**< k_b, inertia of the constants in force over the drive's, > 0 */
    bool     runs;          /**< the speed is controlled, with an encoder */
    float    omega_e_radps; /**< speed */
    float    d_omega;       /**< d_w, estimated with that inertia [rad/s^2] */
} app_watch_inertia_seen_t;

/** Starts with a ratio, e.g. one that was kept; 1: the drive's inertia. */
void app_watch_inertia_reset(app_watch_inertia_t *w, float ratio);

/**
 * @brief EQ-INERTIA-5, 6 and 7.
 *
 * A pass that comes more than a quarter of a block late forgets the present change. A run that ends
 * keeps the ratio.
 *
 * @param speed_max_e_radps Largest speed of a command, > 0. A block in which the speed changes by
 *                          less than 0.002 of it is at rest; a change below 0.05 teaches nothing.
 * @param ts_s              Control period [s].
 */
void app_watch_inertia_see(app_watch_inertia_t *w, const app_watch_inertia_seen_t *seen,
                           float speed_max_e_radps, float ts_s);

#endif /* APP_WATCH_INERTIA_H */
