// SPDX-License-Identifier: MIT
// The design with the angle as a fourth state, against a Riccati solution of the test's own.
#include <cmath>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/position.hpp"
#include "design/sampled_model.hpp"
#include "linalg/eigenvalues.hpp"
#include "linear.hpp"
#include "shipped_drive.hpp"

namespace {

using Eigen::MatrixXd;

const sdre::Design &shipped()
{
    static const sdre::Design design =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w")));
    return design;
}

/// x = (theta, w, iq, id) at a frozen error of the q current: theta' = w and (20).
MatrixXd state_matrix(const sdre::ReducedParameters &l, double eiq_A)
{
    MatrixXd A(4, 4);
    A << 0.0, 1.0, 0.0, 0.0,             //
        0.0, -l[2], l[1], l[11] * eiq_A, //
        0.0, -l[5], -l[4], 0.0,          //
        0.0, 0.0, 0.0, -l[7];
    return A;
}

/// T^-1 B' X from the stable eigenvectors of the Hamiltonian matrix.
MatrixXd exact_gain(const sdre::Design &d, double eiq_A)
{
    const sdre::PositionSpec &p = *d.drive.position;
    MatrixXd                  B = MatrixXd::Zero(4, 2);
    B(2, 0)                     = d.l[6];
    B(3, 1)                     = d.l[8];
    const Eigen::Vector2d T_inverse(1.0 / p.T[0], 1.0 / p.T[1]);
    const MatrixXd        A = state_matrix(d.l, eiq_A);
    MatrixXd              H(8, 8);
    H << A, -B * T_inverse.asDiagonal() * B.transpose(),
        MatrixXd(Eigen::Vector4d(-p.Q[0], -p.Q[1], -p.Q[2], -p.Q[3]).asDiagonal()), -A.transpose();
    const support::Modes found = support::modes_of(H);
    Eigen::MatrixXcd     stable(8, 4);
    int                  n = 0;
    for (int i = 0; i < 8; i++) {
        if (found.values(i).real() < 0.0 && n < 4) {
            stable.col(n++) = found.vectors.col(i);
        }
    }
    const Eigen::MatrixXcd X =
        stable.bottomRows(4) * support::inverse(Eigen::MatrixXcd(stable.topRows(4)));
    return T_inverse.asDiagonal() * B.transpose() * X.real();
}

sdre::Drive with(const std::string &from, const std::string &to)
{
    std::string       text = sdre::read_text_file(support::shipped_drive("ipmsm_390w"));
    const std::size_t at   = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return sdre::read_drive_text(text.replace(at, from.size(), to), "d.toml");
}

void expect_refused(const std::string &from, const std::string &to, const std::string &why)
{
    try {
        with(from, to);
        ADD_FAILURE() << to << " is taken";
    } catch (const sdre::InputError &e) {
        EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
}

} // namespace

TEST(Position, FirstTermIsTheRiccatiGain)
{
    const MatrixXd exact = exact_gain(shipped(), 0.0);
    EXPECT_LT((shipped().position->gain[0] - exact).norm(), 1e-9 * exact.norm());
}

TEST(Position, SeriesFollowsTheExactGain)
{
    const auto     at = [](double e) { return exact_gain(shipped(), e); };
    const double   h  = 1e-3;
    const MatrixXd d1 = (at(h) - at(-h)) / (2.0 * h);
    const MatrixXd d2 = (at(h) + at(-h) - 2.0 * at(0.0)) / (2.0 * h * h);
    EXPECT_LT((shipped().position->gain[1] - d1).norm(), 1e-5 * d1.norm());
    EXPECT_LT((shipped().position->gain[2] - d2).norm(), 1e-3 * d2.norm());
}

TEST(Position, FirmwareGetsTheGainsWithTheirParity)
{
    const auto             &g = shipped().position->gain;
    const sdre::Design     &d = shipped();
    const position_gains_t &c =
        sdre::constants_of<law_noc_config_t>(d.config)->near_optimal.position;
    EXPECT_TRUE(d.config.positions);
    for (std::size_t n = 0; n < g.size(); n++) {
        const int row = n % 2 == 0 ? 0 : 1;
        EXPECT_FLOAT_EQ(c.theta[n], static_cast<float>(g[n](row, 0)));
        EXPECT_LT(std::abs(g[n](1 - row, 0)), 1e-9 * g[n].norm()); // what is left out is nothing
    }
    EXPECT_FLOAT_EQ(c.speed_per_rad, static_cast<float>(g[0](0, 0) / g[0](0, 1)));
}

TEST(Position, WithoutItsColumnTheLoopIsTheSpeedsAndAnIntegrator)
{
    const sdre::Design        &d = shipped();
    const sdre::OperatingPoint at{200.0, 1.0, -0.2};
    MatrixXd                   Lambda = MatrixXd::Zero(2, 4);
    Lambda.rightCols(3)               = d.nosc.gain[0];
    const MatrixXd &L                 = d.nodo.gain[0];
    const auto      speed  = sdre::sampled_model(d.l, d.l, {d.nosc.gain[0], L}, at, 2e-4);
    const auto      angle  = sdre::sampled_model(d.l, d.l, {Lambda, L}, at, 2e-4);
    const auto      values = sdre::eigenvalues(angle.A);
    ASSERT_EQ(angle.A.rows(), speed.A.rows() + 1);
    EXPECT_LT((values.array() - 1.0).abs().minCoeff(), 1e-9);
    for (const auto &x : sdre::eigenvalues(speed.A)) {
        EXPECT_LT((values.array() - x).abs().minCoeff(), 1e-6);
    }
    EXPECT_EQ(angle.C_voltage.cols(), angle.A.cols());
}

/// A constant error of the angle alone has the voltage of EQ-POSITION-3 and none of anything else.
TEST(Position, SampledLoopReadsTheEstimatedAngle)
{
    const sdre::Design        &d = shipped();
    const sdre::OperatingPoint at{0.0, 0.0, 0.0};
    const auto m = sdre::sampled_model(d.l, d.l, {d.position->gain[0], d.nodo.gain[0]}, at, 2e-4);
    EXPECT_NEAR(m.C_voltage(0, 10), -d.position->gain[0](0, 0), 1e-9);
    EXPECT_LT(sdre::spectral_radius(m.A), 1.0);
}

TEST(Position, VerdictJudgesBothDesigns)
{
    sdre::Drive stiff = shipped().drive;
    stiff.position->Q[0] *= 1000.0;
    EXPECT_TRUE(shipped().certificate.passed());
    EXPECT_FALSE(sdre::design_drive(stiff, sdre::Precision::quick).certificate.passed());
}

TEST(Position, DriveFileSaysWhatItCannotTake)
{
    const std::string q = "Q = [12800.0, 0.464, 0.000989, 19.8]";
    expect_refused(q, "Q = [12800.0, 0.464, 0.000989]", "[position] Q");
    expect_refused(q, "Q = [0.0, 0.64, 0.000213, 11.1]",
                   "[position] Q[0] = 0 is not allowed: must be");
    expect_refused(q, q + "\nspeed = 1", "[position]");
    expect_refused("edge_times = true", "edge_times = true\n[position2]", "position2");
}
