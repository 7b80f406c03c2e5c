/* SPDX-License-Identifier: MIT */
/**
 * @file current_watch.h
 * @brief Detects a wrong current sensor or a broken motor wire.
 *
 * Sensor. The difference between a phase current and its model is summed with forgetting:
 *
 *     r = i - i_model,  i_model = i^ - Ts (d - d_slow)                           EQ-CURRENT-WATCH-1
 *     R+ = (1 - Ts / tau) R + r,  D = i - i_slow                                 EQ-CURRENT-WATCH-2
 *     lies:  x = abs(R) - 0.6 abs(D) > max(3/8 i_max, 7/8 jump), or
 *            > max(0.15 i_max, 3/8 jump) for 6 ms, in phase a or b               EQ-CURRENT-WATCH-3
 *
 *     or abs(r) > jump, in a sample that the gate (current_gate.h) let pass: the second in a row
 *
 * i^ is the observer's prediction with its disturbances d of the two current equations. d_slow and
 * i_slow are low-pass filtered. A motor that differs from the nominal one causes an r proportional
 * to the change D of the current. It may also cause constant disturbances d_slow in the rotor
 * frame. An error that is constant in the stator frame is a sensor's.
 *
 * Until d_slow is known, an EMF error of half the voltage circle adds 0.14 jump per period. With
 * low inductance this is much of the limit. Laws without a prediction have no such check.
 *
 * Drift. The same steps are summed in the stator frame, with a longer memory:
 *
 *     S+ = (1 - min(0.2 abs(w), 60/s) Ts) (S + exp(j theta) Ts (d - d_slow))     EQ-CURRENT-WATCH-5
 *     drifts:  abs(S) > max(0.25 i_max, 0.63 jump) and a phase carries more than 0.31 i_max,
 *              above 60 rad/s                                                    EQ-CURRENT-WATCH-6
 *
 * The error of a sensor stands still in the stator frame, so that its steps add up. An error of the
 * motor turns there, and its steps cancel. Without load, a moved zero has a larger S than itself:
 * the dead time is compensated for a wrong current. The watch forgets a part of S in each look, for
 * the periods since the look before.
 *
 * Wire. A phase has no current although the reference requires some, for longer than a current
 * needs to follow:
 *
 *     open:  abs(i) < 0.02 i_max while abs(i_ref) > 0.04 i_max in one phase,
 *            for open_s in a row                                                 EQ-CURRENT-WATCH-4
 *     open_s = max(10 ms, 4 sqrt(count / a_max)),  a_max = (l1 + abs(l11) i_max) i_max
 *
 * Near standstill the observer detects a load only after the shaft has turned by a count, in the
 * time sqrt(2 count / a). Until then the current may have any value. A sensor that always reads
 * zero looks like a broken wire.
 */
#ifndef CURRENT_WATCH_H
#define CURRENT_WATCH_H

#include "base.h"
#include "frames.h"

typedef enum {
    CURRENT_WATCH_GOOD = 0,
    CURRENT_WATCH_SENSOR, /**< EQ-CURRENT-WATCH-3, 6 */
    CURRENT_WATCH_OPEN    /**< EQ-CURRENT-WATCH-4 */
} current_watch_verdict_t;

/** Constants of a run. */
typedef struct {
    float ts_s;
    float current_max_A; /**< i_max, of the drive */
    float open_s;        /**< EQ-CURRENT-WATCH-4 */
    float jump_A;        /**< largest plausible r of one period, EQ-CURRENT-GATE-2 */
} current_watch_scale_t;

/** A phase with a sensor. */
typedef struct {
    float model_A;    /**< i_model of the next sample */
    float residual_A; /**< R */
    float slow_A;     /**< i_slow */
    float lying_s;    /**< time above 0.15 i_max, less a quarter of the time below */
} current_watch_phase_t;

typedef struct {
    current_watch_phase_t phase[2]; /**< a, b */
    ab_t                  ref_A;    /**< references at the next look */
    dq_t                  d_slow_Aps;
    ab_t                  drift_A; /**< S */
    float                 empty_s; /**< in a row */
    int16_t               empty;   /**< phase of that time, 1 to 3 */
    bool                  models;  /**< model_A too */
} current_watch_t;

/** Predictions of the law for the next sample. */
typedef struct {
    frames_angle_t angle; /**< ahead of that instant by ahead_rad, a small angle */
    float          ahead_rad;
    ab_t           i_A;       /**< predicted, turned by angle */
    dq_t           d_Aps;     /**< disturbances in that prediction */
    bool           predicted; /**< i_A and d_Aps are valid */
} current_watch_expected_t;

/**
 * @brief EQ-CURRENT-WATCH-4 [s].
 * @param count_rad        Encoder count, electrical, > 0.
 * @param accel_max_radps2 a_max, electrical; 0 or no number gives the longest, 1 s.
 *
 * Context: init.
 */
CTL_PART float current_watch_open_s(float count_rad, float accel_max_radps2);

/** Forgets everything. Context: init, and control ISR without a run. */
CTL_PART void current_watch_reset(current_watch_t *w);

/** Starts a run after current_watch_reset(). Context: control ISR. */
CTL_PART void current_watch_start(current_watch_t *w, float ia_A, float ib_A);

/** Stores the prediction of the next sample at the end of a period. Context: control ISR. No
 * division. */
CTL_PART void current_watch_expect(current_watch_t *w, const current_watch_expected_t *e,
                                   float ts_s);

/**
 * @brief Stores the current references of a period before a look at the currents.
 * @param i_ref_A Zero where a law has no references.
 *
 * Inline, because a call costs more. Context: control ISR.
 */
static inline void current_watch_ask(current_watch_t *w, dq_t i_ref_A, frames_angle_t angle)
{
    w->ref_A = frames_inverse_park(i_ref_A, angle);
}

/** EQ-CURRENT-WATCH-3 for a sample. Context: control ISR. No division. */
CTL_PART current_watch_verdict_t current_watch_judge(current_watch_t *w, float ia_A, float ib_A,
                                                     const current_watch_scale_t *scale);

/**
 * @brief EQ-CURRENT-WATCH-4 to 6, once in some periods.
 * @param omega_e_radps Electrical speed at that sample.
 * @param step_s        Time since the look before.
 *
 * Context: control ISR. No division.
 */
CTL_PART current_watch_verdict_t current_watch_look(current_watch_t *w, float ia_A, float ib_A,
                                                    float omega_e_radps, float step_s,
                                                    const current_watch_scale_t *scale);

#endif /* CURRENT_WATCH_H */
