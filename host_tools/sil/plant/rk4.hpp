// SPDX-License-Identifier: MIT
/// One step of the classical Runge-Kutta method.
#pragma once

#include "sil/plant/motor_equations.hpp"

namespace sdre {

/// Sum of the rates at the four points.
inline MotorState rk4_sum(const MotorState &k1, const MotorState &k2, const MotorState &k3,
                          const MotorState &k4, double f)
{
    return {f * (k1.psi_d + 2.0 * (k2.psi_d + k3.psi_d) + k4.psi_d),
            f * (k1.psi_q + 2.0 * (k2.psi_q + k3.psi_q) + k4.psi_q),
            f * (k1.omega_m + 2.0 * (k2.omega_m + k3.omega_m) + k4.omega_m),
            f * (k1.theta_e + 2.0 * (k2.theta_e + k3.theta_e) + k4.theta_e)};
}

/// Change of the state in a step of h seconds. rate(x, turned_rad) is the derivative at a state
/// whose angle is turned_rad beyond the start.
template <typename State, typename Rate> State rk4_gain(const State &x, double h, const Rate &rate)
{
    const double half = 0.5 * h;
    const State  k1   = rate(x, 0.0);
    const State  k2   = rate(along(x, k1, half), half * k1.theta_e);
    const State  k3   = rate(along(x, k2, half), half * k2.theta_e);
    const State  k4   = rate(along(x, k3, h), h * k3.theta_e);
    return rk4_sum(k1, k2, k3, k4, h / 6.0);
}

} // namespace sdre
