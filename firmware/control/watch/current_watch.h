/* SPDX-License-Identifier: MIT */
/**
 * @file current_watch.h
 * @brief Currents that are not those of the motor: a current sensor that lies, or a motor wire that is broken.
 *
 * Sensor. What a phase current changes by in a period and the model does not know of, is collected and forgotten:
 *
 *     r = i - i_model,  i_model = i^ - Ts (d - d_slow)                             EQ-CURRENT-WATCH-1
 *     R+ = (1 - Ts / tau) R + r,  D = i - i_slow                                   EQ-CURRENT-WATCH-2
 *     lies:  x = abs(R) - 0.6 abs(D) > max(3/8 i_max, 7/8 jump), or
 *            > max(0.15 i_max, 3/8 jump) for 6 ms, in phase a or b                   EQ-CURRENT-WATCH-3
 *
 *     or abs(r) > jump, in a sample that the gate (current_gate.h) let pass: the second one in a row
 *
 * i^ is what the law's observer predicts with its disturbances d of the two current equations; d_slow and i_slow are behind
 * low-passes. A motor that is not as believed leaves an r in proportion to what the current changes by itself, D, or
 * disturbances that stand still in the rotor's frame, d_slow; until those are known, an EMF that is wrong by half of the
 * voltage circle adds 0.14 jump in a period, which with little inductance is much of the limit. What stands still in the stator's frame is a sensor. Laws
 * without such a prediction have no such check.
 *
 * Wire. A phase without current, while the reference asks for some, for longer than a current takes to follow:
 *
 *     open:  abs(i) < 0.02 i_max while abs(i_ref) > 0.04 i_max, for open_s in a row    EQ-CURRENT-WATCH-4
 *     open_s = max(10 ms, 4 sqrt(count / a_max)),  a_max = (l1 + abs(l11) i_max) i_max
 *
 * Near standstill an observer hears of a load once the shaft has turned by a count, which takes sqrt(2 count / a): until
 * then the current may be anywhere. A sensor that reads nothing looks the same as a broken wire.
 */
#ifndef CURRENT_WATCH_H
#define CURRENT_WATCH_H

#include "base.h"
#include "frames.h"

typedef enum {
    CURRENT_WATCH_GOOD = 0,
    CURRENT_WATCH_SENSOR, /**< EQ-CURRENT-WATCH-3 */
    CURRENT_WATCH_OPEN    /**< EQ-CURRENT-WATCH-4 */
} current_watch_verdict_t;

/** What does not change in a run. */
typedef struct {
    float ts_s;
    float current_max_A; /**< i_max, of the drive */
    float open_s;        /**< EQ-CURRENT-WATCH-4 */
    float jump_A; /**< no current changes so far from the model in a period, EQ-CURRENT-GATE-2 */
} current_watch_scale_t;

/** A phase with a sensor. */
typedef struct {
    float model_A;    /**< i_model of the next sample */
    float residual_A; /**< R */
    float slow_A;     /**< i_slow */
    float lying_s;    /**< beyond 0.15 i_max, less a quarter of the time within it */
} current_watch_phase_t;

typedef struct {
    current_watch_phase_t phase[2]; /**< a, b */
    abc_t                 ref_A;    /**< asked for at the next sample */
    dq_t                  d_slow_Aps;
    float                 empty_s[3]; /**< in a row */
    bool                  expects;    /**< ref_A is of the coming sample */
    bool                  models;     /**< model_A too */
} current_watch_t;

/** What the law knows of the instant of the next sample. */
typedef struct {
    frames_angle_t angle; /**< ahead of that instant by ahead_rad, a small angle */
    float          ahead_rad;
    dq_t           i_A;       /**< predicted */
    dq_t           d_Aps;     /**< disturbances that it was predicted with */
    dq_t           i_ref_A;   /**< zero where a law has no references */
    bool           predicted; /**< i_A and d_Aps hold */
} current_watch_expected_t;

/**
 * @brief EQ-CURRENT-WATCH-4 [s].
 * @param count_rad        Of the encoder, electrical, > 0.
 * @param accel_max_radps2 a_max, electrical; 0 or no number gives the longest, 1 s.
 *
 * Context: init.
 */
CTL_PART float current_watch_open_s(float count_rad, float accel_max_radps2);

/** Start of a run. Context: control ISR. */
CTL_PART void current_watch_reset(current_watch_t *w, float ia_A, float ib_A);

/** At the end of a period: what the next sample should be. Context: control ISR. No division. */
CTL_PART void current_watch_expect(current_watch_t *w, const current_watch_expected_t *e,
                                   float ts_s);

/** The next sample. Context: control ISR. No division. */
CTL_PART current_watch_verdict_t current_watch_judge(current_watch_t *w, float ia_A, float ib_A,
                                                     const current_watch_scale_t *scale);

#endif /* CURRENT_WATCH_H */
