/* SPDX-License-Identifier: MIT */
/**
 * @file app_path.h
 * @brief The motion from set-point to set-point: cyclic synchronous position.
 *
 * A set-point is passed one period after it came. Each one begins a piece of the path: a polynomial
 * of the fifth degree from the motion of now to that of the set-point (app_track.h). Position,
 * speed and acceleration have no steps, and the jerk has a limit:
 *
 *     x = c_1 u + .. + c_5 u^5,   u = t / L,   L = T, at least APP_PATH_SHORTEST_s  EQ-APP-PATH-1
 *
 * A longer L than T leads to where the cubic of the set-points is then. A piece beyond the limits
 * of speed, acceleration or jerk is tried again in the next period, half as long again. So a step
 * of the set-points takes the time that it needs. A set-point that has not come at its time is
 * predicted. One that comes later changes the rest of its piece.
 *
 * Without set-points the path runs on for four periods, at least APP_PATH_RUN_ON_s. Then it says
 * `lost`, and its owner acts. Before the first set-point it comes to rest.
 */
#ifndef APP_PATH_H
#define APP_PATH_H

#include "app_track.h"
#include "position_ref.h"

#define APP_PATH_SHORTEST_s 0.015f /* chosen by simulation: counts give less torque than 1 % */
#define APP_PATH_RUN_ON_s   0.02f  /* chosen: a line has this much silence at times */
#define APP_PATH_RUN_ON     4.0f   /* periods */

/** Set by the owner before any tick. */
typedef struct {
    app_track_limits_t track;
    float              jerk_e_radps3; /**< > 0 */
    float              window_rad;    /**< of the following error; 0: any is allowed */
    float              time_out_s;    /**< that it may be beyond it */
    float              start_e_radps; /**< speed of the shaft at the start */
    app_track_point_t  point;         /**< newest set-point */
    bool               fresh;         /**< it is new; a tick clears this */
} app_path_aim_t;

typedef struct {
    app_path_aim_t aim;
    app_track_t    track;
    position_t     from;     /**< begin of this piece */
    float          c[6];     /**< EQ-APP-PATH-1 [rad], c_0 is 0 */
    float          u;        /**< where on it, 0 .. 1 */
    float          per_s;    /**< 1 / L */
    float          late_s;   /**< by which this piece ends later than its set-point */
    float          beyond_s; /**< since the following error left its window */
    bool           due;      /**< a piece is to begin */
    bool           leads;    /**< this one leads to a set-point */
    bool           begun;
    bool           lost;     /**< no set-points for longer than the path runs on */
    bool           deviates; /**< the following error was beyond its window for its time */
} app_path_t;

/** Ends a run: the next tick begins one. Context: control ISR, or init. */
void app_path_end(app_path_t *p);

/**
 * @brief Executes one period.
 *
 * @param p      Path.
 * @param actual Position of this period's sample.
 * @param ts_s   Control period [s].
 * @param out    The motion a period after that sample.
 *
 * Context: control ISR. Two divisions with a set-point.
 */
void app_path_tick(app_path_t *p, const position_t *actual, float ts_s, position_motion_t *out);

#endif /* APP_PATH_H */
