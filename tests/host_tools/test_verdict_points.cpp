// SPDX-License-Identifier: MIT
/// Where the verdict looks: operating points against a search by definition.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "design/design.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/verdict.hpp"
#include "shipped_drive.hpp"

namespace {

using sdre::Design;
using sdre::Motor;
using sdre::OperatingPoint;

const double two_pi = 2.0 * std::acos(-1.0);

Design design_of(const std::string &name)
{
    return sdre::design_drive(sdre::read_drive_file(support::shipped_drive(name)));
}

const Design &salient()
{
    static const Design d = design_of("ipmsm_390w");
    return d;
}

/// L_d = L_q: MTPA has no d current.
const Design &round()
{
    static const Design d = design_of("servo_200w");
    return d;
}

/// The d current of the least current for the torque of this q current: the torque's gradient is that of the current.
double least_current_id_A(const Motor &m, double iq_A)
{
    const double torque = m.pm_flux_Wb * iq_A;
    double       lo = -2.0 * m.max_current_A, hi = 0.0; // d(i^2)/d(torque) changes its sign there
    const double dL     = m.d_axis_inductance_H - m.q_axis_inductance_H;
    const auto   beyond = [&](double id) {
        return id * (m.pm_flux_Wb + dL * id) - dL * iq_A * iq_A > 0.0;
    };
    for (int k = 0; k < 80 && torque != 0.0; k++) {
        const double middle        = 0.5 * (lo + hi);
        (beyond(middle) ? hi : lo) = middle;
    }
    return torque == 0.0 ? 0.0 : 0.5 * (lo + hi);
}

bool voltage_holds(const Design &d, const OperatingPoint &at)
{
    const Motor &m = d.drive.motor;
    const double flux =
        std::hypot(m.pm_flux_Wb + m.d_axis_inductance_H * at.id_A, m.q_axis_inductance_H * at.iq_A);
    return std::abs(at.omega_e_radps) * flux <= d.drive.inverter.dc_link_V / std::sqrt(3.0) + 1e-9;
}

constexpr double grid_A = 1e-3;

/// The least field weakening that voltage and current limit allow with this q current, by trying every d current.
std::optional<double> id_by_search(const Design &d, double speed, double iq_A)
{
    const double mtpa = least_current_id_A(d.drive.motor, iq_A);
    for (int k = 0; k <= static_cast<int>(2.0 * d.drive.motor.max_current_A / grid_A); k++) {
        const double id = mtpa - k * grid_A;
        if (voltage_holds(d, {speed, iq_A, id}) &&
            std::hypot(id, iq_A) <= 1.001 * d.drive.motor.max_current_A) {
            return id;
        }
    }
    return std::nullopt;
}

/// Everywhere: no q current is given away that could be had, and no d current is spent for nothing.
void expect_held_points(const Design &d)
{
    const double most = d.drive.motor.max_current_A;
    const double top  = d.drive.motor.rated_speed_e_radps;
    int          free = 0, weakened = 0, reduced = 0;
    for (double speed = -2.5 * top; speed <= 2.51 * top; speed += 0.25 * top) {
        for (const double iq : {0.0, 0.3 * most, most, -0.7 * most, -most}) {
            const OperatingPoint at = sdre::held_point(d, speed, iq);
            const auto           id = id_by_search(d, speed, at.iq_A);
            ASSERT_TRUE(id.has_value()) << speed << " " << iq;
            EXPECT_EQ(at.omega_e_radps, speed);
            EXPECT_NEAR(at.id_A, *id, 1.1 * grid_A) << speed << " " << iq;
            EXPECT_GE(at.iq_A * iq, 0.0);
            const double share = iq == 0.0 ? 1.0 : at.iq_A / iq;
            if (share < 0.999) { // a fiftieth more is too much
                EXPECT_FALSE(id_by_search(d, speed, (share + 0.02) * iq)) << speed << " " << iq;
            }
            const bool weak = at.id_A < least_current_id_A(d.drive.motor, at.iq_A) - grid_A;
            free += !weak && share == 1.0 ? 1 : 0;
            weakened += weak ? 1 : 0;
            reduced += share < 0.999 ? 1 : 0;
        }
    }
    EXPECT_GT(free, 20);
    EXPECT_GT(weakened, 20);
    EXPECT_GT(reduced, 20);
}

} // namespace

TEST(HeldPoint, IsTheBestThatASearchFinds)
{
    expect_held_points(salient());
    expect_held_points(round());
}

TEST(HeldPoint, HoldsTheWholeCurrentLimitAndNoMore)
{
    const double         most = 1.001 * round().drive.motor.max_current_A;
    const OperatingPoint at   = sdre::held_point(round(), 0.0, most);
    EXPECT_EQ(at.iq_A, most);
    EXPECT_NEAR(at.id_A, 0.0, 1e-7);
    const double beyond = most * (1.0 + 1e-12);
    EXPECT_NEAR(sdre::held_point(round(), 0.0, beyond).iq_A, 0.98 * beyond, 1e-12);
}

/// Beyond every speed: no torque, and the d current that comes nearest to the voltage limit.
TEST(HeldPoint, OfASpeedThatCannotBeHeldHasNoTorque)
{
    for (const Design *d : {&salient(), &round()}) {
        const Motor &m = d->drive.motor;
        for (const double factor : {100.0, -100.0}) {
            const double         speed = factor * m.rated_speed_e_radps;
            const OperatingPoint at    = sdre::held_point(*d, speed, m.max_current_A);
            EXPECT_EQ(at.omega_e_radps, speed);
            EXPECT_EQ(at.iq_A, 0.0);
            const double flux = d->drive.inverter.dc_link_V / std::sqrt(3.0) / std::abs(speed);
            EXPECT_NEAR(at.id_A,
                        std::max((flux - m.pm_flux_Wb) / m.d_axis_inductance_H, -m.max_current_A),
                        1e-12);
        }
    }
}

TEST(VerdictPoints, AreStandstillRatedAndLargestSpeedWithEachCurrent)
{
    for (const Design *d : {&salient(), &round()}) {
        const auto   points = sdre::verdict_points(*d);
        const double most   = d->drive.motor.max_current_A;
        ASSERT_EQ(points.size(), 9U);
        std::size_t k = 0;
        for (const double speed : {0.0, d->drive.motor.rated_speed_e_radps,
                                   static_cast<double>(d->config.speed_max_e_radps)}) {
            for (const double iq : {0.0, most, -most}) {
                EXPECT_EQ(points[k].omega_e_radps, speed);
                EXPECT_EQ(points[k].iq_A > 0.0, iq > 0.0);
                EXPECT_EQ(points[k].iq_A < 0.0, iq < 0.0);
                EXPECT_NEAR(points[k].id_A, *id_by_search(*d, speed, points[k].iq_A), 1.1 * grid_A);
                k++;
            }
        }
    }
}

TEST(VerdictPoints, OfOtherMotorsAreEightCountsAPeriodAndTheRatedSpeed)
{
    for (const Design *d : {&salient(), &round()}) {
        const auto  &drive  = d->drive;
        const auto   points = sdre::verdict_box_points(*d);
        const double ts_s =
            1.0 / (drive.inverter.pwm_frequency_Hz * drive.inverter.updates_per_period);
        ASSERT_EQ(points.size(), 2U);
        EXPECT_NEAR(points[0].omega_e_radps,
                    8.0 * two_pi * drive.motor.pole_pairs / (4.0 * drive.encoder.lines) / ts_s,
                    1e-9);
        EXPECT_EQ(points[0].iq_A, 0.0);
        EXPECT_EQ(points[0].id_A, 0.0); // no torque: no current at all
        EXPECT_EQ(points[1].omega_e_radps, drive.motor.rated_speed_e_radps);
        EXPECT_GT(points[1].iq_A, 0.5 * drive.motor.max_current_A);
    }
}

namespace {

/// The loop of `noc` with its references, as the verdict has it.
sdre::SampledModel loop_at(const Design &d, const sdre::TrueMotor &motor, const OperatingPoint &at,
                           const Eigen::MatrixXd &Lambda, const sdre::MovingReference *moving)
{
    return sdre::sampled_model(motor, d.l, sdre::encoder_form_gains(d, at.iq_A, Lambda), at,
                               sdre::control_period_s(d.drive), moving);
}

/// Every point by the fine sweep: the verdict refines only those with the worst rough peaks.
void expect_no_worse_point(const std::string &name)
{
    Design d          = design_of(name);
    d.precision       = sdre::Precision::extended; // has the plane
    const auto family = sdre::whole_loop(d, *sdre::current_references(d), loop_at);
    ASSERT_EQ(family.plane.size(), 1681U);
    const sdre::Verdict verdict = sdre::examine(family, d.drive);

    std::vector<double> peaks(family.plane.size() * 2, 0.0);
    std::vector<double> radii(family.plane.size(), 0.0);
    sdre::parallel_for(family.plane.size(), [&](std::size_t i) {
        const auto loops = family.loops(d.drive.motor, family.plane[i]);
        for (std::size_t k = 0; k < loops.size(); k++) {
            const sdre::LoopCheck found = sdre::check_loop(loops[k], {});
            peaks[2 * i + k % 2]        = std::max(peaks[2 * i + k % 2], found.peak);
            radii[i]                    = std::max(radii[i], found.spectral_radius);
        }
    });
    for (std::size_t i = 0; i < radii.size(); i++) {
        const OperatingPoint &at = family.plane[i];
        EXPECT_LT(radii[i], std::exp(-sdre::control_period_s(d.drive) / sdre::slowest_mode_s))
            << name << " at " << at.omega_e_radps << " rad/s, " << at.iq_A << " A";
        for (std::size_t c = 0; c < 2; c++) {
            EXPECT_LE(peaks[2 * i + c], 1.01 * verdict.channels[c].worst.peak)
                << name << " at " << at.omega_e_radps << " rad/s, " << at.iq_A << " A";
            EXPECT_LE(peaks[2 * i + c], 3.0);
        }
    }
    std::printf("%s: largest sensitivity of all points %.3f, of the verdict %.3f and %.3f\n",
                name.c_str(), *std::max_element(peaks.begin(), peaks.end()),
                verdict.channels[0].worst.peak, verdict.channels[1].worst.peak);
}

} // namespace

TEST(VerdictPlane, NoPointIsWorseThanTheVerdictSays)
{
    for (const char *name : {"ipmsm_390w", "ipmsm_390w_10khz", "ipmsm_390w_elastic"}) {
        expect_no_worse_point(name);
    }
}
