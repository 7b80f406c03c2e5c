/* SPDX-License-Identifier: MIT */
/**
 * @file frames.h
 * @brief Clarke and Park transformations and their inverses, amplitude invariant.
 *
 *     i_alpha = i_a,  i_beta = (i_a + 2 i_b) / sqrt(3)      EQ-FRAMES-1 (i_a + i_b + i_c = 0)
 *     x_d =  x_alpha cos + x_beta sin,
 *     x_q = -x_alpha sin + x_beta cos                       EQ-FRAMES-2
 *
 * Context: control ISR. Pure; one sine and one cosine per frames_angle().
 */
#ifndef FRAMES_H
#define FRAMES_H

#include "base.h"

/** An electrical angle, kept as its cosine and sine. */
typedef struct {
    float cos;
    float sin;
} frames_angle_t;

/** @param theta_e_rad electrical angle of the d axis from phase a; any finite value, best in +-2 pi. */
frames_angle_t frames_angle(float theta_e_rad);

/** Phase currents a and b to the stator frame, EQ-FRAMES-1. */
ab_t frames_clarke(float a, float b);

/** Stator frame to phases; the sum of the phases is zero. Inverse of EQ-FRAMES-1. */
abc_t frames_inverse_clarke(ab_t x);

/** Stator frame to rotor frame, EQ-FRAMES-2. */
dq_t frames_park(ab_t x, frames_angle_t angle);

/** Rotor frame to stator frame, inverse of EQ-FRAMES-2. */
ab_t frames_inverse_park(dq_t x, frames_angle_t angle);

#endif /* FRAMES_H */
