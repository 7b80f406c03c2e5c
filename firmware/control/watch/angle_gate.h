/* SPDX-License-Identifier: MIT */
/**
 * @file angle_gate.h
 * @brief Innovation gate: decides how far an observer uses a measured angle.
 *
 *     beyond:  abs(e) > gate                                                       EQ-ANGLE-GATE-1
 *     within:  used as clamp(e, -step, step)                                       EQ-ANGLE-GATE-4
 *     stands:  abs(theta - theta_0) <= band over n periods while the motor must have turned more:
 *              sum_k max(abs(w_0) - k a Ts, 0) Ts > band + 2 counts                EQ-ANGLE-GATE-2
 *
 * e is the innovation, measured minus estimated angle. step is the largest innovation that a load
 * causes. The clamp to it keeps the estimates inside the gate after a wrong reading within the
 * gate.
 *
 * Between two samples no load turns the shaft further than the gate from its prediction. A larger
 * innovation is a measurement error and is ignored for three samples. If the same error persists,
 * the counter is shifted: the estimated angle takes the jump, and the speed stays. If the error
 * changes each time, the angle is lost. It is also lost if it stands although no load could stop
 * the shaft so fast.
 *
 * theta_0 and w_0 are angle and estimated speed at the last sample at which the angle moved. Here a
 * is the largest acceleration that a load causes. If one of the two tracks fails, the last count
 * toggles within the band.
 */
#ifndef ANGLE_GATE_H
#define ANGLE_GATE_H

#include "base.h"

/** Samples ignored in a row. Chosen: 0.6 ms. In this time the worst load step of the shipped motor
 * turns
 *  the shaft by 5 mrad from its prediction. */
#define ANGLE_GATE_HOLD 3

typedef struct {
    float gate_rad;      /**< largest innovation by motion, > 0, <= pi */
    float step_rad;      /**< the largest innovation that a load causes, > 0, <= gate */
    float count_rad;     /**< from edge to edge, electrical, > 0, <= pi */
    float slow_e_radps2; /**< largest deceleration by a load, > 0 */
} angle_gate_config_t;

typedef struct {
    int16_t  beyond;        /**< samples in a row beyond the gate */
    int16_t  standing;      /**< samples in a row within the band of stood_rad */
    float    first_rad;     /**< innovation of the first sample beyond the gate */
    float    stood_rad;     /**< measured angle at the last movement */
    float    speed_e_radps; /**< speed after the largest possible deceleration since then */
    float    turned_rad;    /**< least possible rotation since then */
    uint16_t ignored;       /**< ignored samples since the start of the run; stays at 65535 */
    int16_t  lost;          /**< 1: the angle is lost until the next run */
} angle_gate_t;

/** Result for one sample. */
typedef struct {
    float error_rad;      /**< as measured */
    float jump_rad;       /**< add it to the estimated angle first */
    float innovation_rad; /**< use it for the correction; zero: the sample is ignored */
    bool  used;           /**< the angle is used and has no jump */
} angle_gate_result_t;

/** true when all are in range. Context: init. */
CTL_PART bool angle_gate_check(const angle_gate_config_t *c);

/** Starts a run. @param theta_e_rad Measured angle. */
CTL_PART void angle_gate_reset(angle_gate_t *s, float theta_e_rad);

/**
 * @brief Judges one sample.
 *
 * @param s             State.
 * @param c             Constants.
 * @param theta_e_rad   Measured angle.
 * @param error_rad     Measured less estimated angle, within +-pi.
 * @param omega_e_radps Estimated speed, not yet corrected with this sample.
 * @param ts_s          Control period [s].
 *
 * Context: control ISR. No division.
 */
CTL_PART angle_gate_result_t angle_gate_pass(angle_gate_t *s, const angle_gate_config_t *c,
                                             float theta_e_rad, float error_rad,
                                             float omega_e_radps, float ts_s);

#endif /* ANGLE_GATE_H */
