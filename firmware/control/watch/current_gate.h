/* SPDX-License-Identifier: MIT */
/**
 * @file current_gate.h
 * @brief Distinguishes over-current from an outlier of the phase current samples.
 *
 *     over current:  beyond the trip level in two of the last three samples       EQ-CURRENT-GATE-1
 *     spike:         beyond it in this one alone; or, if the previous sample was none,
 *                    abs(i - i^) > 2 v_dc Ts / L in a phase                       EQ-CURRENT-GATE-2
 *
 * i^ is the law's prediction and L the smaller inductance. In one period a winding's current
 * changes by at most half of the limit in EQ-CURRENT-GATE-2. A true over-current is therefore still
 * present in the next sample. A spike, up to the converter's full scale, is discarded. The hardware
 * trips on faster over-currents (docs/hardware.md).
 */
#ifndef CURRENT_GATE_H
#define CURRENT_GATE_H

#include "base.h"
#include "sample.h"

typedef struct {
    uint16_t recent;  /**< bit n: the sample n periods ago was beyond the trip level, n <= 2 */
    bool     jumped;  /**< the previous sample was far from its prediction */
    uint16_t ignored; /**< discarded samples since the start; stays at 65535 */
} current_gate_t;

typedef enum {
    CURRENT_GATE_GOOD = 0,
    CURRENT_GATE_SPIKE, /**< outlier: do not use the sample */
    CURRENT_GATE_TRIP   /**< over current, or no number */
} current_gate_verdict_t;

/** Limits and prediction for one sample. */
typedef struct {
    float trip_A;   /**< of a phase */
    float jump_A;   /**< distance of a phase current from its prediction */
    abc_t i_hat_A;  /**< prediction */
    bool  expected; /**< false: there is no prediction, and one sample trips */
} current_gate_input_t;

CTL_PART void current_gate_reset(current_gate_t *s);

/** Judges one sample of the phase currents. Context: control ISR. */
CTL_PART current_gate_verdict_t current_gate_judge(current_gate_t *s, float ia_A, float ib_A,
                                                   const current_gate_input_t *in);

/**
 * @brief Returns the sample with predicted currents instead of the measured ones.
 *
 * @param s         Sample of this instant.
 * @param i_A       Predicted current in the rotor frame.
 * @param theta_rad Angle of that frame at this instant.
 *
 * Context: control ISR. One sine and cosine.
 */
CTL_PART drive_sample_t current_gate_replaced(const drive_sample_t *s, dq_t i_A, float theta_rad);

#endif /* CURRENT_GATE_H */
