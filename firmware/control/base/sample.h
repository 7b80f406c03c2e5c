/* SPDX-License-Identifier: MIT */
/**
 * @file sample.h
 * @brief Measurements of one instant in SI units, and their values in the rotor frame.
 */
#ifndef SAMPLE_H
#define SAMPLE_H

#include "base.h"
#include "frames.h"
#include "nodo.h"

/* Inline functions in C and C++: members are set in their order. */

typedef struct {
    float ia_A;        /**< phase current, positive into the motor */
    float ib_A;        /**< phase current, positive into the motor */
    float dc_link_V;   /**< dc-link voltage */
    float theta_e_rad; /**< electrical angle, -2 pi .. 2 pi */
    float band_rad;    /**< uncertainty of the angle, 0 .. pi; 0: it is a measurement */
    float edge_gap_s; /**< time between the last two encoder edges, or since the last one if longer;
                           0: not timed by edges, or an edge in every period */
    float
        omega_e_radps; /**< electrical speed; a law with angle observer uses it only at its start */
    float edge_age_s;  /**< time since the edge that the angle was timed with; 0: none */
    bool  valid;       /**< all of the above were measured in this period */
    int16_t
        edge_of_pattern; /**< place in the disc's pattern of the edge that gave the angle, 1 .. 16;
                                  0: none (EQ-ENCODER-FORM-4) */
} drive_sample_t;

/** True if a phase current exceeds the limit or is NaN; c is -(a + b). Context: control ISR. */
static inline bool sample_over_current(float ia_A, float ib_A, float limit_A)
{
    const float two_A = base_max(fabsf(ia_A), fabsf(ib_A));

    /* A NaN in a or b is one in c, and the second operand's NaN is the maximum. */
    return !base_within(base_max(two_A, fabsf(ia_A + ib_A)), limit_A);
}

/** Currents in the frame of an angle. Context: control ISR. */
static inline dq_t sample_current_A(const drive_sample_t *s, float theta_e_rad)
{
    return frames_park(frames_clarke(s->ia_A, s->ib_A), frames_angle(theta_e_rad));
}

/** Speed and currents as measured, in the frame of the measured angle. Context: control ISR. */
static inline nodo_meas_t sample_measurement(const drive_sample_t *s)
{
    const dq_t        i_A = sample_current_A(s, s->theta_e_rad);
    const nodo_meas_t y   = {s->omega_e_radps, i_A.q, i_A.d};
    return y;
}

/** Angle in the middle of the period in which the new voltage acts, by measured speed,
 * EQ-DRIVE-2. */
static inline float sample_middle_angle_rad(const drive_sample_t *s, float ts_s)
{
    return s->theta_e_rad + (1.5f * ts_s * s->omega_e_radps);
}

#endif /* SAMPLE_H */
