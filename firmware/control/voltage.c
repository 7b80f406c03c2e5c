/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include <math.h>

/* Largest s <= 1 with |hold + s r| <= v_max, or the s of the shortest vector, not below 0. */
static float scale(dq_t hold_V, dq_t r_V, float v_max_V)
{
    const float a = (r_V.d * r_V.d) + (r_V.q * r_V.q);
    const float b = (r_V.d * hold_V.d) + (r_V.q * hold_V.q);
    const float c = (hold_V.d * hold_V.d) + (hold_V.q * hold_V.q) - (v_max_V * v_max_V);

    if (a <= 0.0f) {
        return 0.0f;
    }
    const float discriminant = (b * b) - (a * c);
    const float root         = (discriminant > 0.0f) ? sqrtf(discriminant) : 0.0f;
    return base_clamp((root - b) / a, 0.0f, 1.0f);
}

voltage_limited_t voltage_limit(dq_t v_V, dq_t hold_V, float v_max_V)
{
    const float       v_max2 = v_max_V * v_max_V;
    voltage_limited_t out    = {.v_V = v_V, .limited = false};

    if (base_in_range((v_V.d * v_V.d) + (v_V.q * v_V.q), 0.0f, v_max2)) {
        return out;
    }
    const dq_t  r_V = {.d = v_V.d - hold_V.d, .q = v_V.q - hold_V.q};
    const float s   = scale(hold_V, r_V, v_max_V); /* EQ-VOLTAGE-1 */
    out.limited     = true;
    out.v_V.d       = hold_V.d + (s * r_V.d);
    out.v_V.q       = hold_V.q + (s * r_V.q);

    const float length2 = (out.v_V.d * out.v_V.d) + (out.v_V.q * out.v_V.q);
    if (length2 > v_max2) {
        const float shrink = v_max_V / sqrtf(length2);
        out.v_V.d *= shrink;
        out.v_V.q *= shrink;
    }
    return out;
}
