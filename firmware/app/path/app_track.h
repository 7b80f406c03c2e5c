/* SPDX-License-Identifier: MIT */
/**
 * @file app_track.h
 * @brief Motion and clock of set-points that come at a constant rate.
 *
 * The motion is a cubic in time. With T the period, its coefficients at the newest set-point are
 *
 *     x, s_n = T^n x^(n) / n!,  n = 1, 2, 3                                 EQ-APP-TRACK-1
 *
 * A set-point that is off by r from their prediction moves them by a filter with four poles at p:
 *
 *     x   += (1 - p^4) r,                 s_1 += (1 - p)^2 (11 + 14 p + 11 p^2) r / 6,
 *     s_2 += (1 - p)^3 (1 + p) r,         s_3 += (1 - p)^4 r / 6              EQ-APP-TRACK-2
 *
 * With a speed w at each set-point, and q = T w - s_1, that speed gives the rest:
 *
 *     x   += (1 - p) r,                   s_1 += (1 - p^3) q,
 *     s_2 += 3 (1 - p)^2 (1 + p) q / 4,   s_3 += (1 - p)^3 q / 6              EQ-APP-TRACK-3
 *
 *     p = 1 / (1 + z + z^2 / 2),  z = T w_0                                   EQ-APP-TRACK-4
 *
 * After a gap of n periods, and for some set-points more, the motion is a line: s_2 and s_3 are 0.
 * With z = n T w_0 in EQ-APP-TRACK-4,
 *
 *     x   += (1 - p^2) r,                 s_1 += (1 - p)^2 r / n              EQ-APP-TRACK-5
 *
 * A cubic over gaps has no bound: a master who sends at half of the rate would drive the shaft to
 * its largest speed.
 *
 * Slow set-points are taken as they are. Fast ones have coarse counts: the filter keeps what is
 * slower than w_0. The clock is that of the set-points. Each moves it by a thirty-second of the
 * time by which it is early or late.
 */
#ifndef APP_TRACK_H
#define APP_TRACK_H

#include "base.h"
#include "position.h"

typedef struct {
    position_t at;
    float      omega_e_radps; /**< used if `given` */
    bool       given;
} app_track_point_t;

typedef struct {
    float period_s;      /**< between two set-points, > 0 */
    float speed_e_radps; /**< largest speed of a set-point, > 0 */
    float accel_e_radps2;
} app_track_limits_t;

typedef struct {
    position_t at;      /**< estimate of the newest set-point */
    float      s[3];    /**< s_1, s_2, s_3 of EQ-APP-TRACK-1 [rad] */
    float      age_s;   /**< since its time; negative: it is early */
    uint16_t   taken;   /**< set-points since the start, at most APP_TRACK_KNOWN */
    uint16_t   missed;  /**< predicted since the last one */
    uint16_t   regular; /**< set-points without a gap between them; a start counts as enough */
} app_track_t;

/** Set-points that make the clock and the motion known. */
#define APP_TRACK_KNOWN 32U

/** Begins without a set-point. Context: control ISR. */
void app_track_start(app_track_t *t);

/** Takes a set-point that came now. Context: control ISR. One division. */
void app_track_take(app_track_t *t, const app_track_point_t *point, const app_track_limits_t *l);

/** Puts the prediction of the next set-point in its place. Two are on the cubic, those after them
 * at a constant speed. Context: control ISR. */
void app_track_predict(app_track_t *t, const app_track_limits_t *l);

/** A position moved by any way below 1e6 rad. The number of turns stays within its limit. */
position_t app_track_moved(const position_t *p, float by_rad);

#endif /* APP_TRACK_H */
