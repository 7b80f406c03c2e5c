/* SPDX-License-Identifier: MIT */
/**
 * @file motion_watch.h
 * @brief Detects a locked rotor, an overhauling load, and an encoder with a wrong angle or motion.
 *
 *     odd:     voltage error of the model,
 *              max(Lq abs(d_q), Ld abs(d_d)) > 0.6 (flux + Lq j) abs(w) + r
 *              for 10 ms, j = abs(id) + abs(iq)                                 EQ-MOTION-WATCH-1
 *     r:       max(0.6 R j + 0.02 v_dc, 0.035 v_dc)                             EQ-MOTION-WATCH-5
 *     lost:    power that the model does not explain,
 *              abs(Lq d_q iq + Ld d_d id)
 *                > 0.5 abs((flux + (Ld - Lq) id) iq w) + r j
 *              for 10 ms, together with EQ-MOTION-WATCH-1                       EQ-MOTION-WATCH-4
 *     stall:   abs(i) > 0.9 i_max and abs(w* - w) > 10 rad/s,
 *              and for 50 ms no edge, or for 0.5 s abs(w) < 10 rad/s            EQ-MOTION-WATCH-2
 *     away:    abs(i) > 0.9 i_max, and abs(w* - w) is beyond 50 rad/s and for 250 ms
 *              20 rad/s more than it has been with this command and current     EQ-MOTION-WATCH-3
 *
 * d are the low-pass filtered disturbances of the observer's current equations. The limit of
 * EQ-MOTION-WATCH-1 covers parameter errors of one half, and the dead time. A shaft that turns with
 * a dead encoder leaves its EMF as an error. Laws without a prediction have no such check.
 *
 * A dead time that is wrong by T leaves up to 4/3 T f v_dc. With the right R, EQ-MOTION-WATCH-5
 * covers a fortieth of the PWM period.
 *
 * Voltage times current does not depend on the angle of the frame. With a wrong angle the motor
 * takes another power than the model says: EQ-MOTION-WATCH-4 sees it beyond 60 degrees. An error of
 * the inductances turns no power, but for their difference.
 */
#ifndef MOTION_WATCH_H
#define MOTION_WATCH_H

#include "base.h"
#include "motor.h"
#include "nodo.h"

typedef enum {
    MOTION_WATCH_GOOD = 0,
    MOTION_WATCH_ODD,
    MOTION_WATCH_STALL,
    MOTION_WATCH_AWAY
} motion_watch_verdict_t;

/** The looks take turns, one in a period. The last one judges currents: together, none is dearer
 * than the dearest. */
typedef enum {
    MOTION_WATCH_LOOK_STALL = 0, /**< EQ-MOTION-WATCH-2 */
    MOTION_WATCH_LOOK_VOLTAGE,   /**< EQ-MOTION-WATCH-1 and 4 */
    MOTION_WATCH_LOOK_AWAY,      /**< EQ-MOTION-WATCH-3 */
    MOTION_WATCH_LOOK_CURRENTS   /**< current_watch_look(), which the caller does */
} motion_watch_look_t;

#define MOTION_WATCH_LOOKS 4.0f

typedef struct {
    float odd_s;   /**< duration without interruption, as the others */
    float still_s; /**< no edge */
    float slow_s;
    float away_s;
    float command_e_radps;
    float nearest_e_radps;    /**< least speed error at the current limit since the command */
    motion_watch_look_t look; /**< of the next period */
} motion_watch_t;

/** Inputs of one period. */
typedef struct {
    const motor_reduced_t *motor;
    float                  current_max_A;
    float                  ts_s;
    nodo_meas_t            now;
    float                  command_e_radps;
    float                  dc_link_V;
    float                  edge_gap_s; /**< of the sample; 0: edges are not timed */
    dq_t                   d_Aps;      /**< zero where a law has no prediction */
} motion_watch_input_t;

/** Starts a run. Context: control ISR. */
CTL_PART void motion_watch_reset(motion_watch_t *w);

/**
 * @brief Evaluates the equations in three of four periods, in turn.
 *
 * The delay is at most three periods: at 5 kHz 0.6 ms, beside the shortest time of 10 ms.
 *
 * Context: control ISR. No division.
 */
CTL_PART motion_watch_verdict_t motion_watch_judge(motion_watch_t             *w,
                                                   const motion_watch_input_t *in);

#endif /* MOTION_WATCH_H */
