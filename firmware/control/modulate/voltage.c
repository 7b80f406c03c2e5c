/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include "fpu.h"
#include "svpwm.h"

CTL_PART voltage_t voltage_produce(dq_t u_V, frames_angle_t angle, float dc_link_V,
                                   bool overmodulation)
{
    const bool  round = !overmodulation && voltage_is_outside(u_V, dc_link_V);
    const float circle =
        round ? (dc_link_V * BASE_1_SQRT3 * fpu_inverse_root(voltage_square(u_V))) : 1.0f;
    const dq_t within_V = {.d = circle * u_V.d, .q = circle * u_V.q};

    const svpwm_t   pwm   = svpwm_within(frames_inverse_park(within_V, angle), dc_link_V);
    const float     share = overmodulation ? pwm.share : 1.0f;
    const voltage_t out   = {.v_V     = {.d = share * within_V.d, .q = share * within_V.q},
                             .duty    = pwm.duty,
                             .limited = round || (share < 1.0f)}; /* EQ-VOLTAGE-1 */
    return out;
}
