/* SPDX-License-Identifier: MIT */
#include "speed_ref.h"

void speed_ref_reset(speed_ref_t *r, float omega_e_radps)
{
    r->omega_e_radps         = omega_e_radps;
    r->omega_dot_e_radps2    = 0.0f;
    r->omega_2dot_e_radps3   = 0.0f;
    r->accel_wanted_e_radps2 = 0.0f;
}
