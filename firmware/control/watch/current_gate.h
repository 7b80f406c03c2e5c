/* SPDX-License-Identifier: MIT */
/**
 * @file current_gate.h
 * @brief Over-current, or a reading of the phase currents that is wrong.
 *
 *     over current:  beyond the trip level in two of the last three samples         EQ-CURRENT-GATE-1
 *     spike:         beyond it in this one alone; or, the sample before being none,
 *                    abs(i - i^) > 2 v_dc Ts / L in a phase                         EQ-CURRENT-GATE-2
 *
 * i^ is what the law expects, L the smaller inductance. A winding's current cannot change further in a period than by
 * half of that, so that what is beyond in one sample is still there in the next. A spike, up to the converter's full
 * scale, is not used. What no sample is fast enough for, the hardware trips by itself (docs/hardware.md).
 */
#ifndef CURRENT_GATE_H
#define CURRENT_GATE_H

#include "base.h"
#include "sample.h"

typedef struct {
    uint16_t recent;  /**< bit n: the sample n periods ago was beyond the trip level, n <= 2 */
    bool     jumped;  /**< the sample before was far from what was expected */
    uint16_t ignored; /**< samples since the start; stays at 65535 */
} current_gate_t;

typedef enum {
    CURRENT_GATE_GOOD = 0,
    CURRENT_GATE_SPIKE, /**< not to be used */
    CURRENT_GATE_TRIP   /**< over current, or no number */
} current_gate_verdict_t;

/** What a sample's currents are compared with. */
typedef struct {
    float trip_A;   /**< of a phase */
    float jump_A;   /**< of a phase, from what was expected */
    abc_t i_hat_A;  /**< expected */
    bool  expected; /**< false: no law runs that expects any; one sample is enough then */
} current_gate_input_t;

CTL_PART void current_gate_reset(current_gate_t *s);

/** One sample of the phase currents. Context: control ISR. */
CTL_PART current_gate_verdict_t current_gate_judge(current_gate_t *s, float ia_A, float ib_A,
                                                   const current_gate_input_t *in);

/**
 * @brief A sample with the currents that were expected in place of the measured ones.
 *
 * @param s         Sample of this instant.
 * @param i_A       Expected in the rotor's frame.
 * @param theta_rad Of that frame, at this instant.
 *
 * Context: control ISR. One sine and cosine.
 */
CTL_PART drive_sample_t current_gate_replaced(const drive_sample_t *s, dq_t i_A, float theta_rad);

#endif /* CURRENT_GATE_H */
