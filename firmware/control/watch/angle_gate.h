/* SPDX-License-Identifier: MIT */
/**
 * @file angle_gate.h
 * @brief What of a measured angle an observer may believe.
 *
 *     beyond:  abs(e) > gate                                                       EQ-ANGLE-GATE-1
 *     within:  used as clamp(e, -step, step)                                       EQ-ANGLE-GATE-4
 *     stands:  abs(theta - theta_0) <= band over n periods, while the motor must have turned further:
 *              sum_k max(abs(w_0) - k a Ts, 0) Ts > band + 2 counts                EQ-ANGLE-GATE-2
 *
 * e is the innovation, measured less estimated angle; step is the largest that a load causes. A wrong reading within the gate
 * then cannot move the estimates so far that the right ones after it are beyond. Between two samples no load turns the shaft further than the gate
 * from where the observer expects it, so that a larger innovation is an error of the reading. It is ignored for three
 * samples. If it is still there, and is the same error, the counter has lost its place: the estimated angle takes the
 * jump over, and the speed does not. If it is another error each time, or the angle stands although no load could have
 * stopped the shaft so soon, the angle is lost.
 *
 * theta_0 and w_0 are angle and estimated speed at the last sample at which the angle moved, a is the largest
 * acceleration that a load can cause. Within the band the last count toggles when one track of two has failed.
 */
#ifndef ANGLE_GATE_H
#define ANGLE_GATE_H

#include "base.h"

/** Samples that are ignored in a row. Chosen: 0.6 ms, in which the shipped motor's worst load step turns the shaft by
 * 5 mrad from where it would have been. */
#define ANGLE_GATE_HOLD 3

typedef struct {
    float gate_rad;      /**< an innovation beyond this is no motion, > 0, <= pi */
    float step_rad;      /**< the largest innovation that a load causes, > 0, <= gate */
    float count_rad;     /**< from edge to edge, electrical, > 0, <= pi */
    float slow_e_radps2; /**< no load stops the shaft faster, > 0 */
} angle_gate_config_t;

typedef struct {
    int16_t  beyond;        /**< samples in a row beyond the gate */
    int16_t  standing;      /**< samples in a row within the band of stood_rad */
    float    first_rad;     /**< innovation of the first sample beyond the gate */
    float    stood_rad;     /**< measured angle at which it moved last */
    float    speed_e_radps; /**< of a shaft that has slowed down since as fast as it could */
    float    turned_rad;    /**< by how much it has turned since, at the least */
    uint16_t ignored;       /**< samples since the start of the run; stays at 65535 */
    int16_t  lost;          /**< 1: the angle says nothing any more; until the next run */
} angle_gate_t;

/** What there is to do with a sample. */
typedef struct {
    float error_rad;      /**< as measured */
    float jump_rad;       /**< to add to the estimated angle, before anything else */
    float innovation_rad; /**< to correct with; zero when the sample is ignored */
    bool  used;           /**< the sample's angle is believed, and no jump of it */
} angle_gate_result_t;

/** true when all are in range. Context: init. */
CTL_PART bool angle_gate_check(const angle_gate_config_t *c);

/** @param theta_e_rad Measured. */
CTL_PART void angle_gate_reset(angle_gate_t *s, float theta_e_rad);

/**
 * @brief One sample.
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
