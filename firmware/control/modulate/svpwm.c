/* SPDX-License-Identifier: MIT */
#include "svpwm.h"

#include "fpu.h"
#include "frames.h"

/* Three phase voltages, their middle and the distance of the outer two. */
typedef struct {
    abc_t v_V;
    float centre_V;
    float spread_V;
} phases_t;

static phases_t phases_of(ab_t v_V)
{
    const abc_t    v       = frames_inverse_clarke(v_V);
    const float    largest = base_max(v.a, base_max(v.b, v.c));
    const float    least   = base_min(v.a, base_min(v.b, v.c));
    const phases_t phases  = {
         .v_V = v, .centre_V = 0.5f * (largest + least), .spread_V = largest - least};
    return phases;
}

static abc_t duty_of(const phases_t *p, float inv_V)
{
    const abc_t duty = {/* EQ-SVPWM-1 */
                        .a = 0.5f + ((p->v_V.a - p->centre_V) * inv_V),
                        .b = 0.5f + ((p->v_V.b - p->centre_V) * inv_V),
                        .c = 0.5f + ((p->v_V.c - p->centre_V) * inv_V)};
    return duty;
}

CTL_PART abc_t svpwm_duty(ab_t v_V, float v_dc_V)
{
    const phases_t phases = phases_of(v_V);

    return duty_of(&phases, fpu_inverse(v_dc_V));
}

CTL_PART svpwm_t svpwm_within(ab_t v_V, float v_dc_V)
{
    const phases_t phases  = phases_of(v_V);
    const bool     outside = phases.spread_V > v_dc_V;
    const float    inv_V   = fpu_inverse(outside ? phases.spread_V : v_dc_V);

    const svpwm_t out = {.duty  = duty_of(&phases, inv_V),
                         .share = outside ? (v_dc_V * inv_V) : 1.0f}; /* EQ-SVPWM-2 */
    return out;
}
