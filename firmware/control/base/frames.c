/* SPDX-License-Identifier: MIT */
#include "frames.h"

/* pi/2 in two parts: the first has eight bits, so that its products with small integers are exact. */
#define HALF_PI_UPPER  1.5703125f
#define HALF_PI_LOWER  4.83826792e-4f
#define QUARTERS_1prad 0.636619772f /* 2 / pi */

/* Minimax fits on +-pi/4: largest relative error of the sine 3.6e-9, of the cosine 1e-10. */
#define S1 -1.66666552e-1f
#define S2 8.33217800e-3f
#define S3 -1.95172994e-4f
#define C1 4.16666456e-2f
#define C2 -1.38873677e-3f
#define C3 2.44384519e-5f

frames_angle_t frames_angle(float theta_e_rad)
{
    const float    theta    = base_clamp(theta_e_rad, -FRAMES_ANGLE_MAX, FRAMES_ANGLE_MAX);
    const float    quarters = theta * QUARTERS_1prad;
    const int16_t  nearest  = (int16_t)((quarters < 0.0f) ? (quarters - 0.5f) : (quarters + 0.5f));
    const float    n        = (float)nearest;
    const float    r        = (theta_e_rad - (n * HALF_PI_UPPER)) - (n * HALF_PI_LOWER);
    const float    r2       = r * r;
    const float    sine     = r + ((r * r2) * (S1 + (r2 * (S2 + (r2 * S3))))); /* EQ-FRAMES-3 */
    const float    cosine   = (1.0f - (0.5f * r2)) + ((r2 * r2) * (C1 + (r2 * (C2 + (r2 * C3)))));
    const uint16_t quarter  = (uint16_t)nearest & 3U;
    const bool     swapped  = (quarter & 1U) != 0U;
    const float    c        = swapped ? sine : cosine;
    const float    s        = swapped ? cosine : sine;

    const frames_angle_t angle = {.cos = ((quarter == 1U) || (quarter == 2U)) ? -c : c,
                                  .sin = (quarter >= 2U) ? -s : s};
    return angle;
}
