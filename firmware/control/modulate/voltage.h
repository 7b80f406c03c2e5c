/* SPDX-License-Identifier: MIT */
/**
 * @file voltage.h
 * @brief What the inverter can produce of a wanted voltage: the vector's length is cut, its direction stays.
 *
 *     v = c u,  c = min(1, reach / |u|)                                        EQ-VOLTAGE-1
 *
 * With flux errors x = (Ld e_id, Lq e_iq), the voltage h that holds the currents asked for, and any pull g > 0,
 *
 *     u = h - g x                                                              EQ-VOLTAGE-2
 *
 * makes the cut stable, motoring and generating, in both directions: |x| never grows as long as |h| <= reach, and
 * falls unless v = h. Reason: docs/equations.md, "The voltage limit". A law has to see to EQ-VOLTAGE-2 itself
 * (near_optimal.c).
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

/** true when a vector is longer than the radius of the circle, v_dc / sqrt(3). Context: control ISR. */
static inline bool voltage_is_outside(dq_t u_V, float dc_link_V)
{
    const float circle_V = dc_link_V * BASE_1_SQRT3;

    return voltage_square(u_V) > (circle_V * circle_V);
}

typedef struct {
    dq_t  v_V;
    abc_t duty;    /**< that produce it, EQ-SVPWM-1 */
    bool  limited; /**< it is not the voltage that was wanted */
} voltage_t;

/**
 * @brief EQ-VOLTAGE-1 with the circle, or with the hexagon around it, as reach, and its duty ratios.
 *
 * @param u_V            Wanted; finite.
 * @param angle          In which the voltage is produced.
 * @param dc_link_V      Measured [V], > 0.
 * @param overmodulation Whether the hexagon outside the circle may be used.
 *
 * Context: control ISR. One division; outside the circle, where that is the reach, one more and a square root.
 */
CTL_PART voltage_t voltage_produce(dq_t u_V, frames_angle_t angle, float dc_link_V,
                                   bool overmodulation);

#endif /* VOLTAGE_H */
