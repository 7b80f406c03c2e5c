/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include <math.h>

/* Chosen: a tenth of the holding voltage given up lets the q current fall by no more than a tenth of what
 * the back-EMF alone would make it fall. */
#define KEEP_SHARE 0.9f

dq_t voltage_limit(dq_t v_V, float hold_q_V, float v_max_V)
{
    const float d2_V2   = v_V.d * v_V.d;
    const float max2_V2 = v_max_V * v_max_V;

    if (d2_V2 + (v_V.q * v_V.q) <= max2_V2) {
        return v_V;
    }
    /* EQ-VOLTAGE-1; the second argument of a minimum is what a NaN in the first becomes. */
    const float keep_V   = base_min(fabsf(v_V.q), KEEP_SHARE * base_min(fabsf(hold_q_V), v_max_V));
    const float room2_V2 = max2_V2 - (keep_V * keep_V);
    dq_t        out_V;

    if (d2_V2 <= room2_V2) {
        const float q_V = sqrtf(max2_V2 - d2_V2);
        out_V.d         = v_V.d;
        out_V.q         = base_clamp(v_V.q, -q_V, q_V);
    } else {
        const float d_V = sqrtf(room2_V2);
        out_V.d         = base_clamp(v_V.d, -d_V, d_V);
        out_V.q         = base_clamp(v_V.q, -keep_V, keep_V); /* the root of max^2 - d^2 */
    }
    return out_V;
}
