/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include <math.h>

#include "svpwm.h"

voltage_t voltage_produce(dq_t u_V, frames_angle_t angle, float dc_link_V, bool overmodulation)
{
    voltage_t out = {.v_V = u_V, .limited = false};

    if (voltage_is_outside(u_V, dc_link_V)) { /* EQ-VOLTAGE-1 */
        const float share = overmodulation
                                ? svpwm_share(frames_inverse_park(u_V, angle), dc_link_V)
                                : (dc_link_V * BASE_1_SQRT3 / sqrtf(voltage_square(u_V)));
        out.v_V.d         = share * u_V.d;
        out.v_V.q         = share * u_V.q;
        out.limited       = share < 1.0f;
    }
    return out;
}
