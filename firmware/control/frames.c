/* SPDX-License-Identifier: MIT */
#include "frames.h"

#include <math.h>

frames_angle_t frames_angle(float theta_e_rad)
{
    const frames_angle_t angle = {.cos = cosf(theta_e_rad), .sin = sinf(theta_e_rad)};
    return angle;
}

ab_t frames_clarke(float a, float b)
{
    const ab_t x = {.alpha = a, .beta = (a + (2.0f * b)) * BASE_1_SQRT3}; /* EQ-FRAMES-1 */
    return x;
}

abc_t frames_inverse_clarke(ab_t x)
{
    const float half_alpha = 0.5f * x.alpha;
    const float half_beta  = 0.5f * BASE_SQRT3 * x.beta;
    const abc_t phases = {.a = x.alpha, .b = half_beta - half_alpha, .c = -half_beta - half_alpha};
    return phases;
}

dq_t frames_park(ab_t x, frames_angle_t angle)
{
    const dq_t y = {/* EQ-FRAMES-2 */
                    .d = (x.alpha * angle.cos) + (x.beta * angle.sin),
                    .q = (x.beta * angle.cos) - (x.alpha * angle.sin)};
    return y;
}

ab_t frames_inverse_park(dq_t x, frames_angle_t angle)
{
    const ab_t y = {.alpha = (x.d * angle.cos) - (x.q * angle.sin),
                    .beta  = (x.d * angle.sin) + (x.q * angle.cos)};
    return y;
}
