/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include <math.h>

#include "feedforward.h"
#include "svpwm.h"

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

static voltage_t in_hexagon(const drive_config_t *c, const law_output_t *wanted, float length_V,
                            frames_angle_t angle, float dc_link_V)
{
    const float share = svpwm_share(frames_inverse_park(wanted->v_V, angle), dc_link_V);
    voltage_t   out   = {.v_V = wanted->v_V, .limited = share < 1.0f};

    if (out.limited) {
        const float hold_q_V = feedforward_hold_q_V(&c->motor, &wanted->now, wanted->d_q);
        const dq_t  v_V      = voltage_limit(wanted->v_V, hold_q_V, share * length_V);
        const float cut      = svpwm_share(frames_inverse_park(v_V, angle), dc_link_V);

        out.v_V.d = cut * v_V.d;
        out.v_V.q = cut * v_V.q;
    }
    return out;
}

static voltage_t in_circle(const drive_config_t *c, const law_output_t *wanted, float circle_V)
{
    const float     hold_q_V = feedforward_hold_q_V(&c->motor, &wanted->now, wanted->d_q);
    const voltage_t out = {.v_V = voltage_limit(wanted->v_V, hold_q_V, circle_V), .limited = true};
    return out;
}

voltage_t voltage_produce(const drive_config_t *c, const law_output_t *wanted, frames_angle_t angle,
                          float dc_link_V)
{
    const dq_t      u_V      = wanted->v_V;
    const float     circle_V = dc_link_V * BASE_1_SQRT3;
    const float     square   = (u_V.d * u_V.d) + (u_V.q * u_V.q);
    const voltage_t as_it_is = {.v_V = u_V, .limited = false};

    if (square <= circle_V * circle_V) {
        return as_it_is;
    }
    return c->overmodulation ? in_hexagon(c, wanted, sqrtf(square), angle, dc_link_V)
                             : in_circle(c, wanted, circle_V);
}
