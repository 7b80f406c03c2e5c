// SPDX-License-Identifier: MIT
#include "design/noc_h/harmonic_design.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "design/design.hpp"
#include "design/noc_h/harmonic_loop.hpp"
#include "shipped_drive.hpp"

extern "C" {
#include "nodo_encoder.h"
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index n_base = NODO_HARMONIC_N_BASE;
constexpr dq_t  voltage_V{2.0F, 60.0F}; // in force, d and q
enum Row : Index { d_omega, d_q, d_d, omega, iq, id, theta, slope };

const std::vector<std::string> drives{"ipmsm_390w_noc_h", "servo_200w_noc_h"};

const sdre::Design &design_of(const std::string &name)
{
    static std::map<std::string, sdre::Design> designs;
    const auto                                 found = designs.find(name);
    return found != designs.end() ? found->second
                                  : designs
                                        .emplace(name, sdre::design_drive(sdre::read_drive_file(
                                                           support::shipped_drive(name))))
                                        .first->second;
}

/// Without any harmonic, and without d_w'.
sdre::Drive plain_drive()
{
    sdre::Drive  drive                   = design_of(drives[0]).drive;
    const double speed                   = drive.harmonics.weight_speed_e_radps;
    drive.harmonics                      = {};
    drive.harmonics.weight_speed_e_radps = speed;
    return drive;
}

double ts_of(const sdre::Design &d)
{
    return sdre::control_period_s(d.drive);
}

/// States of the firmware's observer, rows of the table.
VectorXd rows_of(const nodo_harmonic_t &s, int pairs)
{
    VectorXd x(n_base + 2 * pairs);
    x.head(8) << s.base.d_omega, s.base.d_q, s.base.d_d, s.base.omega_e_radps, s.base.iq_A,
        s.base.id_A, s.theta_rad, s.slope;
    for (int i = 0; i < pairs; i++) {
        x(n_base + 2 * i)     = static_cast<double>(s.pair[i].a);
        x(n_base + 2 * i + 1) = static_cast<double>(s.pair[i].b);
    }
    return x;
}

nodo_harmonic_t state_of(const VectorXd &x, int pairs)
{
    const auto      f = [&x](Index row) { return static_cast<float>(x(row)); };
    nodo_harmonic_t s{};
    s.base      = {f(d_omega), f(d_q), f(d_d), f(omega), f(iq), f(id)};
    s.theta_rad = s.theta_pairs_rad = f(theta);
    s.slope                         = f(slope);
    for (int i = 0; i < pairs; i++) {
        s.pair[i] = {f(n_base + 2 * i), f(n_base + 2 * i + 1)};
    }
    return s;
}

/// One period of the firmware with these measurements: state after it, then what it shows the law and d_w'.
VectorXd firmware_step(const sdre::Design &d, const VectorXd &x, const dq_t &i_A, double theta_rad)
{
    const nodo_harmonic_gains_t &t = *d.harmonics->table;
    nodo_harmonic_t              s = state_of(x, t.n_pairs);
    nodo_harmonic_correct(&s, &t, i_A, frames_wrap(static_cast<float>(theta_rad) - s.theta_rad));
    nodo_harmonic_view_t view;
    nodo_harmonic_predict(&s, &t, &d.config.motor, voltage_V, d.config.ts_s, &view);
    const VectorXd after = rows_of(s, t.n_pairs);
    VectorXd       out(after.size() + 8);
    out << after, view.total.d_omega, view.total.d_q, view.total.d_d, view.total.omega_e_radps,
        view.total.iq_A, view.total.id_A, s.theta_rad, view.d_omega_dot;
    return out;
}

/// Signs of the mirror image, EQ-HARMONIC-3.
VectorXd mirror(const sdre::Drive &drive)
{
    const auto pairs = sdre::harmonic_pairs(drive);
    VectorXd   S(n_base + 2 * static_cast<Index>(pairs.size()));
    S.head(8) << -1, -1, 1, -1, -1, 1, -1, -1;
    for (std::size_t i = 0; i < pairs.size(); i++) {
        const bool odd =
            pairs[i].channel == NODO_HARMONIC_TORQUE || pairs[i].channel == NODO_HARMONIC_VOLTAGE_Q;
        S.segment(n_base + 2 * static_cast<Index>(i), 2) << (odd ? -1 : 1), (odd ? 1 : -1);
    }
    return S;
}

} // namespace

TEST(HarmonicDesign, WithoutPairsTheLoopIsThatOfTheEncoderForm)
{
    const sdre::Design    d  = sdre::design_drive(plain_drive());
    const double          ts = ts_of(d);
    const sdre::LoopGains gains_any{d.nosc.gain[0], {}};
    ASSERT_EQ(d.harmonics->table->n_pairs, 0);
    for (const sdre::OperatingPoint at :
         {sdre::OperatingPoint{0.0, 0.0, 0.0}, {300.0, 1.5, -0.4}, {900.0, -3.0, -2.0}}) {
        const MatrixXd K = sdre::harmonic_gain(*d.harmonics->table, at.omega_e_radps, at.iq_A);
        const sdre::HarmonicSampled found =
            sdre::sampled_harmonic_model(d.l, d.l, *d.harmonics->table, gains_any.Lambda, at, ts);
        const sdre::SampledModel expected =
            sdre::sampled_model(d.l, d.l, {gains_any.Lambda, K.topRows(7) / ts}, at, ts);

        ASSERT_EQ(found.A.rows(), expected.A.rows());
        EXPECT_LT((found.A - expected.A).norm(), 1e-9 * expected.A.norm());
        EXPECT_LT((found.C_voltage - expected.C_voltage).norm(), 1e-9 * expected.C_voltage.norm());
        EXPECT_LT((found.B_voltage - expected.B_voltage).norm(), 1e-9 * expected.B_voltage.norm());
        EXPECT_LT((found.B_noise - expected.B_noise).norm(), 1e-9 * expected.B_noise.norm());
    }
}

/// As the period falls, K / Ts approaches the gain of the continuous equation with the same weights: EQ-SAMPLED-OBSERVER-1.
TEST(HarmonicDesign, ShortPeriodsGiveTheContinuousGain)
{
    sdre::Drive drive               = plain_drive();
    drive.encoder.lines             = 1000000; // EQ-HARMONIC-8 then leaves the angle's weight alone
    const auto              l       = sdre::reduced_parameters(drive.motor);
    const sdre::SdreProblem problem = sdre::nodo_problem(l, drive.nodo);
    const MatrixXd          L       = sdre::solve_care(problem.A0, problem.G, problem.Q).X *
                       sdre::nodo_model(l, sdre::NodoForm::encoder).C.transpose() *
                       Eigen::Vector3d(drive.nodo.T[0], drive.nodo.T[1], drive.nodo.T[2])
                           .cwiseInverse()
                           .asDiagonal();
    const auto off = [&](double frequency_Hz) {
        drive.inverter.pwm_frequency_Hz = frequency_Hz;
        const sdre::HarmonicDesign h =
            sdre::design_harmonics(sdre::reduced_parameters(drive.motor), drive, 100.0, 4.0);
        const MatrixXd K = h.nodes.front().K0.topRows(7) * frequency_Hz;
        VectorXd       rows(7);
        for (Index i = 0; i < 7; i++) {
            rows(i) = (K.row(i) - L.row(i)).norm() / L.row(i).norm();
        }
        return rows;
    };
    const VectorXd coarse = off(1e6);
    const VectorXd fine   = off(4e6);
    for (Index i = 0; i < 7; i++) {
        EXPECT_LT(fine(i), 0.01) << i;
        EXPECT_NEAR(coarse(i) / fine(i), 4.0, 0.2) << i;
    }
}

/// EQ-HARMONIC-1, 2 and 4: the matrices against difference quotients of the C code.
TEST(HarmonicDesign, MatricesAreTheFirmwaresOwnStep)
{
    for (const std::string &name : drives) {
        const sdre::Design          &d = design_of(name);
        const nodo_harmonic_gains_t &t = *d.harmonics->table;
        const sdre::OperatingPoint   at{400.0, 1.2, -0.3};
        const sdre::HarmonicObserver o =
            sdre::linear_harmonic_observer(d.l, t, d.nosc.gain[0], at, ts_of(d));
        const MatrixXd K = sdre::harmonic_gain(t, at.omega_e_radps, at.iq_A);
        const Index    n = o.P.rows();
        const MatrixXd A = o.P - o.P * K * o.C;

        // A steady state: disturbances that balance the voltages and the load.
        const double w = at.omega_e_radps;
        VectorXd     x = VectorXd::Zero(n);
        x(d_omega)     = d.l[2] * w - at.iq_A * (d.l[1] + d.l[11] * at.id_A);
        x(d_q)         = d.l[4] * at.iq_A + w * (d.l[5] + d.l[10] * at.id_A) - d.l[6] * 60.0;
        x(d_d)         = d.l[7] * at.id_A - d.l[9] * at.iq_A * w - d.l[8] * 2.0;
        x(omega)       = w;
        x(iq)          = at.iq_A;
        x(id)          = at.id_A;
        x(theta)       = 0.5;
        VectorXd step  = VectorXd::Constant(n, 0.05);
        step.head(8) << 100.0, 10.0, 10.0, 2.0, 0.05, 0.05, 5e-4, 1e4;
        const dq_t i_A{static_cast<float>(at.id_A), static_cast<float>(at.iq_A)};

        for (Index j = 0; j < n; j++) {
            const VectorXd e = VectorXd::Unit(n, j) * step(j);
            const VectorXd found =
                0.5 * (firmware_step(d, x + e, i_A, 0.5) - firmware_step(d, x - e, i_A, 0.5));
            const VectorXd expected = A * e;
            for (Index i = 0; i < n; i++) {
                const double noise = 1e-6 * (std::abs(x(i)) + A.row(i).cwiseAbs().dot(step)) +
                                     1e-3 * std::abs(expected(i));
                EXPECT_NEAR(found(i), expected(i), noise) << name << " " << i << ", " << j;
            }
            // The law on the shown state: EQ-CURRENT-REF-1 takes d_w' to v_q.
            VectorXd law = sdre::encoder_form_law(d.l, d.nosc.gain[0], at).F * found.segment(n, 7);
            law(0) -= found(n + 7) / (d.l[6] * (d.l[1] + d.l[11] * at.id_A));
            const VectorXd shown = o.law.F * A * e;
            for (Index i = 0; i < 2; i++) {
                const double noise =
                    2e-3 * std::abs(shown(i)) + 2e-5 * (o.law.F * A).row(i).cwiseAbs().dot(step);
                EXPECT_NEAR(law(i), shown(i), noise) << name << " law " << i << ", " << j;
            }
        }
    }
}

/// EQ-HARMONIC-5: the motor at -w is the mirror image of the motor at w, so one table serves both.
TEST(HarmonicDesign, ModelOfReversedRotationIsTheMirrorImage)
{
    for (const std::string &name : drives) {
        const sdre::Design &d = design_of(name);
        const MatrixXd      S = mirror(d.drive).asDiagonal();
        const auto          f = sdre::harmonic_model(d.l, d.drive, 500.0);
        const auto          b = sdre::harmonic_model(d.l, d.drive, -500.0);
        const MatrixXd      y = Eigen::Vector3d(-1, 1, -1).asDiagonal();

        EXPECT_EQ((S * b.A0 * S - f.A0).norm(), 0.0);
        EXPECT_EQ((S * b.dA * S + f.dA).norm(), 0.0); // iq changes sign as well
        EXPECT_EQ((y * b.C * S - f.C).norm(), 0.0);
        EXPECT_GT(f.dA.norm(), 0.0);
    }
}

/// EQ-HARMONIC-8: of a drive whose file trusts the angle to 1e-12 rad^2 s, by the variance that the gain was made with.
TEST(HarmonicDesign, EdgesAreTrustedOnlyWhereThereAreEnough)
{
    sdre::Drive  drive = design_of("ipmsm_390w_noc_h_edges").drive;
    const double ts    = sdre::control_period_s(drive);
    const double count =
        2.0 * std::acos(-1.0) * drive.motor.pole_pairs / (4.0 * drive.encoder.lines);
    const double one    = count / ts; // speed of one count per period
    const double floor2 = count * count / 12.0 * ts;

    EXPECT_NEAR(sdre::angle_weight(drive, 0.0), floor2, 1e-12 * floor2);
    EXPECT_NEAR(sdre::angle_weight(drive, one), floor2, 1e-12 * floor2);
    EXPECT_NEAR(sdre::angle_weight(drive, 4.5 * one), std::sqrt(floor2 * drive.nodo.T[2]),
                1e-9 * floor2);
    EXPECT_NEAR(sdre::angle_weight(drive, 8.0 * one), drive.nodo.T[2], 1e-9 * drive.nodo.T[2]);
    EXPECT_NEAR(sdre::angle_weight(drive, 80.0 * one), drive.nodo.T[2], 1e-12 * drive.nodo.T[2]);

    drive.nodo.T[2] = 2.0 * floor2; // a drive that trusts counts less than that keeps its own
    EXPECT_EQ(sdre::angle_weight(drive, 0.0), 2.0 * floor2);
}

/// EQ-HARMONIC-6.
TEST(HarmonicDesign, WeightsOfPairsRiseWithTheSpeedAndFadeTowardsARadianPerPeriod)
{
    for (const std::string &name : drives) {
        const sdre::Drive &drive = design_of(name).drive;
        const auto         pairs = sdre::harmonic_pairs(drive);
        const double       ts    = sdre::control_period_s(drive);
        EXPECT_TRUE(sdre::harmonic_weights(drive, 0.0).tail(2 * pairs.size()).isZero(0.0));
        for (std::size_t i = 0; i < pairs.size(); i++) {
            const double h   = std::abs(static_cast<double>(pairs[i].order));
            const Index  row = n_base + 2 * static_cast<Index>(i);
            const double end = 1.0 / (h * ts);
            const double ref = drive.harmonics.weight_speed_e_radps;
            const auto   at  = [&](double w) {
                const VectorXd Q = sdre::harmonic_weights(drive, w);
                EXPECT_EQ(Q(row), Q(row + 1));
                return Q(row) / std::pow(std::cos(std::acos(0.0) * h * w * ts), 2);
            };
            EXPECT_EQ(sdre::harmonic_weights(drive, end)(row), 0.0);
            EXPECT_EQ(sdre::harmonic_weights(drive, 1.5 * end)(row), 0.0);
            EXPECT_EQ(sdre::harmonic_weights(drive, 2.0 * end)(row), 0.0);
            EXPECT_GT(sdre::harmonic_weights(drive, 0.99 * end)(row), 0.0);
            const double low = 0.2 * std::min(ref, end);
            EXPECT_NEAR(at(2.0 * low) / at(low), 4.0, 1e-9);
            if (1.2 * ref < end) {
                EXPECT_NEAR(at(1.2 * ref) / at(ref), 1.0, 1e-9);
            }
        }
    }
}

TEST(HarmonicDesign, EachPairHasTheWeightOfItsKind)
{
    sdre::Drive drive                      = design_of("servo_200w_noc_h").drive;
    drive.harmonics.sensor_weight          = 1.0;
    drive.harmonics.voltage_weight         = 2.0;
    drive.harmonics.cogging_weight         = 3.0;
    drive.harmonics.cogging_voltage_weight = 5.0;
    drive.harmonics.slope_weight           = 7.0;
    drive.harmonics.weight_speed_e_radps   = 1e-3; // far below a radian per period
    const VectorXd Q                       = sdre::harmonic_weights(drive, 1e-3);
    const double   weights[] = {1.0, 1.0, 2.0, 2.0, 3.0, 5.0, 3.0, 5.0}; // of the pairs below
    for (Index i = 0; i < 8; i++) {
        EXPECT_NEAR(Q(n_base + 2 * i), weights[i], 1e-9) << i;
    }
    EXPECT_EQ(Q(slope), 7.0);
    for (Index i = 0; i < slope; i++) {
        EXPECT_EQ(Q(i), drive.nodo.Q.at(static_cast<std::size_t>(i))) << i;
    }
}

TEST(HarmonicDesign, PairsAreThoseOfTheFileInTheirChannels)
{
    const auto pairs = sdre::harmonic_pairs(design_of("servo_200w_noc_h").drive);
    ASSERT_EQ(pairs.size(), 8U);
    const std::vector<std::pair<int, float>> expected{
        {NODO_HARMONIC_SENSOR, -1.0F},   {NODO_HARMONIC_SENSOR, -2.0F},
        {NODO_HARMONIC_VOLTAGE_Q, 6.0F}, {NODO_HARMONIC_VOLTAGE_D, 6.0F},
        {NODO_HARMONIC_TORQUE, 8.0F},    {NODO_HARMONIC_VOLTAGE_Q, 8.0F},
        {NODO_HARMONIC_TORQUE, 16.0F},   {NODO_HARMONIC_VOLTAGE_Q, 16.0F}};
    for (std::size_t i = 0; i < pairs.size(); i++) {
        EXPECT_EQ(pairs[i].channel, expected[i].first) << i;
        EXPECT_EQ(pairs[i].order, expected[i].second) << i; // 32 slots, 4 pole pairs
    }
}

/// Measured against exact solutions half-way between two nodes, columns in units of their noise: the docs say so.
TEST(HarmonicDesign, GainBetweenNodesIsCloseToTheExactOne)
{
    for (const std::string &name : drives) {
        const sdre::Design &d         = design_of(name);
        const auto         &t         = *d.harmonics->table;
        const double        trip      = d.harmonics->nodes.back().omega_e_radps;
        const double        one_count = 2.0 * std::acos(-1.0) * d.drive.motor.pole_pairs /
                                 (4.0 * d.drive.encoder.lines * ts_of(d));
        double worst_base = 0.0;
        double worst_edge =
            0.0; // where edges come to be trusted, EQ-HARMONIC-8: the gain moves tenfold there
        const MatrixXd R = Eigen::Vector3d(d.drive.nodo.T[0], d.drive.nodo.T[1], d.drive.nodo.T[2])
                               .cwiseSqrt()
                               .asDiagonal();
        for (const int k : {2, 5, 12}) {
            const double   w     = trip * std::pow((2.0 * k + 1.0) / 32.0, 2);
            const MatrixXd exact = sdre::design_harmonics(d.l, d.drive, w, 4.0).nodes.back().K0 * R;
            const MatrixXd found = sdre::harmonic_gain(t, w, 0.0) * R;
            for (Index i = 0; i < 7; i++) {
                const bool   between = w > one_count && w < 8.0 * one_count;
                const double error   = (found.row(i) - exact.row(i)).norm() / exact.row(i).norm();
                double      &worst   = between ? worst_edge : worst_base;
                worst                = std::max(worst, error);
            }
        }
        EXPECT_LT(worst_base, 0.02) << name; // measured 0.009
        EXPECT_LT(worst_edge, 0.10) << name; // measured 0.068
    }
}

TEST(HarmonicDesign, TableHoldsTheNodes)
{
    for (const std::string &name : drives) {
        const sdre::Design          &d = design_of(name);
        const nodo_harmonic_gains_t &t = *d.harmonics->table;
        ASSERT_EQ(d.harmonics->nodes.size(), static_cast<std::size_t>(t.n_nodes));
        for (const sdre::HarmonicNode &node : d.harmonics->nodes) {
            const MatrixXd at_1A = sdre::harmonic_gain(t, node.omega_e_radps, 1.0);
            const MatrixXd sum   = node.K0 + node.K1;
            for (Index i = 0; i < sum.rows(); i++) {
                EXPECT_LE((at_1A.row(i) - sum.row(i)).norm(),
                          2e-5 * (node.K0.row(i).norm() + node.K1.row(i).norm()) + 1e-9)
                    << name << " " << node.omega_e_radps << " " << i;
            }
            EXPECT_LT(node.residual, 1e-12);
        }
        EXPECT_TRUE(d.certificate.passed());
        EXPECT_LT(d.harmonic_check.spectral_radius, 1.0);
    }
}

TEST(HarmonicDesign, TenfoldGainsAreUnstable)
{
    for (const std::string &name : drives) {
        const sdre::Design   &d = design_of(name);
        nodo_harmonic_gains_t t = *d.harmonics->table;
        for (auto &row : t.gain) {
            for (auto &node : row) {
                for (float &g : node) {
                    g *= 10.0F;
                }
            }
        }
        const auto A =
            sdre::sampled_harmonic_model(d.l, d.l, t, d.nosc.gain[0], {300.0, 0.0, 0.0}, ts_of(d))
                .A;
        EXPECT_GT(sdre::spectral_radius(A), 1.0);
    }
}

TEST(HarmonicDesign, UnstableLoopIsRefused)
{
    sdre::Drive drive = design_of(drives[0]).drive;
    drive.nosc.Q[0] *= 1e6; // far faster than the period
    const sdre::Design d = sdre::design_drive(drive);
    EXPECT_TRUE(std::any_of(d.certificate.failures.begin(), d.certificate.failures.end(),
                            [](const std::string &line) {
                                return line.find("noc_h: the sampled loop is unstable at") == 0;
                            }));
}
