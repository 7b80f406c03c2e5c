/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include <math.h>

/* Chosen: a tenth of the holding voltage given up lets the q current fall by no more than a tenth of what
 * the back-EMF alone would make it fall. */
#define KEEP_SHARE 0.9f

static float leg(float hypotenuse, float other_leg)
{
    const float square = (hypotenuse * hypotenuse) - (other_leg * other_leg);
    return (square > 0.0f) ? sqrtf(square) : 0.0f;
}

dq_t voltage_limit(dq_t v_V, float hold_q_V, float v_max_V)
{
    if (base_in_range((v_V.d * v_V.d) + (v_V.q * v_V.q), 0.0f, v_max_V * v_max_V)) {
        return v_V;
    }
    const float keep_V = base_min(KEEP_SHARE * base_min(fabsf(hold_q_V), v_max_V), fabsf(v_V.q));
    const float d_V    = leg(v_max_V, keep_V); /* EQ-VOLTAGE-1 */
    dq_t        out_V;

    out_V.d         = base_clamp(v_V.d, -d_V, d_V);
    const float q_V = leg(v_max_V, out_V.d);
    out_V.q         = base_clamp(v_V.q, -q_V, q_V);
    return out_V;
}
