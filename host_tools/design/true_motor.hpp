// SPDX-License-Identifier: MIT
/// The motor as it is, which may differ from the controller's model. It has constant inductances or a map of its iron.
///
/// With a map, in (w, i_q, i_d) and with the incremental inductances M = d(psi_d, psi_q) / d(i_d, i_q) of the point:
///
///     (i_d', i_q') = M^-1 (v - R i + w (psi_q, -psi_d)),  w' = n_p / J 1.5 n_p (psi_d i_q - psi_q i_d) - ..   EQ-CERT-8
#pragma once

#include <optional>

#include "design/motor_model.hpp"
#include "drive/flux_map.hpp"
#include "linalg/c2d.hpp"

namespace sdre {

/// Where a motor is linearised.
struct OperatingPoint {
    double omega_e_radps = 0.0;
    double iq_A          = 0.0;
    double id_A          = 0.0;
};

/// Jacobian of EQ-MOTOR-2 in (w, iq, id), 3 x 3.
Eigen::Matrix3d motor_jacobian(const ReducedParameters &l, const OperatingPoint &at);

class TrueMotor {
public:
    /// With constant inductances. Implicit: most motors are such.
    TrueMotor(const ReducedParameters &l); // NOLINT(google-explicit-constructor)
    TrueMotor(const Motor &motor, const SaturatedMotor &iron);

    /// Jacobian in (w, iq, id).
    Eigen::Matrix3d jacobian(const OperatingPoint &at) const;
    /// 3 x 2: v_q, v_d.
    Eigen::MatrixXd input(const OperatingPoint &at) const;
    /// The rate of w per newton metre of load.
    double load() const
    {
        return -l_[3];
    }
    /// v_q, v_d that hold a point.
    Eigen::Vector2d voltage_V(const OperatingPoint &at) const;
    /// The currents' torque accelerates w by this much [rad/s2].
    double acceleration(const OperatingPoint &at) const;

private:
    ReducedParameters             l_;
    std::optional<SaturatedMotor> iron_;
    double                        resistance_Ohm_ = 0.0;
    double                        per_torque_     = 0.0; ///< 1.5 n_p^2 / J
};

/// The motor of a drive with values of [motor] scaled as in `now`, with the map of its iron if the drive has one.
TrueMotor true_motor(const Drive &drive, const Motor &now);

/// The motor (w, iq, id, theta) over one period with v_q, v_d and T_load held.
Held<Eigen::MatrixXd> held_motor(const TrueMotor &motor, const OperatingPoint &at, double ts_s);

} // namespace sdre
