// SPDX-License-Identifier: MIT
#include "design/torque_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include "design/sampled_model.hpp"

namespace sdre {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double step_s     = 2e-6; // chosen: the bound has an error of half of it
constexpr double most_s     = 0.1;
constexpr int    directions = 720; // chosen: half a degree each, 2e-5 of the torque

/// A point of the edge, and what its direction has become by now.
struct EdgePoint {
    Vector2d direction; // Phi(t)' c
    Vector2d forced_A;  // by the voltage
};

Vector2d mtpa_dq_A(const Motor &motor, const ReducedParameters &l, double torque_Nm)
{
    const double iq_A = mtpa_iq_A(motor, l, std::abs(torque_Nm), motor.max_current_A);
    return {mtpa_id_A(l, iq_A), std::copysign(iq_A, torque_Nm)};
}

} // namespace

double least_torque_time_s(const Motor &m, const ReducedParameters &l, const TorqueStep &s)
{
    const double R  = m.stator_resistance_Ohm;
    const double Ld = m.d_axis_inductance_H;
    const double Lq = m.q_axis_inductance_H;
    const double w  = s.speed_e_radps;
    Matrix2d     A;
    A << -R / Ld, w * Lq / Ld, -w * Ld / Lq, -R / Lq;
    const Vector2d emf(0.0, -w * m.pm_flux_Wb / Lq);
    const Vector2d per_V(s.voltage_V / Ld, s.voltage_V / Lq);
    const Matrix2d Phi  = (A * step_s).exp();
    const double   aim  = s.from_Nm + s.share * (s.to_Nm - s.from_Nm);
    const double   sign = s.to_Nm < s.from_Nm ? -1.0 : 1.0;

    std::vector<EdgePoint> edge;
    for (int k = 0; k < directions; k++) {
        const double angle = 2.0 * std::acos(-1.0) * k / directions;
        edge.push_back({{std::cos(angle), std::sin(angle)}, Vector2d::Zero()});
    }
    Vector2d free_A  = mtpa_dq_A(m, l, s.from_Nm);
    Matrix2d Phi_now = Matrix2d::Identity();
    for (double t = step_s; t < most_s; t += step_s) {
        free_A = Phi * free_A + step_s * emf;
        for (auto &[direction, forced_A] : edge) {
            const Vector2d along = per_V.cwiseProduct(direction);
            forced_A += step_s * (Phi_now * per_V.cwiseProduct(along / along.norm()));
            direction          = Phi.transpose() * direction;
            const Vector2d i_A = free_A + forced_A;
            if (sign * (torque_Nm(m, i_A(0), i_A(1)) - aim) >= 0.0) {
                return t;
            }
        }
        Phi_now = Phi_now * Phi;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double least_torque_time_s(const Drive &d, double speed_e_radps, double from_Nm, double to_Nm)
{
    constexpr double corner = 2.0 / 3.0; // of the dc link
    return least_torque_time_s(d.motor, reduced_parameters(d.motor),
                               {speed_e_radps, from_Nm, to_Nm, corner * d.inverter.dc_link_V, 0.9});
}

} // namespace sdre
