// SPDX-License-Identifier: MIT
// The current controller of torques, its loops in the certificate, and the least time of a torque step against a search.
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/motor_model.hpp"
#include "design/torque.hpp"
#include "design/torque_bound.hpp"
#include "shipped_drive.hpp"

namespace {

sdre::Drive shipped(const char *name = "ipmsm_390w")
{
    return sdre::read_drive_file(support::shipped_drive(name));
}

sdre::Drive with(const std::string &section, const char *name = "ipmsm_390w")
{
    std::string       text = sdre::read_text_file(support::shipped_drive(name));
    const std::size_t at   = text.find("\n[torque]");
    text                   = at == std::string::npos ? text : text.substr(0, at);
    return sdre::read_drive_text(text + section, "d.toml");
}

void expect_refused(const std::string &section, const char *name, const std::string &why)
{
    try {
        with(section, name);
        ADD_FAILURE() << section << " is taken";
    } catch (const sdre::InputError &e) {
        EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
}

/// Torque step that begins with any constant voltage, the best direction of many, by small steps of the motor's equations.
double searched_s(const sdre::Motor &m, const sdre::ReducedParameters &l, const sdre::TorqueStep &s)
{
    constexpr double h    = 1e-6;
    double           best = std::numeric_limits<double>::infinity();
    const double     aim  = s.from_Nm + s.share * (s.to_Nm - s.from_Nm);
    const double     sign = s.to_Nm < s.from_Nm ? -1.0 : 1.0;
    for (int k = 0; k < 360; k++) {
        const double a  = std::acos(-1.0) * k / 180.0;
        const double vd = s.voltage_V * std::cos(a);
        const double vq = s.voltage_V * std::sin(a);
        double       iq = sdre::mtpa_iq_A(m, l, std::abs(s.from_Nm), m.max_current_A);
        double       id = sdre::mtpa_id_A(l, iq);
        iq              = std::copysign(iq, s.from_Nm);
        for (double t = h; t < 0.02; t += h) {
            const double did =
                (vd - m.stator_resistance_Ohm * id + s.speed_e_radps * m.q_axis_inductance_H * iq) /
                m.d_axis_inductance_H;
            const double diq = (vq - m.stator_resistance_Ohm * iq -
                                s.speed_e_radps * (m.d_axis_inductance_H * id + m.pm_flux_Wb)) /
                               m.q_axis_inductance_H;
            id += h * did;
            iq += h * diq;
            if (sign * (sdre::torque_Nm(m, id, iq) - aim) >= 0.0) {
                best = std::min(best, t);
                break;
            }
        }
    }
    return best;
}

} // namespace

TEST(Torque, DefaultWeightsTakeAShareOfAnErrorInAPeriod)
{
    for (const char *name : {"ipmsm_390w", "ipmsm_390w_10khz"}) {
        const sdre::Drive             drive = shipped(name);
        const sdre::ReducedParameters l     = sdre::reduced_parameters(drive.motor);
        const Eigen::MatrixXd K  = sdre::solve_torque(l, drive, sdre::Precision::quick).gain[0];
        const double          ts = sdre::control_period_s(drive);
        EXPECT_NEAR(ts * (l[4] + l[6] * K(0, 0)), 0.15, 1e-9) << name;
        EXPECT_NEAR(ts * (l[7] + l[8] * K(1, 1)), 0.15, 1e-9) << name;
        EXPECT_EQ(K(0, 1), 0.0);
        EXPECT_EQ(K(1, 0), 0.0);
    }
}

TEST(Torque, WeightsOfTheFileGiveTheScalarRiccatiGain)
{
    const sdre::Drive             drive = with("\n[torque]\nQ = [2.0, 3.0]\nT = [0.01, 0.02]\n");
    const sdre::ReducedParameters l     = sdre::reduced_parameters(drive.motor);
    const Eigen::MatrixXd         K = sdre::solve_torque(l, drive, sdre::Precision::quick).gain[0];
    const auto                    gain = [](double a, double b, double q, double t) {
        return (std::sqrt(a * a + b * b * q / t) - a) / b;
    };
    EXPECT_NEAR(K(0, 0), gain(l[4], l[6], 2.0, 0.01), 1e-9);
    EXPECT_NEAR(K(1, 1), gain(l[7], l[8], 3.0, 0.02), 1e-9);
}

TEST(Torque, TheCertificateHasItsLoops)
{
    const sdre::Design good = sdre::design_drive(shipped());
    EXPECT_TRUE(good.certificate.passed());
    ASSERT_EQ(sdre::torque_gains(good).size(), 2U);
    EXPECT_TRUE(sdre::is_limited(sdre::torque_gains(good)[0]));
    EXPECT_FALSE(sdre::is_limited(sdre::torque_gains(good)[1]));
    EXPECT_TRUE(good.config.torques);
    // three times the share of an error in a period: not with half of the inductances
    const sdre::Design hard =
        sdre::design_drive(with("\n[torque]\nQ = [1.2e5, 5.2e4]\nT = [1.0, 1.0]\n"));
    EXPECT_FALSE(hard.certificate.passed());
    const sdre::Design none = sdre::design_drive(with(""));
    EXPECT_TRUE(none.certificate.passed());
    EXPECT_TRUE(sdre::torque_gains(none).empty());
    EXPECT_FALSE(none.config.torques);
}

TEST(Torque, FilesThatCannotBeAreRefused)
{
    expect_refused("\n[torque]\n", "ipmsm_390w_speed", "only pi_foc, and noc");
    expect_refused("\n[torque]\n", "ipmsm_390w_noc_h", "only pi_foc, and noc");
    expect_refused("\n[torque]\n", "ipmsm_390w_ladrc", "only pi_foc, and noc");
    expect_refused("\n[torque]\nQ = [1.0, 1.0]\n", "ipmsm_390w_pi_foc", "Q");
    expect_refused("\n[torque]\nQ = [1.0, 1.0]\n", "ipmsm_390w", "T");
    expect_refused("\n[torque]\nQ = [0.0, 1.0]\nT = [1.0, 1.0]\n", "ipmsm_390w", "Q");
    expect_refused("\n[torque]\nP = 1.0\n", "ipmsm_390w", "P");
}

TEST(TorqueBound, IsTheTimeOfAnInductorAtRest)
{
    sdre::Motor m                      = shipped().motor;
    m.stator_resistance_Ohm            = 1e-6;
    m.d_axis_inductance_H              = m.q_axis_inductance_H; // no reluctance torque
    const sdre::ReducedParameters l    = sdre::reduced_parameters(m);
    const double                  to   = 1.0;
    const double                  iq_A = to / (1.5 * m.pole_pairs * m.pm_flux_Wb);
    EXPECT_NEAR(sdre::least_torque_time_s(m, l, {0.0, 0.0, to, 170.0, 0.9}),
                0.9 * iq_A * m.q_axis_inductance_H / 170.0, 4e-6);
}

TEST(TorqueBound, NoConstantVoltageIsFasterAndTheBestIsClose)
{
    const sdre::Motor             m = shipped().motor;
    const sdre::ReducedParameters l = sdre::reduced_parameters(m);
    for (const double speed : {0.0, 260.0, 520.0}) {
        for (const auto &[from, to] : {std::pair{0.0, 0.15}, {0.0, 1.5}, {1.5, 0.0}, {1.0, -1.0}}) {
            const sdre::TorqueStep s{speed, from, to, 170.0, 0.9};
            const double           bound = sdre::least_torque_time_s(m, l, s);
            const double           found = searched_s(m, l, s);
            EXPECT_LE(bound, found + 4e-6) << speed << " " << from << " " << to;
            EXPECT_GE(bound, 0.93 * found - 4e-6) << speed << " " << from << " " << to;
        }
    }
}

TEST(TorqueBound, ATorqueOutOfReachIsNoNumber)
{
    const sdre::Motor m = shipped().motor;
    EXPECT_TRUE(std::isnan(
        sdre::least_torque_time_s(m, sdre::reduced_parameters(m), {0.0, 0.0, 1.5, 1.0, 0.9})));
}
