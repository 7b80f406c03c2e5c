// SPDX-License-Identifier: MIT
// Paper B's observer and its sampled loops (EQ-DOBC-4 to 7, EQ-CERT-4) against reference numbers and their own properties.
#include "design/servo/dobc_design.hpp"
#include "design/servo/servo_loop.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "linear.hpp"
#include "reference_gains.hpp"

namespace {

using support::Json;

constexpr double ts_s = 1e-4;

sdre::Drive shipped(const std::string &law)
{
    return sdre::read_drive_file(support::shipped_drive("servo_200w_" + law));
}

/// CDOBC with one polynomial state, the other published design.
sdre::Drive constant_load()
{
    sdre::Drive d                 = shipped("cdobc");
    d.dobc.polynomial_order       = 1;
    d.dobc.controller_pole_1ps    = 800.0;
    d.dobc.observer_pole_1ps      = 2500.0;
    d.dobc.oscillator_damping_1ps = 30.0;
    return d;
}

sdre::DobcDesign designed(const sdre::Drive &d)
{
    return sdre::design_dobc(d.motor, d.dobc, ts_s);
}

/// The printed poles with the harmonics or the polynomial left out.
sdre::DobcDesign printed(std::vector<double> harmonics, int polynomial_order)
{
    sdre::Drive d             = shipped("cdobc_printed");
    d.dobc.harmonics_per_turn = std::move(harmonics);
    d.dobc.polynomial_order   = polynomial_order;
    return designed(d);
}

void expect_relative(const std::vector<double> &expected, const Eigen::VectorXd &found,
                     double tolerance)
{
    ASSERT_EQ(static_cast<std::size_t>(found.size()), expected.size());
    for (std::size_t i = 0; i < expected.size(); i++) {
        const double x = found(static_cast<Eigen::Index>(i));
        EXPECT_NEAR(x, expected[i], tolerance * std::abs(expected[i])) << i;
    }
}

void expect_vector_file(const std::string &file, const sdre::DobcDesign &d)
{
    const Json       r = Json::read(std::string(SDRE_TEST_DATA_DIR) + "/cdobc/" + file + ".json");
    constexpr double tolerance = 1e-9;
    const auto       vector    = [&](const char *key) { return r.at(key).numbers(); };
    expect_relative(vector("l"), d.l, tolerance);
    expect_relative(vector("E"), d.E, tolerance);
    expect_relative(vector("H"), d.H, tolerance);
    expect_relative(vector("K"), d.K.transpose(), tolerance);
    expect_relative(vector("g"), d.g, tolerance);
    expect_relative(vector("h"), d.h, tolerance);
    EXPECT_NEAR(d.k1 / r.at("k1").number(), 1.0, tolerance);
    EXPECT_NEAR(d.k2 / r.at("k2").number(), 1.0, tolerance);
    for (Eigen::Index i = 0; i < d.M.rows(); i++) {
        const auto row = static_cast<std::size_t>(i);
        expect_relative(r.at("M").at(row).numbers(), d.M.row(i).transpose(), tolerance);
        expect_relative(r.at("F").at(row).numbers(), d.F.row(i).transpose(), tolerance);
    }
}

const sdre::LoopCheck &speed_channel(const sdre::Design &d)
{
    return d.certificate.loop->channels.front().worst;
}

double peak(const sdre::Drive &d)
{
    return speed_channel(sdre::design_drive(d)).peak;
}

double at(const sdre::LoopCheck &loop, const std::string &name)
{
    for (const sdre::SensitivityAt &x : loop.at) {
        if (x.name == name) {
            return x.value;
        }
    }
    ADD_FAILURE() << "no " << name;
    return NAN;
}

} // namespace

TEST(DobcDesign, PlantOfPaperB)
{
    const sdre::ServoPlant p = sdre::servo_plant(shipped("cdobc").motor);

    EXPECT_NEAR(p.kt_NmpA, 0.504, 1e-12);
    EXPECT_NEAR(p.b, 3733.3333333, 1e-6);
    EXPECT_NEAR(p.a, 373.6250712, 1e-6);
}

TEST(DobcDesign, PrintedPolesGiveTheirGains)
{
    expect_relative({-666.374929, -270400.0}, printed({}, 1).l, 1e-6);
    expect_relative({-1186.375, -811200.0, -1.40608e8}, printed({}, 2).l, 1e-6);
    expect_relative({-2226.375, 1.148601e6, -3.501967e9, 5.338896e5, 1.350076e10},
                    printed({24.0, 32.0}, 0).l, 1e-6);
    const sdre::DobcDesign d = designed(shipped("cdobc_printed"));
    expect_relative({-2746.375, 2.301777e6, -2.904694e9, -1.966827e6, 1.377839e10, -4459.674}, d.l,
                    1e-6);
    EXPECT_NEAR(d.k1 / 0.278571429, 1.0, 1e-6);
    EXPECT_NEAR(d.k2 / 0.685748148, 1.0, 1e-6);
    EXPECT_EQ(d.K(1), 0.026); // L alone: no lead
    EXPECT_EQ(d.K(2), 0.0);
}

TEST(DobcDesign, SampledRecursionMatchesItsReference)
{
    expect_vector_file("cdo_N2_100us", designed(shipped("cdobc")));
    expect_vector_file("cdo_N1_100us", designed(constant_load()));
}

TEST(DobcDesign, MatchedCoefficientsAreRecovered)
{
    for (const char *law : {"cdobc", "cdobc_printed", "gpiobc", "hdobc"}) {
        EXPECT_LE(designed(shipped(law)).matching_error, 1e-9) << law;
    }
    EXPECT_LE(designed(constant_load()).matching_error, 1e-9);
}

/// Not through the tool's own polynomials: the eigenvalues of F. A multiple pole p of order m spreads by eps^(1/m) p, so
/// each wanted pole is checked by det(sI - F) at points around it instead.
TEST(DobcDesign, DeterminantIsTheWantedPolynomial)
{
    for (const char *law : {"cdobc", "gpiobc", "hdobc"}) {
        const sdre::DobcDesign d = designed(shipped(law));
        const Eigen::Index     n = d.F.rows();
        for (const double s : {-4000.0, -1000.0, 300.0, 2500.0}) {
            long double wanted = 0.0L;
            for (const double c : d.wanted) {
                wanted = wanted * static_cast<long double>(s) + static_cast<long double>(c);
            }
            const support::LongMatrix Z =
                static_cast<long double>(s) * support::LongMatrix::Identity(n, n) -
                d.F.cast<long double>();
            EXPECT_NEAR(static_cast<double>(support::determinant(Z) / wanted), 1.0, 1e-8)
                << law << s;
        }
    }
}

TEST(ServoLoop, RepairedDesignsHaveTheirPeak)
{
    EXPECT_NEAR(peak(shipped("cdobc")), 2.55, 0.03 * 2.55);
    EXPECT_NEAR(peak(constant_load()), 1.93, 0.03 * 1.93);
    EXPECT_NEAR(peak(shipped("gpiobc")), 2.30, 0.03 * 2.30);
    EXPECT_NEAR(peak(shipped("hdobc")), 1.32, 0.03 * 1.32);
}

TEST(ServoLoop, RepairedDesignNotchesItsHarmonics)
{
    const sdre::Design d = sdre::design_drive(shipped("cdobc"));

    EXPECT_TRUE(d.certificate.passed());
    EXPECT_LE(at(speed_channel(d), "dead time"), 0.002);
    EXPECT_LE(at(speed_channel(d), "harmonic 32"), 0.002);
    EXPECT_LT(speed_channel(d).spectral_radius, 1.0);
}

/// Effect of the half sample of lead.
TEST(ServoLoop, WithoutLeadTheNotchesAreShallow)
{
    const sdre::Drive  drive  = shipped("cdobc");
    const sdre::Design design = sdre::design_drive(drive);
    const auto        *solved = sdre::constants_of<law_dobc_config_t>(design.config);
    ASSERT_TRUE(solved != nullptr);
    law_dobc_config_t constants = *solved;
    drive_config_t    config    = design.config;
    sdre::set_law(config, constants);
    for (const int i : {1, 3}) {
        constants.dobc.k_x[i]     = 0.026F;
        constants.dobc.k_x[i + 1] = 0.0F;
    }
    const sdre::BrokenLoop loop = sdre::speed_loop(drive.motor, config);

    EXPECT_NEAR(sdre::sensitivity(loop, 200.0), 0.055, 0.05 * 0.055);
    EXPECT_NEAR(sdre::sensitivity(loop, 800.0 / 3.0), 0.080, 0.05 * 0.080);
}

TEST(ServoLoop, PrintedDesignIsRejected)
{
    const sdre::Design d = sdre::design_drive(shipped("cdobc_printed"));

    EXPECT_NEAR(speed_channel(d).peak, 122.0, 0.05 * 122.0);
    ASSERT_EQ(d.certificate.failures.size(), 1U);
    EXPECT_NE(d.certificate.failures[0].find("sensitivity peak 122"), std::string::npos);
}

/// A law on the d axis alone, by hand: k / (z - 1 + ..) of a first-order plant one period late.
TEST(ServoLoop, DAxisAgreesWithItsTransferFunction)
{
    const sdre::Drive      d      = shipped("pid");
    const sdre::Design     design = sdre::design_drive(d);
    const sdre::BrokenLoop loop   = sdre::d_axis_loop(d.motor, design.config);
    const double           pole   = std::exp(-9.7 / 0.026 * ts_s);
    for (const double f : {10.0, 200.0, 1400.0, 4000.0}) {
        const std::complex<double> z     = std::polar(1.0, 2.0 * std::acos(-1.0) * f * ts_s);
        const std::complex<double> plant = (1.0 - pole) / 9.7 / (z - pole);
        const std::complex<double> pi    = 120.0 + 240.0 * ts_s / (z - 1.0);
        EXPECT_NEAR(sdre::sensitivity(loop, f), 1.0 / std::abs(1.0 + pi * plant / z), 1e-6) << f;
    }
}

/// The same of the speed: kp + kd (1 - 1/z) + ki / (z - 1) of paper B's motor, by its data sheet, one period late.
TEST(ServoLoop, SpeedLoopOfThePidAgreesWithItsTransferFunction)
{
    const sdre::Drive      d      = shipped("pid");
    const sdre::Design     design = sdre::design_drive(d);
    const sdre::BrokenLoop loop   = sdre::speed_loop(d.motor, design.config);
    const pid_law_config_t c      = sdre::constants_of<law_pid_config_t>(design.config)->pid;

    // Electrical speed and current, i' with the EMF against the voltage; a held voltage, by eigenvalues.
    Eigen::Matrix2d A;
    A << -7.4e-5 / 0.000135, 4.0 * 1.5 * 4.0 * 0.084 / 0.000135, -0.084 / 0.026, -9.7 / 0.026;
    const Eigen::Vector2d   B(0.0, 1.0 / 0.026);
    const support::Modes    modes = support::modes_of(A);
    const Eigen::MatrixXcd &V     = modes.vectors;
    const Eigen::Vector2cd  in    = support::inverse(V) * B.cast<std::complex<double>>();
    const auto              plant = [&](std::complex<double> z) {
        std::complex<double> sum = 0.0;
        for (int k = 0; k < 2; k++) {
            const std::complex<double> s = modes.values(k);
            const std::complex<double> e = std::exp(s * ts_s);
            sum += V(0, k) * (e - 1.0) / s * in(k) / (z - e);
        }
        return sum;
    };
    for (const double f : {3.0, 50.0, 300.0, 1400.0, 4000.0}) {
        const std::complex<double> z   = std::polar(1.0, 2.0 * std::acos(-1.0) * f * ts_s);
        const std::complex<double> pid = static_cast<double>(c.kp) +
                                         static_cast<double>(c.kd_tick) * (1.0 - 1.0 / z) +
                                         static_cast<double>(c.ki_per_tick) / (z - 1.0);
        const double wanted = 1.0 / std::abs(1.0 + pid * plant(z) / z);
        EXPECT_NEAR(sdre::sensitivity(loop, f) / wanted, 1.0, 1e-6) << f;
    }
}

TEST(ServoLoop, SlowSamplingIsRefused)
{
    sdre::Drive d                 = shipped("cdobc");
    d.inverter.updates_per_period = 1;

    EXPECT_FALSE(sdre::design_drive(d).certificate.passed());
}
