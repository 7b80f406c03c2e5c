// SPDX-License-Identifier: MIT
#include "sil/plant/bridge.hpp"

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "plant_motor.hpp"

using namespace sdre;
using support::motor_390w;

namespace {

constexpr double period_s    = 2e-4;
constexpr double vdc_V       = 295.0;
constexpr double dead_time_s = 3e-6;

/// A motor whose currents are set by a voltage over a time and then hardly move.
Motor heavy()
{
    Motor m                 = motor_390w();
    m.stator_resistance_Ohm = 1e-3;
    m.inertia_kgm2          = 1e3;
    return m;
}

const BridgeTiming full{period_s, 5000.0, 0.07498, false};

InverterSettings model(InverterModel which)
{
    InverterSettings s;
    s.model = which;
    return s;
}

bridge_t duties(double a, double b, double c)
{
    return {{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)}, true};
}

/// A plant at rest with this current in the stator frame.
Plant plant_with(const Motor &m, StatorVector i)
{
    Plant plant(m);
    plant.step(
        RotorVector{m.d_axis_inductance_H * i.alpha / 1e-5, m.q_axis_inductance_H * i.beta / 1e-5},
        0.0, 1e-5, 10);
    plant.reset_peak();
    return plant;
}

std::array<double, 3> mean_V(Bridge &bridge, Plant &plant, const bridge_t &output,
                             const InverterSettings &s = {})
{
    DcLink link(s, vdc_V);
    bridge.begin_period(output);
    bridge.advance(plant, link, {}, 0.0, period_s);
    std::array<double, 3> mean = bridge.volt_seconds();
    for (double &v : mean) {
        v /= period_s;
    }
    return mean;
}

} // namespace

TEST(Bridge, WithoutDeadTimeBothModelsHaveTheDutyAsMean)
{
    std::mt19937_64                  random(11);
    std::uniform_real_distribution<> any(-0.1, 1.1); // beyond the rails too
    Bridge                           switched(full, model(InverterModel::switched), 0.0);
    Bridge                           averaged(full, model(InverterModel::averaged), 0.0);
    Plant                            p = plant_with(motor_390w(), {1.0, -0.5});
    Plant                            q = p;
    for (int k = 0; k < 500; k++) {
        const bridge_t              out = duties(any(random), any(random), any(random));
        const std::array<double, 3> s   = mean_V(switched, p, out);
        const std::array<double, 3> a   = mean_V(averaged, q, out);
        const float                 d[] = {out.duty.a, out.duty.b, out.duty.c};
        for (std::size_t x = 0; x < 3; x++) {
            const double expected = vdc_V * std::min(1.0, std::max(0.0, static_cast<double>(d[x])));
            ASSERT_NEAR(s[x], expected, 1e-7);
            ASSERT_NEAR(a[x], expected, 1e-7);
        }
    }
}

TEST(Bridge, HalfPeriodsHaveTheDutyAsMeanToo)
{
    std::mt19937_64                  random(12);
    std::uniform_real_distribution<> any(0.0, 1.0);
    Bridge bridge({period_s, 2500.0, 0.07498, true}, model(InverterModel::switched), 0.0);
    Plant  p = plant_with(motor_390w(), {1.0, -0.5});
    for (int k = 0; k < 200; k++) {
        const bridge_t out = duties(any(random), any(random), any(random));
        ASSERT_NEAR(mean_V(bridge, p, out)[0], vdc_V * static_cast<double>(out.duty.a), 1e-7);
    }
}

TEST(Bridge, DeadTimeTakesItsVoltSecondsAgainstTheCurrent)
{
    const double lost_V = dead_time_s / period_s * vdc_V; // 4.4 V
    for (InverterModel which : {InverterModel::switched, InverterModel::averaged}) {
        for (double sign : {1.0, -1.0}) {
            Plant      p = plant_with(heavy(), {sign * 3.0, 0.0}); // b and c carry the half back
            Bridge     bridge(full, model(which), dead_time_s);
            const auto v = mean_V(bridge, p, duties(0.6, 0.5, 0.4));
            EXPECT_NEAR(v[0], 0.6 * vdc_V - sign * lost_V, 2e-5);
            EXPECT_NEAR(v[1], 0.5 * vdc_V + sign * lost_V, 2e-5);
            EXPECT_NEAR(v[2], 0.4 * vdc_V + sign * lost_V, 2e-5);
        }
    }
}

TEST(Bridge, DeadTimeAcrossThePeriodBoundary)
{
    // The lower switch would be on for 1 us only: shorter than the dead time, it stays off.
    Bridge       bridge(full, model(InverterModel::switched), dead_time_s);
    Plant        p    = plant_with(heavy(), {3.0, 0.0});
    const double duty = 1.0 - 1e-6 / period_s;
    mean_V(bridge, p, duties(duty, 0.5, 0.5));
    const auto v = mean_V(bridge, p, duties(duty, 0.5, 0.5));
    EXPECT_NEAR(v[0], vdc_V * (duty - dead_time_s / period_s), 1e-4);
    Plant  n = plant_with(heavy(), {-3.0, 0.0}); // inwards: the upper diode bridges the gap
    Bridge other(full, model(InverterModel::switched), dead_time_s);
    mean_V(other, n, duties(duty, 0.5, 0.5));
    EXPECT_NEAR(mean_V(other, n, duties(duty, 0.5, 0.5))[0], vdc_V, 1e-4);
}

TEST(Bridge, DropsOfSwitchAndDiode)
{
    InverterSettings s = model(InverterModel::switched);
    s.switch_drop_V    = 1.5;
    s.diode_drop_V     = 0.8;
    Plant      p       = plant_with(heavy(), {3.0, 0.0});
    Bridge     bridge(full, s, 0.0);
    const auto v = mean_V(bridge, p, duties(0.6, 0.5, 0.5));
    EXPECT_NEAR(v[0], 0.6 * (vdc_V - 1.5) - 0.4 * 0.8, 2e-5);
    EXPECT_NEAR(v[1], 0.5 * (vdc_V + 0.8) + 0.5 * 1.5, 2e-5);
    s.model = InverterModel::averaged;
    Bridge     averaged(full, s, 0.0);
    Plant      q = plant_with(heavy(), {3.0, 0.0});
    const auto a = mean_V(averaged, q, duties(0.6, 0.5, 0.5));
    EXPECT_NEAR(a[0], v[0], 2e-5);
    EXPECT_NEAR(a[1], v[1], 2e-5);
}

TEST(Bridge, CurrentDiesOutInTheDeadTimeAndStaysZero)
{
    // Lower diode carries a small outward current after the upper switch opened; it dies out and stays.
    Bridge bridge(full, model(InverterModel::switched), 2e-5);
    Plant  p = plant_with(heavy(), {0.004, 0.0});
    DcLink link({}, vdc_V);
    bridge.begin_period(duties(0.5, 0.5, 0.5));
    bridge.advance(p, link, {}, 0.0, 5e-5 + 1e-5); // all rise at 50 us; half of the dead time
    const double rate = 1e-6;
    EXPECT_NEAR(p.phase_current_A().a, 0.0, rate);
    bridge.advance(p, link, {}, 6e-5, 6.9e-5);
    EXPECT_NEAR(p.phase_current_A().a, 0.0, rate);
}

TEST(Bridge, AveragedCurrentBelowTheClampFadesWithinAPeriod)
{
    Bridge bridge(full, model(InverterModel::averaged), dead_time_s);
    Plant  p     = plant_with(heavy(), {0.005, 0.0}); // i_clamp is 12 mA
    double start = p.phase_current_A().a;
    mean_V(bridge, p, duties(0.5, 0.5, 0.5));
    const double share = p.phase_current_A().a / start;
    EXPECT_GT(share, 0.2); // resistance f L_d: exp(-1) after a period
    EXPECT_LT(share, 0.5);
}

TEST(Bridge, ModelsAgreeInClosedMotion)
{
    // The same rotating duties, dead time included: the currents agree to the PWM ripple.
    Bridge a(full, model(InverterModel::averaged), dead_time_s);
    Bridge s(full, model(InverterModel::switched), dead_time_s);
    Plant  pa(motor_390w());
    Plant  ps(motor_390w());
    pa.reset(300.0);
    ps.reset(300.0);
    double worst_A = 0.0;
    for (int k = 0; k < 2000; k++) {
        const double   angle = 300.0 * period_s * k + 1.9;
        const auto     leg   = [&](double shift) { return 0.5 + 0.25 * std::cos(angle - shift); };
        const bridge_t out   = duties(leg(0.0), leg(2.0943951), leg(4.1887902));
        mean_V(a, pa, out);
        mean_V(s, ps, out);
        worst_A = std::max(worst_A, std::hypot(pa.current_A().d - ps.current_A().d,
                                               pa.current_A().q - ps.current_A().q));
    }
    EXPECT_LT(worst_A, 0.1);
}

TEST(Bridge, TwoStepsPerPeriodAreEnough)
{
    const BridgeTiming fine{period_s / 20.0, 5000.0, 0.07498, false}; // steps of 5 us
    Bridge             coarse(full, model(InverterModel::averaged), 0.0);
    Bridge             small(fine, model(InverterModel::averaged), 0.0);
    Plant              p(motor_390w());
    Plant              q(motor_390w());
    p.reset(850.0);
    q.reset(850.0);
    DcLink link({}, vdc_V);
    double worst_A = 0.0;
    for (int k = 0; k < 1000; k++) {
        const double   angle = 850.0 * period_s * k + 1.9;
        const auto     leg   = [&](double shift) { return 0.5 + 0.45 * std::cos(angle - shift); };
        const bridge_t out   = duties(leg(0.0), leg(2.0943951), leg(4.1887902));
        coarse.begin_period(out);
        coarse.advance(p, link, {}, 0.0, period_s);
        for (int n = 0; n < 20; n++) {
            small.begin_period(out);
            small.advance(q, link, {}, 0.0, period_s / 20.0);
        }
        worst_A = std::max({worst_A, std::abs(p.current_A().d - q.current_A().d),
                            std::abs(p.current_A().q - q.current_A().q)});
    }
    EXPECT_LT(worst_A, 2.5e-5); // measured 5e-6
}

TEST(Bridge, PlantStepsOfHalfAPeriodFollowTheOpenLoopVectors)
{
    // va,vb,vc,TL,id,iq,omega_el,theta_el; the states are given in some rows only. From 0.8 s on the motor
    // runs away from these voltages, so that the smallest deviation grows without bound.
    std::ifstream file(std::string(SDRE_TEST_DATA_DIR) + "/openloop/ol_abc_drive.csv");
    ASSERT_TRUE(file);
    std::string line;
    std::getline(file, line);
    Plant  plant(motor_390w());
    double worst    = 0.0; // of 5 A and 850 rad/s
    int    compared = 0;
    for (int k = 0; k < 4000 && std::getline(file, line); k++) {
        std::array<double, 8> row{};
        std::stringstream     cells(line);
        std::string           cell;
        bool                  states = true;
        for (double &x : row) {
            states = std::getline(cells, cell, ',') && !cell.empty();
            x      = states ? std::stod(cell) : 0.0;
        }
        if (states) {
            compared++;
            worst = std::max({worst, std::abs(plant.current_A().d - row[4]) / 5.0,
                              std::abs(plant.current_A().q - row[5]) / 5.0,
                              std::abs(plant.omega_e_radps() - row[6]) / 850.0});
        }
        const StatorVector v{(2.0 * row[0] - row[1] - row[2]) / 3.0,
                             (row[1] - row[2]) / std::sqrt(3.0)};
        plant.advance(v, {row[3], 0.0}, 0.5 * period_s);
        plant.advance(v, {row[3], 0.0}, 0.5 * period_s);
    }
    EXPECT_GE(compared, 500);
    EXPECT_LT(worst, 1e-6); // measured 4.6e-8
}

TEST(Bridge, SplittingAPeriodChangesNothing)
{
    for (InverterModel which : {InverterModel::switched, InverterModel::averaged}) {
        Bridge whole(full, model(which), dead_time_s);
        Bridge split(full, model(which), dead_time_s);
        Plant  p = plant_with(motor_390w(), {1.0, 0.3});
        Plant  q = p;
        DcLink link({}, vdc_V);
        for (int k = 0; k < 50; k++) {
            const bridge_t out = duties(0.62, 0.5, 0.41);
            whole.begin_period(out);
            whole.advance(p, link, {}, 0.0, period_s);
            split.begin_period(out);
            split.advance(q, link, {}, 0.0, 0.9 * period_s);
            split.advance(q, link, {}, 0.9 * period_s, period_s);
        }
        EXPECT_NEAR(p.current_A().d, q.current_A().d, 1e-6);
        EXPECT_NEAR(p.current_A().q, q.current_A().q, 1e-6);
    }
}

TEST(Bridge, DutyLimits)
{
    InverterSettings s = model(InverterModel::switched);
    s.duty_min         = 0.05;
    s.duty_max         = 0.9;
    Bridge     bridge(full, s, 0.0);
    Plant      p = plant_with(motor_390w(), {1.0, 0.0});
    const auto v = mean_V(bridge, p, duties(1.0, 0.0, 0.5));
    EXPECT_NEAR(v[0], 0.9 * vdc_V, 1e-4);
    EXPECT_NEAR(v[1], 0.05 * vdc_V, 1e-4);
}

TEST(Bridge, EnergyThatLeavesTheMotorChargesTheLink)
{
    // Braking into a blocked link: 0.5 C (v^2 - v0^2) is what the terminals gave.
    for (InverterModel which : {InverterModel::switched, InverterModel::averaged}) {
        InverterSettings s      = model(which);
        s.regeneration          = Regeneration::blocks;
        s.capacitance_F         = 1e-4;
        Motor m                 = heavy();
        m.stator_resistance_Ohm = 1e-9;
        Plant  p(m);
        DcLink link(s, vdc_V);
        p.reset(300.0);
        Bridge      bridge(full, s, 0.0);
        double      out_J    = 0.0;
        RotorVector i        = p.current_A();
        const auto  stored_J = [&] {
            return 0.75 * (m.d_axis_inductance_H * i.d * i.d + m.q_axis_inductance_H * i.q * i.q);
        };
        for (int k = 0; k < 52;
             k++) { // half a turn: without resistance the current swings back after it
            const double angle = p.theta_e_rad() + 1.5708 + 0.5 * 300.0 * period_s;
            const auto   leg   = [&](double shift) { return 0.5 + 0.15 * std::cos(angle - shift); };
            const double torque_before = p.torque_Nm();
            bridge.begin_period(duties(leg(0.0), leg(2.0943951), leg(4.1887902)));
            bridge.advance(p, link, {}, 0.0, period_s);
            out_J -= 0.5 * (torque_before + p.torque_Nm()) * 150.0 *
                     period_s; // shaft power, constant speed
        }
        i                     = p.current_A();
        const double gained_J = 0.5 * 1e-4 * (std::pow(link.voltage_V(), 2) - vdc_V * vdc_V);
        EXPECT_GT(gained_J, 0.1);
        EXPECT_NEAR(gained_J + stored_J(), out_J, 0.01 * out_J);
    }
}

TEST(Bridge, OpenGatesLetTheCurrentDieAway)
{
    for (InverterModel which : {InverterModel::switched, InverterModel::averaged}) {
        Bridge bridge(full, model(which), dead_time_s);
        Plant  p = plant_with(motor_390w(), {3.0, 1.0});
        for (int k = 0; k < 50; k++) {
            mean_V(bridge, p, {{0.5F, 0.5F, 0.5F}, false});
        }
        EXPECT_LT(std::hypot(p.current_A().d, p.current_A().q), 0.02);
    }
}

TEST(Bridge, EachEdgeHasItsOwnDelayAndEachPathItsOwnDrop)
{
    InverterSettings s = model(InverterModel::switched);
    s.switch_drop_V    = 1.0;
    s.diode_drop_V     = 2.5;
    LegTiming leg;
    leg.changes      = {{{0.0, false}, {6e-5, true}, {1.4e-4, false}, {}}};
    leg.count        = 3;
    leg.duty         = 0.4;
    leg.rise_delay_s = 3e-6;
    leg.fall_delay_s = 9e-6;
    for (InverterModel which : {InverterModel::switched, InverterModel::averaged}) {
        s.model = which;
        for (const bool out : {true, false}) {
            Plant  p = plant_with(heavy(), {out ? 3.0 : -3.0, 0.0}); // the same duty: it stays
            Bridge bridge(full, s, 0.0);
            DcLink link(s, vdc_V);
            for (int k = 0; k < 2; k++) { // the first period has no edge before it
                bridge.begin_period({leg, leg, leg});
                bridge.advance(p, link, {}, 0.0, period_s);
            }
            // Outwards the upper switch or the lower diode carries the current, inwards the others.
            const double high_s = 8e-5 + (out ? -3e-6 : 9e-6);
            const double low_s  = period_s - high_s;
            const double wanted =
                out ? (vdc_V - 1.0) * high_s - 2.5 * low_s : (vdc_V + 2.5) * high_s + 1.0 * low_s;
            EXPECT_NEAR(bridge.volt_seconds()[0], wanted, 1e-9);
        }
    }
}

TEST(Plant, PhaseCurrentRateIsTheDerivativeOfThePhaseCurrents)
{
    Plant fast(motor_390w());
    fast.reset(600.0, 0.7);
    fast.step(RotorVector{-200.0, 150.0}, 0.0, 1e-3, 100);
    const StatorVector v{90.0, -40.0};
    const double       h      = 1e-7;
    const PhaseVector  rate   = fast.phase_current_rate_Aps(v);
    const PhaseVector  before = fast.phase_current_A();
    fast.advance(v, {}, h);
    const PhaseVector after = fast.phase_current_A();
    EXPECT_GT(std::abs(before.a), 0.5);
    EXPECT_NEAR((after.a - before.a) / h, rate.a, 1.0); // w i alone is some 1000 A/s
    EXPECT_NEAR((after.b - before.b) / h, rate.b, 1.0);
    EXPECT_NEAR((after.c - before.c) / h, rate.c, 1.0);
}

TEST(Bridge, TheCurrentOfAnOpenLegDiesOutAndStaysZero)
{
    const InverterSettings s = model(InverterModel::switched);
    LegTiming              leg;
    leg.changes = {{{0.0, false}, {5e-5, true}, {1.5e-4, false}, {}}};
    leg.count   = 3;
    leg.duty    = 0.5;
    LegTiming idle;
    idle.count = 1; // stays low: nothing ends the holding
    Plant p(heavy());
    p.step(RotorVector{100.0, 0.0}, 0.0, 1e-3,
           20); // at rest: no EMF drives a current through a diode
    ASSERT_GT(std::abs(p.phase_current_A().a), 0.5);
    Bridge bridge(full, s, dead_time_s);
    DcLink link(s, vdc_V);
    for (int k = 0; k < 40; k++) {
        bridge.begin_period({idle, leg, leg});
        bridge.set_legs({false, true, true});
        for (int n = 0; n < 20; n++) {
            bridge.advance(p, link, {}, n * 1e-5, (n + 1) * 1e-5);
            if (k >= 20) {
                ASSERT_LT(std::abs(p.phase_current_A().a), 1e-3) << k;
            }
        }
        if (k >= 20) { // the open terminal follows the other two
            ASSERT_NEAR(bridge.volt_seconds()[0], bridge.volt_seconds()[1],
                        1e-4 * vdc_V * period_s);
        }
    }
}
