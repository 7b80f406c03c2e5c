// SPDX-License-Identifier: MIT
/// The map of a machine's iron is compared with a machine in closed form. So are its table in a drive file and the curve of least
/// current.
#include "drive/flux_map.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "drive/drive_file.hpp"
#include "drive/mtpa_fit.hpp"
#include "iron.hpp"
#include "shipped_drive.hpp"
#include "temp_dir.hpp"

namespace {

using sdre::FluxAt;
using sdre::FluxMap;
using support::Iron;

const std::vector<double> id_axis = support::even_axis(-4.5, 0.75, 9);
const std::vector<double> iq_axis = support::even_axis(0.0, 0.5, 10);

std::vector<double> psi_d(const Iron &iron)
{
    return support::psi_d(iron, id_axis, iq_axis);
}

std::vector<double> psi_q(const Iron &iron)
{
    return support::psi_q(iron, id_axis, iq_axis);
}

std::shared_ptr<const FluxMap> map_of(const Iron &iron)
{
    return std::make_shared<const FluxMap>(id_axis, iq_axis, psi_d(iron), psi_q(iron));
}

struct Table {
    std::string id   = support::listed(id_axis);
    std::string iq   = support::listed(iq_axis);
    std::string more = fmt::format("psi_d_Wb = {}\npsi_q_Wb = {}\n", support::listed(psi_d({})),
                                   support::listed(psi_q({})));

    std::string text() const
    {
        return fmt::format("\n[saturation]\nid_A = {}\niq_A = {}\n{}", id, iq, more);
    }
};

sdre::Drive drive_with(const Table &t)
{
    return sdre::read_drive_text(support::read_file(support::shipped_drive("ipmsm_390w")) +
                                     t.text(),
                                 "drive.toml", support::shipped_drive("ipmsm_390w").string());
}

/// One line that has this in it.
void expect_refused(const Table &t, const std::string &piece)
{
    try {
        drive_with(t);
        ADD_FAILURE() << "accepted; expected: " << piece;
    } catch (const sdre::InputError &e) {
        const std::string what = e.what();
        EXPECT_NE(what.find(piece), std::string::npos) << what;
        EXPECT_EQ(what.rfind("drive.toml: [saturation] ", 0), 0U) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
}

Table with_fluxes(const std::vector<double> &d, const std::vector<double> &q)
{
    Table t;
    t.more = fmt::format("psi_d_Wb = {}\npsi_q_Wb = {}\n", support::listed(d), support::listed(q));
    return t;
}

} // namespace

TEST(FluxMap, IsTheMachineBetweenItsPointsToo)
{
    const Iron iron;
    const auto map = map_of(iron);
    for (double d = -4.4; d < 1.5; d += 0.31) {
        for (double q = -4.4; q < 4.5; q += 0.37) {
            const FluxAt f = map->at(d, q);
            ASSERT_NEAR(f.d_Wb, iron.psi_d(d, q), 2e-4) << d << " " << q;
            ASSERT_NEAR(f.q_Wb, iron.psi_q(d, q), 4e-4) << d << " " << q;
        }
    }
    EXPECT_NEAR(map->magnet_Wb(), 0.193, 1e-4);
    for (const double d : id_axis) { // a point is exact
        EXPECT_NEAR(map->at(d, -2.5).q_Wb, -iron.psi_q(d, 2.5), 1e-15);
    }
}

TEST(FluxMap, SlopesAreTheDerivatives)
{
    const Iron       iron;
    const auto       map = map_of(iron);
    constexpr double h   = 1e-5;
    for (double d = -4.3; d < 1.5; d += 0.41) {
        for (double q = -4.2; q < 4.3; q += 0.43) {
            const FluxAt f    = map->at(d, q);
            const auto   by_d = [&](double FluxAt::*x) {
                return (map->at(d + h, q).*x - map->at(d - h, q).*x) / (2.0 * h);
            };
            const auto by_q = [&](double FluxAt::*x) {
                return (map->at(d, q + h).*x - map->at(d, q - h).*x) / (2.0 * h);
            };
            ASSERT_NEAR(f.dd_H, by_d(&FluxAt::d_Wb), 1e-6);
            ASSERT_NEAR(f.dq_H, by_q(&FluxAt::d_Wb), 1e-6);
            ASSERT_NEAR(f.qd_H, by_d(&FluxAt::q_Wb), 1e-6);
            ASSERT_NEAR(f.qq_H, by_q(&FluxAt::q_Wb), 1e-6);
        }
    }
    const FluxAt edge = map->at(-4.5, 4.5); // beyond, its slopes hold
    const FluxAt out  = map->at(-5.5, 6.5);
    EXPECT_NEAR(out.d_Wb, edge.d_Wb - edge.dd_H + 2.0 * edge.dq_H, 1e-12);
    EXPECT_NEAR(out.q_Wb, edge.q_Wb - edge.qd_H + 2.0 * edge.qq_H, 1e-12);
}

TEST(FluxMap, AnotherMachineKeepsItsInductancesAndItsEnergy)
{
    const auto                 map = map_of({});
    const FluxAt               own = map->at(0.0, 0.0);
    const sdre::SaturatedMotor other(map, {0.9, 1.3, 0.8});
    const FluxAt               f = other.at(0.0, 0.0);
    EXPECT_NEAR(f.d_Wb, 0.9 * own.d_Wb, 1e-15);
    EXPECT_NEAR(f.dd_H, 1.3 * own.dd_H, 1e-15);
    EXPECT_NEAR(f.qq_H, 0.8 * own.qq_H, 1e-15);
    for (const double q : {0.7, 2.1, 3.3}) { // reciprocal where the map is
        const FluxAt there = other.at(-1.0, q);
        EXPECT_NEAR(there.dq_H, there.qd_H, 2e-3);
        EXPECT_LT(there.dq_H, -1e-3);
    }
    const sdre::SaturatedMotor same = other.scaled({1.0 / 0.9, 1.0 / 1.3, 1.0 / 0.8});
    EXPECT_NEAR(same.at(-1.3, 2.2).q_Wb, map->at(-1.3, 2.2).q_Wb, 1e-12);
}

TEST(FluxMap, CurrentsOfAFluxRate)
{
    const FluxAt f  = map_of({})->at(-1.0, 2.0);
    const auto   di = sdre::by_inductance(f, 0.3, -0.7);
    EXPECT_NEAR(f.dd_H * di[0] + f.dq_H * di[1], 0.3, 1e-12);
    EXPECT_NEAR(f.qd_H * di[0] + f.qq_H * di[1], -0.7, 1e-12);
}

TEST(Saturation, FluxesAndInductancesAreTheSameMap)
{
    const Iron iron;
    Table      t;
    const auto fluxes = drive_with(t).saturation;
    // Without cross saturation of the magnet: psi_d = magnet + L_d(i_d) i_d, psi_q = L_q(i_q) i_q.
    const auto ld = support::over(id_axis, iq_axis,
                                  [](double d, double) { return 0.07 / (1.0 + 0.02 * d * d); });
    const auto lq = support::over(id_axis, iq_axis,
                                  [](double, double q) { return 0.11 / (1.0 + 0.02 * q * q); });
    t.more        = fmt::format("ld_H = {}\nlq_H = {}\n", support::listed(ld), support::listed(lq));
    const auto inductances = drive_with(t).saturation;
    EXPECT_NEAR(fluxes->at(-1.5, 2.0).d_Wb, iron.psi_d(-1.5, 2.0), 1e-9);
    EXPECT_NEAR(inductances->at(-1.5, 2.0).d_Wb, 0.193 - 1.5 * 0.07 / (1.0 + 0.02 * 2.25), 1e-12);
    EXPECT_NEAR(inductances->at(-1.5, 2.0).q_Wb, 2.0 * 0.11 / 1.08, 1e-12);
    EXPECT_FALSE(sdre::read_drive_file(support::shipped_drive("ipmsm_390w")).saturation);
}

TEST(Saturation, WhatNoIronCanBeIsRefusedInOneLine)
{
    Table t;
    t.iq = "[0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5]";
    expect_refused(t, "iq_A begins with 0.5, which is not allowed: must begin with 0");
    t.iq = "[0, 1, 1, 2, 2.5, 3, 3.5, 4, 4.5, 5]";
    expect_refused(t, "iq_A = [.. 1, 1 ..] is not allowed: must increase");
    t.iq = support::listed(support::even_axis(0.0, 0.4, 10));
    expect_refused(
        t, "iq_A ends with 3.6, which is not allowed: must reach [motor] max_current_A = 4");
    t    = {};
    t.id = support::listed(support::even_axis(-3.0, 0.75, 9));
    expect_refused(t, "id_A = -3 .. 3 is not allowed: must reach from -4");
    t = {};
    t.more += "ld_H = [1.0]\n";
    expect_refused(t, "ld_H is not allowed beside psi_d_Wb");
    t = {};
    t.more += "psi_x_Wb = [1.0]\n";
    expect_refused(t, "psi_x_Wb");
    t.more = "psi_d_Wb = [0.1, 0.2]\npsi_q_Wb = [0.1, 0.2]\n";
    expect_refused(t, "psi_d_Wb must be an array of 90 numbers");

    auto q = psi_q({});
    q[10]  = 0.1;
    expect_refused(with_fluxes(psi_d({}), q), "psi_q_Wb [10] = 0.1 is not allowed: must be 0");
    q     = psi_q({});
    q[25] = 0.05;
    expect_refused(with_fluxes(psi_d({}), q), "the q flux does not rise with iq");
    auto d = psi_d({});
    d[42]  = -0.2;
    expect_refused(with_fluxes(d, psi_q({})), "the d flux does not rise with id");
    d = psi_d({});
    for (double &x : d) {
        x += 0.1;
    }
    expect_refused(with_fluxes(d, psi_q({})), "must be near [motor] pm_flux_Wb = 0.193");
}

TEST(Saturation, CrossTermsHaveToAgree)
{
    // The d flux of a machine without cross saturation, and the q flux of one with it.
    Iron strong;
    strong.b = 0.45;
    auto plain =
        support::over(id_axis, iq_axis, [&](double d, double) { return strong.psi_d(d, 0.0); });
    expect_refused(with_fluxes(plain, psi_q(strong)), "does not fit psi_d_Wb: at id = ");
    EXPECT_NO_THROW(drive_with(with_fluxes(psi_d(strong), psi_q(strong))));
}

TEST(Saturation, DigestHasTheMap)
{
    const sdre::Drive plain = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    Iron              strong;
    strong.b          = 0.4;
    const auto digest = sdre::drive_digest(drive_with({}));
    EXPECT_NE(digest, sdre::drive_digest(plain));
    EXPECT_NE(digest, sdre::drive_digest(drive_with(with_fluxes(psi_d(strong), psi_q(strong)))));
    EXPECT_EQ(digest, sdre::drive_digest(drive_with({})));
}

/// The least current for a torque, by brute force over both currents of the closed form.
double least_current_A(const Iron &iron, double torque_Nm)
{
    double best = 1e9;
    for (double angle = 0.0; angle < 1.3; angle += 1e-3) {
        double lo = 0.0;
        double hi = 4.5;
        for (int i = 0; i < 50; i++) {
            const double r            = 0.5 * (lo + hi);
            const double d            = -r * std::sin(angle);
            const double q            = r * std::cos(angle);
            const double T            = 3.0 * (iron.psi_d(d, q) * q - iron.psi_q(d, q) * d);
            (T < torque_Nm ? lo : hi) = r;
        }
        best = std::min(best, hi);
    }
    return best;
}

/// The current on id = f(iq) for a torque.
template <typename Curve>
double current_on_A(const Iron &iron, double torque_Nm, const Curve &id_of)
{
    double lo = 0.0;
    double hi = 4.5;
    for (int i = 0; i < 50; i++) {
        const double q            = 0.5 * (lo + hi);
        const double d            = id_of(q);
        const double T            = 3.0 * (iron.psi_d(d, q) * q - iron.psi_q(d, q) * d);
        (T < torque_Nm ? lo : hi) = q;
    }
    return std::hypot(hi, id_of(hi));
}

TEST(Saturation, FittedCurveTakesHardlyMoreThanTheLeastCurrent)
{
    Iron iron;
    iron.b                  = 0.45;
    const sdre::Drive drive = drive_with(with_fluxes(psi_d(iron), psi_q(iron)));
    ASSERT_GT(drive.motor.mtpa.k_A, 0.0);
    EXPECT_TRUE(drive.motor.mtpa.second_order); // nearer than the curve of constants
    const double k = drive.motor.pm_flux_Wb /
                     (2.0 * (drive.motor.q_axis_inductance_H - drive.motor.d_axis_inductance_H));
    const auto fitted = [&](double q) { return -0.5 * q * q / drive.motor.mtpa.k_A; };
    const auto plain  = [&](double q) { return k - std::hypot(k, q); };
    double     most   = 0.0;
    for (const double torque : {0.75, 1.5, 2.2}) {
        const double least = least_current_A(iron, torque);
        most               = std::max(most, current_on_A(iron, torque, plain) / least - 1.0);
        EXPECT_LT(current_on_A(iron, torque, fitted), 1.001 * least) << torque;
    }
    EXPECT_GT(most, 0.01);
}

TEST(Saturation, LinearMachineKeepsItsCurve)
{
    Iron linear;
    linear.b                = 0.0;
    const sdre::Drive drive = drive_with(with_fluxes(psi_d(linear), psi_q(linear)));
    EXPECT_FALSE(drive.motor.mtpa.second_order);
    EXPECT_NEAR(drive.motor.mtpa.k_A, 0.193 / (2.0 * (0.11391 - 0.07498)), 0.01);
}
