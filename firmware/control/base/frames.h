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

#define FRAMES_TURNS_1prad 0.159154943f /* turns in a rad */
#define FRAMES_HALF_PI     1.57079633f

/* Minimax fit on +-pi/2: largest relative error 6.1e-9. */
#define FRAMES_S1 -1.66666597e-1f
#define FRAMES_S2 8.33306555e-3f
#define FRAMES_S3 -1.98095222e-4f
#define FRAMES_S4 2.60559204e-6f

/* 1.5 times 2^23, where the last place counts ones: a number added to it and taken off again is the
 * nearest integer. The FPU has to round to nearest, as TI's compiler sets it at the start of every
 * interrupt. Another type has another number. */
#ifndef FRAMES_ONES
#define FRAMES_ONES 12582912.0f
#endif

/* Inline, because a call costs more than the arithmetic. In C and C++: members are set in their
 * order. */

/** Whole turns nearest to an angle. */
static inline float frames_turns(float angle_rad)
{
    return ((angle_rad * FRAMES_TURNS_1prad) + FRAMES_ONES) - FRAMES_ONES;
}

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

/** EQ-FRAMES-3: the sine of an angle within +-pi/2. */
static inline float frames_sine(float r)
{
    const float r2 = r * r;
    const float s  = FRAMES_S1 + (r2 * (FRAMES_S2 + (r2 * (FRAMES_S3 + (r2 * FRAMES_S4)))));

    return r + ((r * r2) * s);
}

/** frames_angle() of an angle within +-pi/2, bit for bit, inline and without a search for its
 * turns. */
static inline frames_angle_t frames_small_angle(float theta_e_rad)
{
    const frames_angle_t angle = {frames_sine(FRAMES_HALF_PI - fabsf(theta_e_rad)),
                                  frames_sine(theta_e_rad)};
    return angle;
}

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

/** Wraps an angle into +-pi; exact for angles within +-3 pi. No branch. */
static inline float frames_wrap(float angle_rad)
{
    return angle_rad - (frames_turns(angle_rad) * BASE_TWO_PI);
}

#endif /* FRAMES_H */
