/* SPDX-License-Identifier: MIT */
/**
 * @file voltage.h
 * @brief Limits a voltage vector to what the inverter can produce; its direction stays.
 *
 *     v = c u,  c = min(1, reach / |u|)                                        EQ-VOLTAGE-1
 *
 * Take flux errors x = (Ld e_id, Lq e_iq), the voltage h that holds the current references, and any
 * gain g > 0. Then
 *
 *     u = h - g x                                                              EQ-VOLTAGE-2
 *
 * makes the limit stable, motoring and generating, in both directions. While |h| <= reach, |x|
 * never grows, and it falls unless v = h. Reason: docs/equations.md, "The voltage limit". Each law
 * must ensure EQ-VOLTAGE-2 itself (near_optimal.c).
 */
#ifndef VOLTAGE_H
#define VOLTAGE_H

#include "base.h"
#include "frames.h"

/* Inline, because a call costs more than the arithmetic. */

/** Square of a vector's length. */
static inline float voltage_square(dq_t u_V)
{
    return (u_V.d * u_V.d) + (u_V.q * u_V.q);
}

/** true when a vector is longer than the radius of the circle, v_dc / sqrt(3). Context: control
 * ISR. */
static inline bool voltage_is_outside(dq_t u_V, float dc_link_V)
{
    const float circle_V = dc_link_V * BASE_1_SQRT3;

    return voltage_square(u_V) > (circle_V * circle_V);
}

typedef struct {
    dq_t  v_V;
    abc_t duty;    /**< duty ratios for it, EQ-SVPWM-1 */
    bool  limited; /**< it differs from the requested voltage */
} voltage_t;

/**
 * @brief Limits a voltage by EQ-VOLTAGE-1 and computes its duty ratios.
 *
 * @param u_V            Requested voltage; finite.
 * @param angle          Rotor angle at which the voltage acts.
 * @param dc_link_V      Measured [V], > 0.
 * @param overmodulation true: the reach is the hexagon; false: it is the circle.
 *
 * Context: control ISR. One division. Outside the circle without overmodulation: one more and a
 * square root.
 */
CTL_PART voltage_t voltage_produce(dq_t u_V, frames_angle_t angle, float dc_link_V,
                                   bool overmodulation);

#endif /* VOLTAGE_H */
