// SPDX-License-Identifier: MIT
/// All switches off: what the diodes let through. The line EMF's peak is sqrt(3) psi omega_e: 295 V at 882 rad/s.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "plant_motor.hpp"
#include "sil/plant/bridge.hpp"

using namespace sdre;

namespace {

constexpr double period_s = 2e-4;
constexpr double vdc_V    = 295.0;
constexpr double brute_s  = 1e-7;
const bridge_t   opened{{0.5F, 0.5F, 0.5F}, false};

const BridgeTiming timing{period_s, 5000.0, 0.07498, false};

Motor motor(double inertia_kgm2 = 1e3)
{
    Motor m        = support::motor_390w();
    m.inertia_kgm2 = inertia_kgm2;
    return m;
}

InverterSettings model(InverterModel which)
{
    InverterSettings s;
    s.model = which;
    return s;
}

/// Speed at which the line EMF's peak is this voltage.
double speed_of(double line_V)
{
    return line_V / (std::sqrt(3.0) * motor().pm_flux_Wb);
}

/// A turning motor with some current in it.
Plant turning(const Motor &m, double omega_e_radps, RotorVector i = {})
{
    Plant plant(m);
    plant.reset(omega_e_radps);
    const double      w = omega_e_radps;
    const double      h = 1e-6; // so short that only the inductances matter
    const RotorVector v{m.d_axis_inductance_H * i.d / h,
                        m.q_axis_inductance_H * i.q / h + w * m.pm_flux_Wb};
    plant.step(v, 0.0, h, 1);
    return plant;
}

void run(Bridge &bridge, Plant &plant, DcLink &link, double time_s)
{
    for (int k = 0; k < static_cast<int>(std::lround(time_s / period_s)); k++) {
        plant.align_angle();
        bridge.begin_period(opened);
        bridge.advance(plant, link, {}, 0.0, period_s);
    }
}

/// Steady state of an open bridge at a constant speed.
struct Means {
    double dc_A      = 0.0; ///< into the link
    double torque_Nm = 0.0;
    double square_A2 = 0.0; ///< i_d^2 + i_q^2
};

// A whole number of sixths of a turn, so that the means do not depend on where they begin.
double averaging_s(double omega_e_radps)
{
    return 12.0 * 2.0 * std::acos(-1.0) / omega_e_radps;
}

/// Oracle: a rectifier whose rails fade over 0.5 mA, in steps of 0.1 us. With first_low leg a is
/// closed to the negative rail.
double brute_step(Plant &plant, double link_V, bool first_low = false)
{
    constexpr double            fade_A = 5e-4;
    const std::array<double, 3> i      = as_array(plant.phase_current_A());
    std::array<double, 3>       v{};
    double                      dc_A = 0.0;
    for (std::size_t x = first_low ? 1 : 0; x < 3; x++) {
        const double share = 0.5 - 0.5 * std::clamp(i[x] / fade_A, -1.0, 1.0);
        v[x]               = share * link_V;
        dc_A -= share * i[x];
    }
    plant.advance(clarke(v), {}, brute_s);
    return dc_A;
}

Means brute_force(double omega_e_radps)
{
    Plant      plant = turning(motor(), omega_e_radps);
    Means      sum;
    const long settled = std::lround(0.2 / brute_s);
    const long all     = settled + std::lround(averaging_s(omega_e_radps) / brute_s);
    for (long k = 0; k < all; k++) {
        if (k % 2000 == 0) {
            plant.align_angle();
        }
        const double dc_A = brute_step(plant, vdc_V);
        if (k >= settled) {
            const RotorVector dq = plant.current_A();
            sum.dc_A += dc_A;
            sum.torque_Nm += plant.torque_Nm();
            sum.square_A2 += dq.d * dq.d + dq.q * dq.q;
        }
    }
    const auto n = static_cast<double>(all - settled);
    return {sum.dc_A / n, sum.torque_Nm / n, sum.square_A2 / n};
}

/// The bridge under test, with a link that says how much charge came.
Means of_bridge(double omega_e_radps, InverterModel which)
{
    InverterSettings s = model(which);
    s.regeneration     = Regeneration::blocks;
    s.capacitance_F    = 10.0; // 1 A for 0.1 s is 10 mV
    Bridge bridge(timing, s, 3e-6);
    Plant  plant = turning(motor(), omega_e_radps);
    DcLink link(s, vdc_V);
    run(bridge, plant, link, 0.2);
    const double before_V = link.voltage_V();
    Means        sum;
    const long   n = std::lround(averaging_s(omega_e_radps) / 1e-5);
    for (long k = 0; k < n; k++) {
        bridge.begin_period(opened);
        bridge.advance(plant, link, {}, 0.0, 1e-5);
        const RotorVector dq = plant.current_A();
        sum.torque_Nm += plant.torque_Nm() / static_cast<double>(n);
        sum.square_A2 += (dq.d * dq.d + dq.q * dq.q) / static_cast<double>(n);
    }
    sum.dc_A = (link.voltage_V() - before_V) * s.capacitance_F / (1e-5 * static_cast<double>(n));
    return sum;
}

} // namespace

TEST(OpenBridge, BelowTheLineEmfTheCurrentDiesAndStaysExactlyZero)
{
    for (InverterModel which : {InverterModel::averaged, InverterModel::switched}) {
        for (const double line_V : {0.0, 30.0, 236.0, 290.0, 294.9, -236.0, -294.9}) {
            for (const double angle : {0.0, 0.7, 2.5, 4.1}) {
                Bridge bridge(timing, model(which), 3e-6);
                DcLink link({}, vdc_V);
                Plant  plant = turning(motor(), speed_of(line_V),
                                       {3.0 * std::cos(angle), 3.0 * std::sin(angle)});
                ASSERT_GT(std::hypot(plant.current_A().d, plant.current_A().q), 2.5);
                run(bridge, plant, link, 0.06);
                for (int k = 0; k < 50; k++) {
                    run(bridge, plant, link, period_s);
                    ASSERT_EQ(plant.current_A().d, 0.0) << line_V << " " << angle;
                    ASSERT_EQ(plant.current_A().q, 0.0) << line_V << " " << angle;
                }
            }
        }
    }
}

TEST(OpenBridge, AHigherLinkLetsNothingThrough)
{
    // 236 V of EMF against 363 V, from 3 A: the whole current ends and no braking torque is left.
    Bridge bridge(timing, model(InverterModel::averaged), 3e-6);
    DcLink link({}, 363.0);
    Plant  plant = turning(motor(), speed_of(236.0), {-2.0, 2.0});
    run(bridge, plant, link, 0.02);
    EXPECT_EQ(plant.current_A().d, 0.0);
    EXPECT_EQ(plant.current_A().q, 0.0);
    EXPECT_EQ(plant.torque_Nm(), 0.0);
}

TEST(OpenBridge, TheDropOfTwoDiodesMovesTheThreshold)
{
    InverterSettings s = model(InverterModel::averaged);
    s.diode_drop_V     = 1.5;
    for (const bool above : {false, true}) {
        Bridge bridge(timing, s, 3e-6);
        DcLink link(s, vdc_V);
        Plant  plant = turning(motor(), speed_of(vdc_V + 3.0 + (above ? 0.5 : -0.1)));
        run(bridge, plant, link, 0.05);
        plant.reset_peak();
        run(bridge, plant, link, 0.01);
        EXPECT_EQ(plant.peak_current_A() > 0.0, above);
    }
}

TEST(OpenBridge, AboveTheLineEmfItIsTheRectifierOfAFineSimulation)
{
    for (const double line_V : {300.0, 340.0, 468.0}) {
        const double omega  = speed_of(line_V);
        const Means  wanted = brute_force(omega);
        ASSERT_GT(wanted.dc_A, 0.0);
        for (InverterModel which : {InverterModel::averaged, InverterModel::switched}) {
            const Means found = of_bridge(omega, which);
            EXPECT_NEAR(found.dc_A, wanted.dc_A, 1.5e-3) << line_V;
            EXPECT_NEAR(found.torque_Nm, wanted.torque_Nm, 1.5e-3) << line_V;
            EXPECT_NEAR(std::sqrt(found.square_A2), std::sqrt(wanted.square_A2), 1.5e-3) << line_V;
        }
    }
}

TEST(OpenBridge, WhatTheShaftLosesIsWhatLinkAndWindingsGet)
{
    const Motor m = motor();
    for (const double line_V : {320.0, 400.0, 468.0}) {
        const double omega    = speed_of(line_V);
        const Means  found    = of_bridge(omega, InverterModel::averaged);
        const double shaft_W  = -found.torque_Nm * omega / m.pole_pairs;
        const double copper_W = 1.5 * m.stator_resistance_Ohm * found.square_A2;
        EXPECT_NEAR(found.dc_A * vdc_V + copper_W, shaft_W, 0.005 * shaft_W) << line_V;
    }
}

TEST(OpenBridge, EnergyOfACoastingMotorIsInTheLinkAndTheWindings)
{
    for (InverterModel which : {InverterModel::averaged, InverterModel::switched}) {
        InverterSettings s     = model(which);
        s.regeneration         = Regeneration::blocks;
        s.capacitance_F        = 1e-3;
        Motor m                = motor(0.00042);
        m.viscous_friction_Nms = 0.0;
        Bridge     bridge(timing, s, 3e-6);
        Plant      plant = turning(m, 1400.0, {-2.0, 1.0});
        DcLink     link(s, vdc_V);
        const auto energy_J = [&] {
            const RotorVector i = plant.current_A();
            const double      w = plant.omega_e_radps() / m.pole_pairs;
            return 0.5 * m.inertia_kgm2 * w * w +
                   0.75 * (m.d_axis_inductance_H * i.d * i.d + m.q_axis_inductance_H * i.q * i.q) +
                   0.5 * s.capacitance_F * link.voltage_V() * link.voltage_V();
        };
        const double before_J = energy_J();
        const double stored_J = 0.5 * s.capacitance_F * vdc_V * vdc_V;
        double       copper_J = 0.0;
        for (int k = 0; k < 60000; k++) {
            const RotorVector a = plant.current_A();
            bridge.begin_period(opened);
            bridge.advance(plant, link, {}, 0.0, 5e-6);
            const RotorVector b = plant.current_A();
            copper_J += 0.5 * 5e-6 * 1.5 * m.stator_resistance_Ohm *
                        (a.d * a.d + a.q * a.q + b.d * b.d + b.q * b.q);
        }
        const double moved_J = 0.5 * s.capacitance_F * std::pow(link.voltage_V(), 2) - stored_J;
        EXPECT_GT(moved_J, 10.0);
        EXPECT_NEAR(energy_J() + copper_J, before_J, 0.002 * moved_J);
    }
}

TEST(OpenBridge, AfterATripAtHighSpeedTheLinkRisesAsInAFineSimulation)
{
    // 1400 rad/s is 468 V; 1 mF behind a diode rectifier, the currents of flux weakening at no load.
    constexpr double trip_s = 0.1;
    InverterSettings s      = model(InverterModel::averaged);
    s.regeneration          = Regeneration::blocks;
    s.capacitance_F         = 1e-3;
    const auto at_trip      = [] { return turning(motor(0.00042), 1400.0, {-1.27, 0.14}); };
    Plant      brute        = at_trip();
    double     brute_V      = vdc_V;
    for (long k = 0; k < std::lround(trip_s / brute_s); k++) {
        if (k % 2000 == 0) {
            brute.align_angle();
        }
        brute_V += brute_step(brute, brute_V) * brute_s / s.capacitance_F;
    }
    Bridge bridge(timing, s, 3e-6);
    Plant  plant = at_trip();
    DcLink link(s, vdc_V);
    run(bridge, plant, link, trip_s);
    EXPECT_NEAR(link.voltage_V(), brute_V, 0.2); // measured 366.5 V
    EXPECT_NEAR(plant.omega_e_radps(), brute.omega_e_radps(), 1.0);
    EXPECT_GT(link.voltage_V(), 350.0);
    EXPECT_LT(link.voltage_V(), 388.0); // rotor and link at rest with each other, without losses
}

TEST(OpenBridge, ABrakeChopperHoldsTheLinkAfterATrip)
{
    InverterSettings s       = model(InverterModel::averaged);
    s.regeneration           = Regeneration::blocks;
    s.capacitance_F          = 1e-3;
    s.chopper_on_V           = 340.0;
    s.chopper_resistance_Ohm = 100.0;
    Bridge bridge(timing, s, 3e-6);
    Plant  plant = turning(motor(0.00042), 1400.0, {-1.27, 0.14});
    DcLink link(s, vdc_V);
    for (int k = 0; k < 1000; k++) {
        run(bridge, plant, link, period_s);
        ASSERT_LE(link.voltage_V(), 340.0 + 1e-9);
    }
    EXPECT_GT(link.chopper_J(), 20.0);
    EXPECT_LT(plant.omega_e_radps(), speed_of(370.0)); // the EMF follows the link down
}

TEST(OpenBridge, ALegThatOpensAloneIsTheSameInBothModels)
{
    // Two legs switch, the third is open: its phase carries what the diodes let it.
    const auto mean_A2 = [](InverterModel which) {
        Bridge bridge(timing, model(which), 0.0);
        DcLink link({}, vdc_V);
        Plant  plant = turning(motor(), 300.0);
        double sum   = 0.0;
        for (int k = 0; k < 1000; k++) {
            const double angle = 300.0 * period_s * k + 1.9;
            const auto   leg   = [&](double shift) {
                return static_cast<float>(0.5 + 0.25 * std::cos(angle - shift));
            };
            plant.align_angle();
            bridge.begin_period(bridge_t{{leg(0.0), leg(2.0943951), leg(4.1887902)}, true});
            bridge.set_legs({false, true, true});
            bridge.advance(plant, link, {}, 0.0, period_s);
            const PhaseVector i = plant.phase_current_A();
            EXPECT_LT(std::abs(i.a + i.b + i.c), 1e-9);
            sum += i.b * i.b / 1000.0;
        }
        return sum;
    };
    const double averaged = mean_A2(InverterModel::averaged);
    EXPECT_GT(averaged, 0.01);
    EXPECT_NEAR(mean_A2(InverterModel::switched), averaged, 0.05 * averaged);
}

TEST(OpenBridge, OneClosedSwitchIsAShortThroughTheDiodesOfTheOthers)
{
    // At 300 rad/s the line EMF is 100 V: far below the link, but not below the lower rail.
    Plant      brute = turning(motor(), 300.0);
    Bridge     bridge(timing, model(InverterModel::switched), 0.0);
    Plant      plant = turning(motor(), 300.0);
    DcLink     link({}, vdc_V);
    LegTiming  low;
    const long steps   = std::lround(period_s / brute_s);
    double     worst_A = 0.0;
    double     peak_A  = 0.0;
    low.count          = 1;
    for (int k = 0; k < 200; k++) {
        brute.align_angle();
        plant.align_angle();
        for (long n = 0; n < steps; n++) {
            brute_step(brute, vdc_V, true);
        }
        bridge.begin_period({low, low, low});
        bridge.set_legs({true, false, false});
        bridge.advance(plant, link, {}, 0.0, period_s);
        peak_A  = std::max(peak_A, std::abs(plant.phase_current_A().a));
        worst_A = std::max({worst_A, std::abs(plant.current_A().d - brute.current_A().d),
                            std::abs(plant.current_A().q - brute.current_A().q)});
    }
    EXPECT_GT(peak_A, 1.0);
    EXPECT_LT(worst_A, 5e-3);
}
