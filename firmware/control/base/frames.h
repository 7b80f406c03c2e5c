/* SPDX-License-Identifier: MIT */
/**
 * @file frames.h
 * @brief Clarke and Park transformations and their inverses, amplitude invariant.
 *
 *     i_alpha = i_a,  i_beta = (i_a + 2 i_b) / sqrt(3)      EQ-FRAMES-1 (i_a + i_b + i_c = 0)
 *     x_d =  x_alpha cos + x_beta sin,
 *     x_q = -x_alpha sin + x_beta cos                       EQ-FRAMES-2
 *
 * Context: control ISR. Pure.
 */
#ifndef FRAMES_H
#define FRAMES_H

#include "base.h"

/* Inline, because a call costs more than the arithmetic. In C and C++: members are set in their order. */

/** An electrical angle, kept as its cosine and sine. */
typedef struct {
    float cos;
    float sin;
} frames_angle_t;

/**
 * @brief Cosine and sine of an angle, bit-identical on every machine.
 *
 * r is the angle without its turns, within +-pi. S is a sine polynomial within +-pi/2:
 *
 *     sin = S(min(max(r, -pi - r), pi - r)),  cos = S(pi/2 - |r|)
 *     S(x) = x + x^3 (s_1 + s_2 x^2 + s_3 x^4 + s_4 x^6)                    EQ-FRAMES-3
 *
 * Worst error within +-2 turns: 1.7e-7. For larger angles, half a digit of the angle is added
 * (tests/unit/control/base/test_frames.c). Sums are rounded to nearest.
 *
 * @param theta_e_rad Electrical angle of the d axis from phase a, within +-5e4. Beyond it and for a
 * NaN
 *                    the result is undefined.
 *
 * Context: control ISR. No division.
 */
frames_angle_t frames_angle(float theta_e_rad);

/** Phase currents a and b to the stator frame. */
static inline ab_t frames_clarke(float a, float b)
{
    const ab_t x = {a, (a + (2.0f * b)) * BASE_1_SQRT3}; /* EQ-FRAMES-1 */
    return x;
}

/** Stator frame to phases; the sum of the phases is zero. Inverse of EQ-FRAMES-1. */
static inline abc_t frames_inverse_clarke(ab_t x)
{
    const float half_alpha = 0.5f * x.alpha;
    const float half_beta  = 0.5f * BASE_SQRT3 * x.beta;
    const abc_t phases     = {x.alpha, half_beta - half_alpha, -half_beta - half_alpha};
    return phases;
}

/** Stator frame to rotor frame. */
static inline dq_t frames_park(ab_t x, frames_angle_t angle)
{
    const dq_t y = {/* EQ-FRAMES-2 */
                    (x.alpha * angle.cos) + (x.beta * angle.sin),
                    (x.beta * angle.cos) - (x.alpha * angle.sin)};
    return y;
}

/** Rotor frame to stator frame, inverse of EQ-FRAMES-2. */
static inline ab_t frames_inverse_park(dq_t x, frames_angle_t angle)
{
    const ab_t y = {(x.d * angle.cos) - (x.q * angle.sin), (x.d * angle.sin) + (x.q * angle.cos)};
    return y;
}

/** Wraps an angle into +-pi; exact for angles within +-3 pi. */
static inline float frames_wrap(float angle_rad)
{
    if (angle_rad > BASE_PI) {
        return angle_rad - BASE_TWO_PI;
    }
    return (angle_rad < -BASE_PI) ? (angle_rad + BASE_TWO_PI) : angle_rad;
}

#endif /* FRAMES_H */
