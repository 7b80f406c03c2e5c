/* SPDX-License-Identifier: MIT */
#include "svpwm.h"

#include <math.h>

#include "frames.h"

abc_t svpwm_duty(ab_t v_V, float v_dc_V)
{
    const abc_t v      = frames_inverse_clarke(v_V);
    const float centre = 0.5f * (fmaxf(v.a, fmaxf(v.b, v.c)) + fminf(v.a, fminf(v.b, v.c)));
    const float inv_V  = 1.0f / v_dc_V;

    const abc_t duty = {/* EQ-SVPWM-1 */
                        .a = base_clamp(0.5f + ((v.a - centre) * inv_V), 0.0f, 1.0f),
                        .b = base_clamp(0.5f + ((v.b - centre) * inv_V), 0.0f, 1.0f),
                        .c = base_clamp(0.5f + ((v.c - centre) * inv_V), 0.0f, 1.0f)};
    return duty;
}
