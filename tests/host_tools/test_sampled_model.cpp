// SPDX-License-Identifier: MIT
#include "design/sampled_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "common/random.hpp"
#include "design/design.hpp"
#include "design/id_reference.hpp"
#include "linalg/expm.hpp"
#include "linear.hpp"
#include "load_response.hpp"
#include "shipped_drive.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double pi = 3.14159265358979323846;

const sdre::Design &board()
{
    static const sdre::Design design =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w")));
    return design;
}

/// The gains that the firmware uses in a steady state with this q current.
sdre::LoopGains gains_at(const sdre::Design &d, double iq_A)
{
    const double held =
        std::clamp(iq_A, -d.certificate.nodo.series_range_A, d.certificate.nodo.series_range_A);
    MatrixXd L = MatrixXd::Zero(7, 3);
    for (std::size_t n = 0; n < d.nodo.gain.size(); n++) {
        L += std::pow(held, static_cast<double>(n)) * d.nodo.gain[n];
    }
    return {d.nosc.gain[0], L};
}

sdre::IdReference references_of(const sdre::Design &d)
{
    const auto &c = *static_cast<const law_noc_config_t *>(d.config.constants);
    return sdre::id_reference(d, c.near_optimal.current_ref);
}

/// Largest distance of an eigenvalue of one set to the nearest one of the other set, both ways.
double distance(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b)
{
    double worst = 0.0;
    for (const auto &x : a) {
        worst = std::max(worst, (b.array() - x).abs().minCoeff());
    }
    for (const auto &x : b) {
        worst = std::max(worst, (a.array() - x).abs().minCoeff());
    }
    return worst;
}

/// The eigenvalues of the law on the motor itself and of the estimation error, from the motor's Jacobian
/// alone: what the separation principle predicts.
Eigen::VectorXcd separate_loops(const sdre::Design &d, const sdre::LoopGains &gains,
                                const sdre::OperatingPoint &at, double ts)
{
    const auto           &l = d.l;
    const Eigen::Matrix3d J = sdre::motor_jacobian(l, at);
    const MatrixXd        B = sdre::nosc_input_matrix(l);

    const double D = l[1] + l[11] * at.id_A; // iq_ref = -d_w^ / D, with id^ from the estimate
    MatrixXd     F = -gains.Lambda;
    F(0, 0) += l[10] * at.id_A / l[6];
    F(0, 2) +=
        l[10] * at.omega_e_radps / l[6] - (gains.Lambda(0, 1) + l[4] / l[6]) * at.iq_A * l[11] / D;
    F(1, 0) -= l[9] * at.iq_A / l[8];
    F(1, 1) -= l[9] * at.omega_e_radps / l[8];
    MatrixXd M             = MatrixXd::Zero(5, 5);
    M.topLeftCorner(3, 3)  = J * ts;
    M.topRightCorner(3, 2) = B * ts;
    const MatrixXd held    = sdre::exponential(M);
    const MatrixXd law     = held.topLeftCorner(3, 3) + held.topRightCorner(3, 2) * F;

    MatrixXd A          = MatrixXd::Zero(7, 7);
    A.block(3, 0, 3, 3) = MatrixXd::Identity(3, 3);
    A.block(3, 3, 3, 3) = J;
    A(6, 3)             = 1.0;
    MatrixXd C          = MatrixXd::Zero(3, 7);
    C(0, 4) = C(1, 5) = C(2, 6) = 1.0;
    const MatrixXd I            = MatrixXd::Identity(7, 7);
    const MatrixXd error        = (I + ts * A + 0.5 * ts * ts * A * A) * (I - ts * gains.L * C);

    Eigen::VectorXcd all(10);
    all << sdre::eigenvalues(law), sdre::eigenvalues(error);
    return all;
}

} // namespace

TEST(SampledModel, JacobianIsTheDerivativeOfTheMotor)
{
    const sdre::Motor &m = board().drive.motor;
    const auto         f = [&](const Eigen::Vector3d &x) { // paper A (1) at no voltage
        const double psi_d = m.d_axis_inductance_H * x(2) + m.pm_flux_Wb;
        const double psi_q = m.q_axis_inductance_H * x(1);
        const double np    = m.pole_pairs;
        const double T     = 1.5 * np * (psi_d * x(1) - psi_q * x(2));
        return Eigen::Vector3d(
                    (np * T - m.viscous_friction_Nms * x(0)) / m.inertia_kgm2,
                    (-m.stator_resistance_Ohm * x(1) - x(0) * psi_d) / m.q_axis_inductance_H,
                    (-m.stator_resistance_Ohm * x(2) + x(0) * psi_q) / m.d_axis_inductance_H);
    };
    const Eigen::Vector3d at(310.0, 2.1, -0.7);
    const Eigen::Matrix3d J = sdre::motor_jacobian(board().l, {at(0), at(1), at(2)});

    for (int j = 0; j < 3; j++) {
        const double          h = 1e-3; // the motor is quadratic: central differences are exact
        const Eigen::Vector3d e = Eigen::Vector3d::Unit(j) * h;
        EXPECT_LT(((f(at + e) - f(at - e)) / (2.0 * h) - J.col(j)).norm(), 1e-6 * J.norm()) << j;
    }
}

TEST(SampledModel, EigenvaluesAreThoseOfLawAndObserver)
{
    // The motor is sampled exactly but predicted to second order, so separation holds up to the third.
    // Clustered eigenvalues magnify that; their polynomial on the unit circle does not.
    for (const sdre::OperatingPoint at :
         {sdre::OperatingPoint{0.0, 0.0, 0.0}, {300.0, 1.9, -0.4}, {523.0, -2.5, -0.6}}) {
        const sdre::LoopGains gains = gains_at(board(), at.iq_A);
        for (const auto &[ts, tolerance] : {std::pair{200e-6, 0.05}, std::pair{20e-6, 0.005}}) {
            const MatrixXd A = sdre::sampled_model(board().l, board().l, gains, at, ts).A;
            ASSERT_EQ(A.rows(), 10);
            const Eigen::VectorXcd whole    = sdre::eigenvalues(A);
            const Eigen::VectorXcd separate = separate_loops(board(), gains, at, ts);
            for (int i = 0; i < 16; i++) {
                const std::complex<double> z = std::polar(1.0, 2.0 * pi * (i + 0.5) / 16.0);
                const std::complex<double> ratio =
                    ((z - whole.array()) / (z - separate.array())).prod();
                EXPECT_LT(std::abs(ratio - 1.0), tolerance) << at.omega_e_radps << " " << i;
            }
        }
        const MatrixXd A = sdre::sampled_model(board().l, board().l, gains, at, 20e-6).A;
        EXPECT_LT(distance(sdre::eigenvalues(A), separate_loops(board(), gains, at, 20e-6)), 1e-4);
    }
}

TEST(SampledModel, SmallLoadStepIsThatOfTheNonlinearLoop)
{
    constexpr double step_Nm = 0.05;
    for (const double omega : {100.0, 300.0}) {
        const support::StepResponse found =
            support::nonlinear_step(board(), omega, 0.75, step_Nm, 0.3);
        const sdre::SampledModel model =
            sdre::sampled_model(board().l, board().l, gains_at(board(), found.before.iq_A),
                                found.before, sdre::control_period_s(board().drive));
        const std::vector<double> expected = support::linear_step(model, step_Nm);

        EXPECT_FALSE(found.limited);
        EXPECT_NEAR(found.before.omega_e_radps, omega, 0.01);
        const double dip =
            -*std::min_element(found.deviation_e_radps.begin(), found.deviation_e_radps.end());
        const double expected_dip = -*std::min_element(expected.begin(), expected.end());
        EXPECT_GT(expected_dip, 0.0);
        EXPECT_NEAR(dip / expected_dip, 1.0, 0.15) << omega;
        for (std::size_t k = 0; k < expected.size(); k++) {
            EXPECT_NEAR(found.deviation_e_radps[k], expected[k], 0.15 * expected_dip)
                << omega << " period " << k;
        }
    }
}

/// EQ-CERT-6: in flux weakening id_ref moves with the estimates. With a reference that stands still the answer is another one.
TEST(SampledModel, SmallLoadStepInFluxWeakeningMovesTheReference)
{
    constexpr double        step_Nm = 0.02;
    const sdre::Design     &d       = board();
    const sdre::IdReference id      = references_of(d);
    for (const auto &[omega, load_Nm] : {std::pair{500.0, 2.0}, {744.0, 1.3}, {1000.0, 0.8}}) {
        const support::StepResponse found =
            support::nonlinear_step(d, omega, load_Nm, step_Nm, 0.3);
        EXPECT_FALSE(found.limited);
        const sdre::SteadyState s = sdre::steady_state(id, d.l, d.l, omega, found.before.iq_A);
        EXPECT_NEAR(s.at.id_A, found.before.id_A, 1.5e-2) << omega; // a held voltage turns
        EXPECT_LT(s.at.id_A, sdre::mtpa_id_A(d.l, s.at.iq_A) - 0.1) << omega;

        const sdre::LoopGains       gains  = gains_at(d, s.at.iq_A);
        const sdre::MovingReference moving = sdre::moving_reference(id, d.l, gains.Lambda, s);
        const double                ts     = sdre::control_period_s(d.drive);
        const auto                  expected =
            support::linear_step(sdre::sampled_model(d.l, d.l, gains, s.at, ts, &moving), step_Nm);
        const auto frozen =
            support::linear_step(sdre::sampled_model(d.l, d.l, gains, s.at, ts), step_Nm);
        const double dip   = -*std::min_element(expected.begin(), expected.end());
        double       other = 0.0;
        for (std::size_t k = 0; k < expected.size(); k++) {
            EXPECT_NEAR(found.deviation_e_radps[k], expected[k], 0.08 * dip) << omega << " " << k;
            other = std::max(other, std::abs(found.deviation_e_radps[k] - frozen[k]));
        }
        EXPECT_GT(other, 0.09 * dip) << omega; // more than both answers differ by
    }
}

/// Rated speed and nearly the largest torque, half the inertia: a filter of eight periods has a limit cycle in the simulation.
TEST(SampledModel, LightMotorNeedsASlowReference)
{
    const sdre::Design &d     = board();
    sdre::Motor         light = d.drive.motor;
    light.inertia_kgm2 *= 0.5;
    const sdre::ReducedParameters motor  = sdre::reduced_parameters(light);
    const auto                    radius = [&](float share) {
        sdre::IdReference id      = references_of(d);
        id.c.weakening_per_period = share;
        const double speed        = d.drive.motor.rated_speed_e_radps;
        const auto   at           = sdre::loaded_point(id, d.l, d.l, speed, 1.0);
        const auto   s      = sdre::steady_state(id, motor, d.l, speed, at.iq_A);
        const auto   gains  = gains_at(d, s.at.iq_A);
        const auto   moving = sdre::moving_reference(id, d.l, gains.Lambda, s);
        return sdre::spectral_radius(sdre::sampled_model(motor, d.l, gains, s.at, 2e-4, &moving).A);
    };
    EXPECT_GT(radius(1.0F / 8.0F), 1.01);
    EXPECT_LT(radius(references_of(d).c.weakening_per_period), 0.998);
}

TEST(SampledModel, TargetOfTheReferenceIsTheFirmwares)
{
    const sdre::Design   &d  = board();
    sdre::IdReference     id = references_of(d);
    current_ref_config_t &c  = id.c;
    c.mtpa_per_period = c.weakening_per_period = 1.0F; // the target at once
    sdre::Uniform random(7, 1);
    int           weakened = 0;
    for (int n = 0; n < 2000; n++) {
        const auto draw = [&](double lo, double hi) {
            return static_cast<float>(random.next(lo, hi));
        };
        nodo_t est{};
        est.d_omega = draw(-7000.0, 7000.0);
        est.d_q     = draw(-300.0, 300.0);
        est.d_d     = draw(-300.0, 300.0);
        const nodo_meas_t y{draw(-1500.0, 1500.0), draw(-4.0, 4.0), draw(-4.0, 1.0)};
        speed_ref_t       w{};
        w.omega_e_radps = y.omega_e_radps;
        current_ref_t r{};
        current_ref_reset(&r, &c);
        r.i_A.q = draw(-3.3, 3.3);
        sdre::IdInputs in;
        in.d_omega         = static_cast<double>(est.d_omega);
        in.d_q             = static_cast<double>(est.d_q);
        in.d_d             = static_cast<double>(est.d_d);
        in.omega_e_radps   = static_cast<double>(y.omega_e_radps);
        in.iq_A            = static_cast<double>(y.iq_A);
        in.id_A            = static_cast<double>(y.id_A);
        in.iq_ref_A        = static_cast<double>(r.i_A.q);
        in.iq_speed_A      = static_cast<double>(draw(-0.5, 0.5));
        in.profile_e_radps = in.omega_e_radps;
        const current_ref_input_t from{
            &est, &y,  static_cast<float>(in.iq_speed_A), 295.0F, static_cast<float>(id.most_Aps),
            0.0F, 0.0F};
        r.v_low_Aps   = CHECK_LARGEST; // the link is constant
        r.iq_circle_A = 100.0F;        // the limit of what is requested is not in the model
        current_ref_update(&r, &c, &d.config.motor, &w, &from);
        const double expected = sdre::id_target_A(id, d.l, in);
        EXPECT_NEAR(static_cast<double>(r.i_A.d), expected, 2e-4) << n;
        weakened += expected < sdre::mtpa_id_A(d.l, in.iq_ref_A) - 0.1 ? 1 : 0;
    }
    EXPECT_GT(weakened, 300);
}

TEST(SampledModel, AngleItselfDoesNotMatter)
{
    // The model has no angle, only its error: the nonlinear loop answers the same wherever it starts.
    constexpr double tolerance        = 0.02; // of the dip; single precision of angle and currents
    const support::StepResponse first = support::nonlinear_step(board(), 300.0, 0.75, 0.05, 0.0);
    const double                dip =
        -*std::min_element(first.deviation_e_radps.begin(), first.deviation_e_radps.end());
    for (const double theta : {1.0, 2.5, -2.9, pi}) {
        const support::StepResponse other =
            support::nonlinear_step(board(), 300.0, 0.75, 0.05, theta);
        for (std::size_t k = 0; k < first.deviation_e_radps.size(); k++) {
            EXPECT_NEAR(other.deviation_e_radps[k], first.deviation_e_radps[k], tolerance * dip);
        }
    }
}

TEST(SampledModel, SteadyStateHasNoSpeedError)
{
    const sdre::OperatingPoint at{300.0, 1.9, -0.4};
    const sdre::SampledModel   m =
        sdre::sampled_model(board().l, board().l, gains_at(board(), at.iq_A), at, 200e-6);
    const VectorXd x = support::solve(MatrixXd::Identity(10, 10) - m.A, m.b_load);

    EXPECT_NEAR(x(0), 0.0, 1e-6);                   // w
    EXPECT_NEAR(x(3), 0.0, 1e-6);                   // theta - theta^
    EXPECT_NEAR(x(4) / -board().l[3], 1.0, 1e-6);   // d_w^ is the load
    EXPECT_NEAR(x(8), x(1), 1e-6 * std::abs(x(1))); // iq^ = iq
    EXPECT_LT(sdre::spectral_radius(m.A), 1.0);
    EXPECT_EQ(m.B_noise.rows(), 10);
    EXPECT_EQ(m.B_noise.topRows(3).norm(), 0.0); // noise reaches the motor through the observer
}

TEST(SampledModel, WrongParametersStillSettleOnTheSpeed)
{
    sdre::Motor believed = board().drive.motor;
    believed.inertia_kgm2 *= 2.0;
    believed.viscous_friction_Nms *= 2.0;
    believed.stator_resistance_Ohm *= 1.5;
    believed.d_axis_inductance_H *= 1.5;
    believed.q_axis_inductance_H *= 1.5;
    believed.pm_flux_Wb *= 1.5;
    sdre::Drive drive            = board().drive;
    drive.motor                  = believed;
    const sdre::Design         d = sdre::design_drive(drive);
    const sdre::OperatingPoint at{300.0, 1.9, -0.4};
    const sdre::SampledModel   m =
        sdre::sampled_model(board().l, d.l, gains_at(d, at.iq_A), at, 200e-6);
    const VectorXd x = support::solve(MatrixXd::Identity(10, 10) - m.A, m.b_load);

    EXPECT_LT(sdre::spectral_radius(m.A), 1.0);
    EXPECT_NEAR(x(0), 0.0, 1e-6);
}

TEST(SampledModel, DestabilisedGainsAreUnstable)
{
    const sdre::OperatingPoint at{300.0, 1.9, -0.4};
    const auto                 radius = [&](double law, double observer) {
        sdre::LoopGains gains = gains_at(board(), at.iq_A);
        gains.Lambda *= law;
        gains.L *= observer;
        return sdre::spectral_radius(
                            sdre::sampled_model(board().l, board().l, gains, at, 200e-6).A);
    };

    EXPECT_LT(radius(1.0, 1.0), 1.0);
    EXPECT_GT(radius(20.0, 1.0), 1.0);
    EXPECT_GT(radius(-1.0, 1.0), 1.0);
    EXPECT_GT(radius(1.0, 20.0), 1.0);
    EXPECT_GT(radius(1.0, -1.0), 1.0);
}

TEST(SampledModel, DriveWithDestabilisingWeightsIsReported)
{
    sdre::Drive drive = board().drive;
    drive.nosc.Q      = {2e9, 8e9, 8e9}; // far beyond what the period allows

    const sdre::Design d = sdre::design_drive(drive);

    EXPECT_FALSE(d.certificate.passed());
    EXPECT_GT(d.certificate.nosc.spectral_radius, 1.0);
    EXPECT_GT(d.certificate.nodo.spectral_radius, 1.0); // the whole loop
}

TEST(SampledModel, MtpaCurrentIsTheBestDirection)
{
    const sdre::Motor &m = board().drive.motor;
    for (const double iq : {-3.0, 0.5, 2.0, 7.5}) {
        const double id    = sdre::mtpa_id_A(board().l, iq);
        const double i     = std::hypot(id, iq);
        const double angle = std::atan2(-id, std::abs(iq));
        const auto   T     = [&](double a) {
            return sdre::torque_Nm(m, -i * std::sin(a), i * std::cos(a));
        };
        EXPECT_LT(id, 0.0);
        EXPECT_GE(T(angle), T(angle + 1e-3)) << iq;
        EXPECT_GE(T(angle), T(angle - 1e-3)) << iq;
    }
    EXPECT_EQ(sdre::mtpa_id_A(board().l, 0.0), 0.0);
}
