// SPDX-License-Identifier: MIT
/// noc_shaft's two problems and its loop, against the firmware's own steps and the control core in time.
#include "design/noc_shaft/shaft_loop.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "design/laws/near_optimal.hpp"
#include "linalg/expm.hpp"
#include "load_response.hpp"
#include "shaft_drives.hpp"
#include "shipped_drive.hpp"
#include "sil/setup/board_reader.hpp"
#include "temp_dir.hpp"

extern "C" {
#include "nodo_shaft.h"
}

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const sdre::Design &shipped()
{
    static const sdre::Design d =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w_shaft")));
    return d;
}

const law_noc_shaft_config_t &constants(const sdre::Design &d)
{
    return *sdre::constants_of<law_noc_shaft_config_t>(d.config);
}

/// The firmware's prediction from (d_w d_q d_d w iq id theta w_load twist) and (v_q, v_d), as a change.
VectorXd predicted(const sdre::Design &d, const VectorXd &x, double vq, double vd)
{
    nodo_shaft_t s{};
    s.motor        = {sdre::single(x(0)), sdre::single(x(1)), sdre::single(x(2)),
                      sdre::single(x(3)), sdre::single(x(4)), sdre::single(x(5))};
    s.theta_rad    = sdre::single(x(6));
    s.load_e_radps = sdre::single(x(7));
    s.twist_rad    = sdre::single(x(8));
    nodo_shaft_predict(&s, &constants(d).nodo, &d.config.motor,
                       {sdre::single(vd), sdre::single(vq)}, d.config.ts_s);
    VectorXd out(9);
    out << s.motor.d_omega, s.motor.d_q, s.motor.d_d, s.motor.omega_e_radps, s.motor.iq_A,
        s.motor.id_A, s.theta_rad, s.load_e_radps, s.twist_rad;
    return out;
}

std::string error_of(const std::string &from, const std::string &to)
{
    std::string       text = support::read_file(support::shipped_drive("ipmsm_390w_shaft"));
    const std::size_t at   = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
        sdre::read_drive_text(text, support::shipped_drive("ipmsm_390w_shaft"));
    } catch (const sdre::InputError &e) {
        return e.what();
    }
    return "";
}

} // namespace

/// The motor is bilinear and the shaft linear, so differences of steps this large are exact but for rounding.
TEST(ShaftDesign, LinearPredictionIsTheDerivativeOfTheFirmwares)
{
    const sdre::Design        &d = shipped();
    const sdre::OperatingPoint at{120.0, 1.3, -0.4};
    const auto o = linear_shaft_observer(d.l, sdre::believed_shaft(d.drive), d.nosc.gain[0], at,
                                         sdre::control_period_s(d.drive));
    // A steady state: then the middle of the period is the point itself.
    const double a    = (d.l[1] + d.l[11] * at.id_A) * at.iq_A;
    const double load = -(a - d.l[2] * at.omega_e_radps);
    const double vq = (d.l[4] * at.iq_A + (d.l[5] + d.l[10] * at.id_A) * at.omega_e_radps) / d.l[6];
    const double vd = (d.l[7] * at.id_A - d.l[9] * at.iq_A * at.omega_e_radps) / d.l[8];
    const sdre::Shaft shaft = sdre::believed_shaft(d.drive);
    const double      twist = -load / shaft.load_inertia_share * sdre::twist_per_accel(shaft);
    VectorXd          x(9);
    x << load, 0.0, 0.0, at.omega_e_radps, at.iq_A, at.id_A, 0.3, at.omega_e_radps, twist;
    const VectorXd still = predicted(d, x, vq, vd);
    EXPECT_NEAR(still(3), x(3), 1e-3);
    EXPECT_NEAR(still(7), x(7), 1e-3);
    EXPECT_NEAR(still(8), x(8), 1e-6);
    EXPECT_NEAR(still(4), x(4), 1e-5);
    EXPECT_NEAR(still(6), x(6) + 2e-4 * at.omega_e_radps, 1e-6);

    VectorXd steps(9);
    steps << 2000.0, 100.0, 100.0, 20.0, 0.5, 0.5, 0.2, 20.0, 0.02;
    VectorXd sizes(9); // of a row's change
    sizes << 2000.0, 100.0, 100.0, 20.0, 0.5, 0.5, 0.02, 20.0, 0.02;
    for (int j = 0; j < 9; j++) {
        const VectorXd e    = VectorXd::Unit(9, j) * steps(j);
        const VectorXd more = predicted(d, x + e, vq, vd);
        const VectorXd less = predicted(d, x - e, vq, vd);
        for (int i = 0; i < 9; i++) {
            EXPECT_NEAR(0.5 * (more(i) - less(i)), o.P(i, j) * steps(j), 2e-5 * sizes(i) + 1e-5)
                << i << " " << j;
        }
    }
    for (int j = 0; j < 2; j++) {
        const double   q    = j == 0 ? 10.0 : 0.0;
        const VectorXd more = predicted(d, x, vq + q, vd + (10.0 - q));
        const VectorXd less = predicted(d, x, vq - q, vd - (10.0 - q));
        for (int i = 0; i < 9; i++) {
            EXPECT_NEAR(0.05 * (more(i) - less(i)), o.G(i, j), 1e-5) << i << " " << j;
        }
    }
}

/// The oracle: EQ-CERT-9 held over a period by itself.
TEST(ShaftDesign, StepOfTheMassesIsThatOfThePlant)
{
    const sdre::Design &d     = shipped();
    const sdre::Shaft   shaft = sdre::believed_shaft(d.drive);
    const double        ts    = sdre::control_period_s(d.drive);
    const MatrixXd      step  = sdre::shaft_step(d.l, shaft, ts);
    const auto          plant =
        held_with_shaft(sdre::true_motor(d.drive, d.drive.motor), {0.0, 0.0, 0.0}, ts, shaft).held;
    EXPECT_NEAR(step(1, 4) * d.l[3], -plant.Gamma(4, 2), 2e-3 * std::abs(plant.Gamma(4, 2)));
    EXPECT_NEAR(step(1, 1), plant.Phi(4, 4), 2e-3);
    EXPECT_NEAR(step(2, 2), plant.Phi(5, 5), 2e-3);
    EXPECT_NEAR(step(0, 0), plant.Phi(0, 0), 2e-2); // the plant has the back-EMF
    EXPECT_NEAR(step.row(0).head(2).sum(), 1.0, 1e-4);
    EXPECT_NEAR(step(3, 0) + step(3, 1), ts, 1e-8); // both together turn theta
}

/// The control core on a motor with this shaft, in time.
TEST(ShaftDesign, SmallLoadStepIsThatOfTheControlCore)
{
    for (const support::ShaftWeights &w : support::shaft_weights) {
        const sdre::Design d = sdre::design_drive(support::shaft_drive(w));
        EXPECT_TRUE(d.certificate.passed()) << w.resonance_Hz << d.certificate.failures.front();
        const support::StepResponse found =
            support::nonlinear_step(d, 300.0, 0.75, 0.05, 0.3, effects_of_drive(d.drive));
        ASSERT_FALSE(found.limited);
        const sdre::TwoMasses masses(d);
        const sdre::LoopGains gains =
            sdre::encoder_form_gains(d, found.before.iq_A, d.nosc.gain[0]);
        const std::vector<double> expected = support::linear_step(
            masses.loop(sdre::believed_shaft(d.drive), found.before, gains), 0.05);
        double dip = 0.0;
        for (const double x : expected) {
            dip = std::max(dip, std::abs(x));
        }
        for (std::size_t k = 0; k < expected.size(); k++) {
            EXPECT_NEAR(found.deviation_e_radps[k], expected[k], 0.08 * dip)
                << w.resonance_Hz << " " << k;
        }
    }
}

/// Every part of the verdict has the shaft in its loop.
TEST(ShaftDesign, ShippedDriveIsCertifiedWithItsShaft)
{
    const sdre::Design &d = shipped();
    EXPECT_TRUE(d.certificate.passed());
    ASSERT_TRUE(d.certificate.loop->shaft);
    EXPECT_TRUE(d.certificate.loop->shaft->everywhere());
    EXPECT_EQ(d.certificate.loop->shaft->mechanics.from_Hz, 209.0);
    EXPECT_EQ(d.certificate.loop->shaft->mechanics.to_Hz, 231.0);
    EXPECT_GE(d.certificate.loop->box->share, sdre::box_share_limit);
    EXPECT_EQ(d.certificate.loop->alone->share, 1.0);
    EXPECT_LT(d.certificate.nodo.spectral_radius, 1.0);
    EXPECT_EQ(d.nosc.gain[0].cols(), 5);
    EXPECT_EQ(d.nodo.gain[0].rows(), 9);

    sdre::Drive far          = d.drive; // the same weights with another resonance
    far.mechanics.from_Hz    = 450.0;
    far.mechanics.to_Hz      = 460.0;
    const sdre::Design other = sdre::design_drive(far);
    EXPECT_FALSE(other.certificate.loop->shaft->everywhere());
}

/// Its gains are those of the drive file's weights: the Riccati equation in the coordinates of both speeds.
TEST(ShaftDesign, FeedbackSolvesTheEquationOfBothSpeeds)
{
    const sdre::Design &d     = shipped();
    const sdre::Shaft   s     = sdre::believed_shaft(d.drive);
    const auto          plant = [&] { // w iq id w_load twist
        const double w_r = 2.0 * std::acos(-1.0) * s.resonance_Hz;
        const double K   = w_r * w_r;
        const double D   = 2.0 * s.damping * w_r;
        const double b   = s.load_inertia_share;
        MatrixXd     A   = MatrixXd::Zero(5, 5);
        A.row(0) << -d.l[2] / (1.0 - b) - b * D, d.l[1] / (1.0 - b), 0.0, b * D, -b * K;
        A.row(1) << -d.l[5], -d.l[4], 0.0, 0.0, 0.0;
        A(2, 2) = -d.l[7];
        A.row(3) << (1.0 - b) * D, 0.0, 0.0, -(1.0 - b) * D, (1.0 - b) * K;
        A.row(4) << 1.0, 0.0, 0.0, -1.0, 0.0;
        return A;
    }();
    MatrixXd B = MatrixXd::Zero(5, 2);
    B(1, 0)    = d.l[6];
    B(2, 1)    = d.l[8];
    MatrixXd K = d.nosc.gain[0];
    K.col(0) -= K.col(3); // slip = w_load - w
    VectorXd Q(5);
    Q << d.drive.nosc.Q[0], d.drive.nosc.Q[1], d.drive.nosc.Q[2], d.drive.shaft.Q[0],
        d.drive.shaft.Q[1];
    const double per_A =
        d.l[11] / (1.0 - s.load_inertia_share); // EQ-MOTOR-2 for the motor's mass alone
    EXPECT_NEAR(d.nosc.problem.dA[0](0, 2), per_A, 1e-9 * std::abs(per_A));
    EXPECT_NEAR(d.nosc.problem.dA[0](3, 2), -per_A, 1e-9 * std::abs(per_A));
    // X of the Lyapunov equation of the closed loop gives the gain back: T K = B' X.
    const Eigen::Vector2d T(d.drive.nosc.T[0], d.drive.nosc.T[1]);
    const MatrixXd        loop = plant - B * K;
    const MatrixXd        R    = MatrixXd(Q.asDiagonal()) + K.transpose() * T.asDiagonal() * K;
    MatrixXd              big  = MatrixXd::Zero(25, 25);
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < 5; j++) {
            for (int k = 0; k < 5; k++) {
                big(i + 5 * j, k + 5 * j) += loop(k, i);
                big(i + 5 * j, i + 5 * k) += loop(k, j);
            }
        }
    }
    const VectorXd x = big.fullPivLu().solve(-VectorXd(R.reshaped()));
    const MatrixXd X = x.reshaped(5, 5);
    EXPECT_LT((T.asDiagonal() * K - B.transpose() * X).norm(), 1e-6 * (B.transpose() * X).norm());
}

TEST(ShaftDesign, WrongDriveFilesAreRefusedByTheirKey)
{
    const auto says = [](const std::string &from, const std::string &to, const std::string &what) {
        const std::string e = error_of(from, to);
        EXPECT_NE(e.find(what), std::string::npos) << from << ": " << e;
    };
    says("resonance_Hz       = 220.0\ndamping            = 0.02\n", "coupling = \"elastic\"\n",
         "[mechanics] needs resonance_Hz");
    says("[mechanics]\nresonance_Hz       = 220.0\ndamping            = 0.02\n"
         "load_inertia_share = 0.5\n",
         "", "[mechanics] needs resonance_Hz");
    says("[shaft]\nQ", "[shaft]\nQQ", "Q is missing");
    says("nodo_Q", "nodo_q", "nodo_Q");
    says("form = \"encoder\"\norder = 1", "form = \"encoder\"\norder = 0",
         "must be 1 with noc_shaft");
    says("[shaft]", "[position]\nQ = [1.0, 1.0, 1.0, 1.0]\nT = [1.0, 1.0]\n[shaft]", "[position]");
}
