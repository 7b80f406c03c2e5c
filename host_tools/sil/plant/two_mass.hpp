// SPDX-License-Identifier: MIT
/// A load at the other end of an elastic shaft.
///
///     T_s = K phi + D (w_m - w_l),   phi' = w_m - w_l                          EQ-EFFECTS-4
///     J_m w_m' = T - B w_m - T_s,    J_l w_l' = T_s - T_load
///
/// w_m is the motor's, with the encoder; J_l is a share of the inertia of both.
#pragma once

#include "sil/plant/rk4.hpp"

namespace sdre {

struct TwoMassState : MotorState {
    double twist_rad    = 0.0; ///< motor ahead of load
    double omega_load_m = 0.0;
};

/// x + f rate
inline TwoMassState along(const TwoMassState &x, const TwoMassState &rate, double f)
{
    const MotorState &motor = x;
    return {along(motor, static_cast<const MotorState &>(rate), f),
            x.twist_rad + f * rate.twist_rad, x.omega_load_m + f * rate.omega_load_m};
}

inline TwoMassState rk4_sum(const TwoMassState &k1, const TwoMassState &k2, const TwoMassState &k3,
                            const TwoMassState &k4, double f)
{
    const MotorState &m1 = k1;
    const MotorState &m2 = k2;
    const MotorState &m3 = k3;
    const MotorState &m4 = k4;
    return {rk4_sum(m1, m2, m3, m4, f),
            f * (k1.twist_rad + 2.0 * (k2.twist_rad + k3.twist_rad) + k4.twist_rad),
            f * (k1.omega_load_m + 2.0 * (k2.omega_load_m + k3.omega_load_m) + k4.omega_load_m)};
}

} // namespace sdre
