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

/* EQ-SPEED-REF-1 with the sign of the distance; jerk_step = j Ts. */
static float stopping_acceleration(float distance, float jerk_step, float samples_1ps)
{
    const float at_once = fabsf(distance) * samples_1ps;
    const float half    = 0.5f * jerk_step;
    const float accel   = (at_once > jerk_step)
                              ? (sqrtf((half * half) + (2.0f * jerk_step * at_once)) - half)
                              : at_once; /* the last step lands on the command */
    return (distance < 0.0f) ? -accel : accel;
}

void speed_ref_update(speed_ref_t *r, const speed_ref_limits_t *limits, float command_e_radps,
                      float omega_e_radps, float ts_s)
{
    const float up_step   = limits->jerk_up_e_radps3 * ts_s;
    const float down_step = limits->jerk_down_e_radps3 * ts_s;
    const float before    = r->omega_dot_e_radps2;
    const float distance  = command_e_radps - r->omega_e_radps;
    const float wanted    = stopping_acceleration(distance, (distance > 0.0f) ? down_step : up_step,
                                                  limits->samples_1ps);
    const float allowed = base_clamp(wanted, limits->accel_lo_e_radps2, limits->accel_hi_e_radps2);
    const float accel   = base_clamp(allowed, before - down_step, before + up_step);

    r->accel_wanted_e_radps2 = wanted;
    r->omega_2dot_e_radps3   = (accel - before) * limits->samples_1ps; /* EQ-SPEED-REF-2: over Ts */
    r->omega_dot_e_radps2    = accel;
    r->omega_e_radps =
        base_clamp(r->omega_e_radps + (ts_s * accel), omega_e_radps - limits->near_e_radps,
                   omega_e_radps + limits->near_e_radps);
}
