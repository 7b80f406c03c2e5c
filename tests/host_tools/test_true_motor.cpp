// SPDX-License-Identifier: MIT
/// The linearised motor of the certificate against differences of the motor's equations in closed form.
#include "design/true_motor.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "design/design.hpp"
#include "iron.hpp"

namespace {

using sdre::Motor;
using sdre::OperatingPoint;
using support::Iron;

/// d/dt of (w, psi_q, psi_d).
std::array<double, 3> rates(const Motor &m, const Iron &iron, const std::array<double, 3> &w_iq_id,
                            double v_q, double v_d)
{
    const auto [w, q, d] = w_iq_id;
    const double np      = m.pole_pairs;
    const double torque  = 1.5 * np * (iron.psi_d(d, q) * q - iron.psi_q(d, q) * d);
    return {np / m.inertia_kgm2 * torque - m.viscous_friction_Nms / m.inertia_kgm2 * w,
            v_q - m.stator_resistance_Ohm * q - w * iron.psi_d(d, q),
            v_d - m.stator_resistance_Ohm * d + w * iron.psi_q(d, q)};
}

/// Rates of (w, iq, id) by the inverse of differenced inductances.
Eigen::Vector3d current_rates(const Motor &m, const Iron &iron, const std::array<double, 3> &x,
                              const Eigen::Matrix2d &inductance, double v_q, double v_d)
{
    const auto            r = rates(m, iron, x, v_q, v_d);
    const Eigen::Vector2d i = inductance.inverse() * Eigen::Vector2d(r[1], r[2]);
    return {r[0], i(0), i(1)};
}

/// d(psi_q, psi_d) / d(iq, id)
Eigen::Matrix2d inductances(const Iron &iron, double q, double d)
{
    constexpr double h = 1e-6;
    Eigen::Matrix2d  M;
    M << iron.psi_q(d, q + h) - iron.psi_q(d, q - h), iron.psi_q(d + h, q) - iron.psi_q(d - h, q),
        iron.psi_d(d, q + h) - iron.psi_d(d, q - h), iron.psi_d(d + h, q) - iron.psi_d(d - h, q);
    return M / (2.0 * h);
}

} // namespace

TEST(TrueMotor, JacobianIsThatOfTheFluxEquations)
{
    const Iron           iron;
    const sdre::Drive    drive = support::saturated_drive(iron);
    const Motor         &m     = drive.motor;
    const auto           motor = sdre::true_motor(drive, m);
    const OperatingPoint at{400.0, 2.2, -1.1};
    const auto           M = inductances(iron, at.iq_A, at.id_A);
    // At a steady state the derivative of M^-1 does not count: the voltage holds the fluxes.
    const auto   held = rates(m, iron, {at.omega_e_radps, at.iq_A, at.id_A}, 0.0, 0.0);
    const double v_q  = -held[1];
    const double v_d  = -held[2];
    EXPECT_NEAR(motor.voltage_V(at)(0), v_q, 0.05);
    EXPECT_NEAR(motor.voltage_V(at)(1), v_d, 0.05);
    EXPECT_NEAR(motor.acceleration(at), held[0] + m.viscous_friction_Nms / m.inertia_kgm2 * 400.0,
                1e-3 * held[0]);

    constexpr double h = 1e-5;
    const auto       J = motor.jacobian(at);
    for (std::size_t k = 0; k < 3; k++) {
        std::array<double, 3> more{at.omega_e_radps, at.iq_A, at.id_A};
        std::array<double, 3> less = more;
        more[k] += h;
        less[k] -= h;
        const Eigen::Vector3d expected = (current_rates(m, iron, more, M, v_q, v_d) -
                                          current_rates(m, iron, less, M, v_q, v_d)) /
                                         (2.0 * h);
        for (Eigen::Index row = 0; row < 3; row++) {
            const auto column = static_cast<Eigen::Index>(k);
            EXPECT_NEAR(J(row, column), expected(row), 3e-3 * expected.cwiseAbs().maxCoeff())
                << row << " " << k;
        }
    }
    const Eigen::Matrix2d B = M.inverse(); // (iq, id) per (v_q, v_d)
    EXPECT_TRUE(motor.input(at).bottomRows(2).isApprox(B, 2e-3)) << motor.input(at);
    EXPECT_TRUE(motor.input(at).row(0).isZero(0.0));
}

TEST(TrueMotor, MapOfConstantInductancesIsTheReducedMotor)
{
    Iron linear;
    linear.b                    = 0.0;
    const sdre::Drive     drive = support::saturated_drive(linear);
    const OperatingPoint  at{-250.0, 3.1, -0.7};
    const auto            l      = sdre::reduced_parameters(drive.motor);
    const auto            mapped = sdre::true_motor(drive, drive.motor);
    const sdre::TrueMotor plain(l);
    EXPECT_TRUE(mapped.jacobian(at).isApprox(plain.jacobian(at), 1e-9));
    EXPECT_TRUE(mapped.input(at).isApprox(plain.input(at), 1e-9));
    EXPECT_TRUE(mapped.voltage_V(at).isApprox(plain.voltage_V(at), 1e-9));
    EXPECT_NEAR(mapped.acceleration(at), plain.acceleration(at), 1e-6);
    Motor other = drive.motor;
    other.q_axis_inductance_H *= 0.6;
    other.pm_flux_Wb *= 1.2;
    const sdre::TrueMotor theirs(sdre::reduced_parameters(other));
    EXPECT_TRUE(sdre::true_motor(drive, other).jacobian(at).isApprox(theirs.jacobian(at), 1e-9));
}

/// The controller believes constants; the motor that loses most of its inductance with the current does not settle with them.
TEST(TrueMotor, CertificateRefusesAMachineThatSaturatesTooMuch)
{
    Iron mild;
    mild.b = 0.05;
    EXPECT_TRUE(sdre::design_drive(support::saturated_drive(mild)).certificate.passed());
    Iron hard;
    hard.lq_H       = 0.11391;
    hard.b          = 0.3;
    sdre::Drive bad = support::saturated_drive(hard);
    bad.motor.q_axis_inductance_H *= 2.5; // believed, not the map
    bad.saturation    = support::saturated_drive(hard).saturation;
    const auto design = sdre::design_drive(bad);
    ASSERT_FALSE(design.certificate.passed());
}
