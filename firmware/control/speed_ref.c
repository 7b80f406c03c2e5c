/* SPDX-License-Identifier: MIT */
#include "speed_ref.h"

#include <math.h>

void speed_ref_reset(speed_ref_t *r, float omega_e_radps)
{
    r->omega_e_radps         = omega_e_radps;
    r->omega_dot_e_radps2    = 0.0f;
    r->omega_2dot_e_radps3   = 0.0f;
    r->accel_wanted_e_radps2 = 0.0f;
}

/* EQ-SPEED-REF-1 with the sign of the distance. */
static float stopping_acceleration(float distance, float jerk_step, float steps_per_radps)
{
    const float steps = fabsf(distance) * steps_per_radps;
    const float accel = (steps > 1.0f)
                            ? (0.5f * jerk_step * (sqrtf(1.0f + (8.0f * steps)) - 1.0f))
                            : (steps * jerk_step); /* the last step lands on the command */
    return (distance < 0.0f) ? -accel : accel;
}

void speed_ref_update(speed_ref_t *r, const speed_ref_limits_t *limits, float command_e_radps,
                      float omega_e_radps, float ts_s)
{
    const float jerk_step       = limits->jerk_e_radps3 * ts_s;
    const float steps_per_radps = 1.0f / (jerk_step * ts_s); /* 1 / (j Ts^2) */
    const float before          = r->omega_dot_e_radps2;
    const float wanted =
        stopping_acceleration(command_e_radps - r->omega_e_radps, jerk_step, steps_per_radps);
    const float allowed = base_clamp(wanted, limits->accel_lo_e_radps2, limits->accel_hi_e_radps2);
    const float accel   = base_clamp(allowed, before - jerk_step, before + jerk_step);

    r->accel_wanted_e_radps2 = wanted;
    r->omega_2dot_e_radps3 =
        (accel - before) * (jerk_step * steps_per_radps); /* EQ-SPEED-REF-2: over Ts */
    r->omega_dot_e_radps2 = accel;
    r->omega_e_radps =
        base_clamp(r->omega_e_radps + (ts_s * accel), omega_e_radps - limits->near_e_radps,
                   omega_e_radps + limits->near_e_radps);
}
