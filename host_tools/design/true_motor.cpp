// SPDX-License-Identifier: MIT
#include "design/true_motor.hpp"

namespace sdre {

using Eigen::MatrixXd;

Eigen::Matrix3d motor_jacobian(const ReducedParameters &l, const OperatingPoint &at)
{
    Eigen::Matrix3d J;
    J << -l[2], l[1] + l[11] * at.id_A, l[11] * at.iq_A,           //
        -l[5] - l[10] * at.id_A, -l[4], -l[10] * at.omega_e_radps, //
        l[9] * at.iq_A, l[9] * at.omega_e_radps, -l[7];
    return J;
}

TrueMotor::TrueMotor(const ReducedParameters &l) : l_(l) {}

TrueMotor::TrueMotor(const Motor &motor, const SaturatedMotor &iron)
    : l_(reduced_parameters(motor)), iron_(iron), resistance_Ohm_(motor.stator_resistance_Ohm),
      per_torque_(1.5 * motor.pole_pairs * motor.pole_pairs / motor.inertia_kgm2)
{
}

Eigen::Matrix3d TrueMotor::jacobian(const OperatingPoint &at) const
{
    if (!iron_) {
        return motor_jacobian(l_, at);
    }
    const double w = at.omega_e_radps;
    const FluxAt f = iron_->at(at.id_A, at.iq_A);

    Eigen::Matrix3d J;
    J.row(0) << -l_[2], per_torque_ * (f.d_Wb + f.dq_H * at.iq_A - f.qq_H * at.id_A),
        per_torque_ * (f.dd_H * at.iq_A - f.q_Wb - f.qd_H * at.id_A);
    // Rates of psi_d and psi_q over w, i_q, i_d; then those of the currents.
    const Eigen::Vector3d d(f.q_Wb, w * f.qq_H, w * f.qd_H - resistance_Ohm_);
    const Eigen::Vector3d q(-f.d_Wb, -w * f.dq_H - resistance_Ohm_, -w * f.dd_H);
    for (Eigen::Index k = 0; k < 3; k++) {
        const auto rate = by_inductance(f, d(k), q(k));
        J(1, k)         = rate[1];
        J(2, k)         = rate[0];
    }
    return J;
}

MatrixXd TrueMotor::input(const OperatingPoint &at) const
{
    if (!iron_) {
        return nosc_input_matrix(l_);
    }
    const FluxAt f   = iron_->at(at.id_A, at.iq_A);
    const auto   v_q = by_inductance(f, 0.0, 1.0);
    const auto   v_d = by_inductance(f, 1.0, 0.0);
    MatrixXd     B   = MatrixXd::Zero(3, 2);
    B.row(1) << v_q[1], v_d[1];
    B.row(2) << v_q[0], v_d[0];
    return B;
}

Eigen::Vector2d TrueMotor::voltage_V(const OperatingPoint &at) const
{
    const double w = at.omega_e_radps;
    if (!iron_) {
        return {(l_[4] * at.iq_A + l_[5] * w + l_[10] * w * at.id_A) / l_[6],
                (l_[7] * at.id_A - l_[9] * w * at.iq_A) / l_[8]};
    }
    const FluxAt f = iron_->at(at.id_A, at.iq_A);
    return {resistance_Ohm_ * at.iq_A + w * f.d_Wb, resistance_Ohm_ * at.id_A - w * f.q_Wb};
}

double TrueMotor::acceleration(const OperatingPoint &at) const
{
    if (!iron_) {
        return (l_[1] + l_[11] * at.id_A) * at.iq_A;
    }
    const FluxAt f = iron_->at(at.id_A, at.iq_A);
    return per_torque_ * (f.d_Wb * at.iq_A - f.q_Wb * at.id_A);
}

TrueMotor true_motor(const Drive &drive, const Motor &now)
{
    if (!drive.saturation) {
        return reduced_parameters(now);
    }
    return {now, saturated_motor(drive, now)};
}

Held<MatrixXd> held_motor(const TrueMotor &motor, const OperatingPoint &at, double ts)
{
    MatrixXd A          = MatrixXd::Zero(4, 4);
    MatrixXd B          = MatrixXd::Zero(4, 3);
    A.block(0, 0, 3, 3) = motor.jacobian(at);
    A(3, 0)             = 1.0;
    B.block(0, 0, 3, 2) = motor.input(at);
    B(0, 2)             = motor.load();
    return c2d(A, B, ts);
}

} // namespace sdre
