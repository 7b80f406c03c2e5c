/* SPDX-License-Identifier: MIT */
#include "frames.h"

#include <math.h>

frames_angle_t frames_angle(float theta_e_rad)
{
    const frames_angle_t angle = {.cos = cosf(theta_e_rad), .sin = sinf(theta_e_rad)};
    return angle;
}
