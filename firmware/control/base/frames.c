/* SPDX-License-Identifier: MIT */
#include "frames.h"

/* A turn in two parts: the first has eight bits, so that its products with small integers are exact. */
#define TURN_UPPER  6.28125f
#define TURN_LOWER  1.93530717e-3f
#define TURNS_1prad 0.159154943f
#define HALF_PI     1.57079633f

/* 1.5 times 2^23, where the last place counts ones: a number added to it and taken off again is the nearest integer. The
 * FPU has to round to nearest, as TI's compiler sets it at the start of every interrupt. Another type has another number. */
#ifndef FRAMES_ONES
#define FRAMES_ONES 12582912.0f
#endif

/* Minimax fit on +-pi/2: largest relative error 6.1e-9. */
#define S1 -1.66666597e-1f
#define S2 8.33306555e-3f
#define S3 -1.98095222e-4f
#define S4 2.60559204e-6f

/* Within +-pi/2. */
static inline float sine(float r)
{
    const float r2 = r * r;

    return r + ((r * r2) * (S1 + (r2 * (S2 + (r2 * (S3 + (r2 * S4))))))); /* EQ-FRAMES-3 */
}

frames_angle_t frames_angle(float theta_e_rad)
{
    const float turns = ((theta_e_rad * TURNS_1prad) + FRAMES_ONES) - FRAMES_ONES;
    const float r     = (theta_e_rad - (turns * TURN_UPPER)) - (turns * TURN_LOWER); /* +-pi */
    const float up    = base_max(r, -BASE_PI - r);

    const frames_angle_t angle = {.cos = sine(HALF_PI - fabsf(r)),
                                  .sin = sine(base_min(up, BASE_PI - r))};
    return angle;
}
