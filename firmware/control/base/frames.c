/* SPDX-License-Identifier: MIT */
#include "frames.h"

/* A turn in two parts: the first has eight bits, so that its products with small integers are
 * exact. */
#define TURN_UPPER 6.28125f
#define TURN_LOWER 1.93530717e-3f

frames_angle_t frames_angle(float theta_e_rad)
{
    const float turns = frames_turns(theta_e_rad);
    const float r     = (theta_e_rad - (turns * TURN_UPPER)) - (turns * TURN_LOWER); /* +-pi */
    const float up    = base_max(r, -BASE_PI - r);

    const frames_angle_t angle = {.cos = frames_sine(FRAMES_HALF_PI - fabsf(r)),
                                  .sin = frames_sine(base_min(up, BASE_PI - r))};
    return angle;
}
