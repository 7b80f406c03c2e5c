/* SPDX-License-Identifier: MIT */
#include "speed_ref.h"

void speed_ref_reset(speed_ref_t *r, float omega_e_radps)
{
    r->omega_e_radps      = omega_e_radps;
    r->omega_dot_e_radps2 = 0.0f;
}

void speed_ref_update(speed_ref_t *r, float command_e_radps, float accel_max_e_radps2, float ts_s)
{
    const float step_max = accel_max_e_radps2 * ts_s;
    const float distance = command_e_radps - r->omega_e_radps;

    if (base_in_range(distance, -step_max, step_max)) {
        r->omega_dot_e_radps2 = 0.0f;
        r->omega_e_radps      = command_e_radps;
    } else {
        r->omega_dot_e_radps2 = (distance > 0.0f) ? accel_max_e_radps2 : -accel_max_e_radps2;
        r->omega_e_radps += ts_s * r->omega_dot_e_radps2; /* EQ-SPEED-REF-1 */
    }
}
