/* SPDX-License-Identifier: MIT */
#include "svpwm.h"

#include "frames.h"

static float largest(abc_t v)
{
    return base_max(v.a, base_max(v.b, v.c));
}

static float smallest(abc_t v)
{
    return base_min(v.a, base_min(v.b, v.c));
}

abc_t svpwm_duty(ab_t v_V, float v_dc_V)
{
    const abc_t v      = frames_inverse_clarke(v_V);
    const float centre = 0.5f * (largest(v) + smallest(v));
    const float inv_V  = 1.0f / v_dc_V;

    const abc_t duty = {/* EQ-SVPWM-1 */
                        .a = 0.5f + ((v.a - centre) * inv_V),
                        .b = 0.5f + ((v.b - centre) * inv_V),
                        .c = 0.5f + ((v.c - centre) * inv_V)};
    return duty;
}

float svpwm_share(ab_t v_V, float v_dc_V)
{
    const abc_t v        = frames_inverse_clarke(v_V);
    const float spread_V = largest(v) - smallest(v);

    return (spread_V > v_dc_V) ? (v_dc_V / spread_V) : 1.0f; /* EQ-SVPWM-2 */
}
