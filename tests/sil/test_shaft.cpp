// SPDX-License-Identifier: MIT
/// Dry friction, powder brake and the shaft between motor and load, against closed forms and balances of energy.
#include "sil/plant/dry_friction.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "plant_motor.hpp"
#include "sil/plant/plant.hpp"

using namespace sdre;

namespace {

const double pi = std::acos(-1.0);

/// Mechanics alone: no magnet, so that no current brakes.
Motor mass()
{
    Motor m                = support::motor_390w();
    m.pm_flux_Wb           = 1e-12;
    m.viscous_friction_Nms = 0.0;
    return m;
}

MotorEffects stribeck()
{
    MotorEffects e;
    e.coulomb_friction_Nm    = 0.03;
    e.static_friction_Nm     = 0.05;
    e.stribeck_speed_m_radps = 4.0;
    return e;
}

double omega_m(const Plant &plant)
{
    return plant.omega_e_radps() / 2.0;
}

double simpson(double from, double to, const std::function<double(double)> &f)
{
    constexpr int n   = 2000;
    const double  h   = (to - from) / n;
    double        sum = f(from) + f(to);
    for (int k = 1; k < n; k++) {
        sum += (k % 2 == 1 ? 4.0 : 2.0) * f(from + k * h);
    }
    return sum * h / 3.0;
}

} // namespace

TEST(Stribeck, CoastsDownAsItsCurveSays)
{
    const MotorEffects e = stribeck();
    const Motor        m = mass();
    const auto         F = [](double w) { return 0.03 + 0.02 * std::exp(-(w / 4.0) * (w / 4.0)); };
    for (const double sign : {1.0, -1.0}) {
        Plant plant(m);
        plant.set_effects(e);
        plant.reset(sign * 2.0 * 12.0);
        double time_s = 0.0;
        while (std::abs(omega_m(plant)) > 1.0) {
            plant.advance({}, {}, 5e-5);
            time_s += 5e-5;
        }
        const double w = std::abs(omega_m(plant));
        EXPECT_NEAR(time_s, m.inertia_kgm2 * simpson(w, 12.0, [&](double x) { return 1.0 / F(x); }),
                    1e-9);
        while (omega_m(plant) != 0.0 && time_s < 1.0) {
            plant.advance({}, {}, 5e-5);
            time_s += 5e-5;
        }
        EXPECT_NEAR(time_s,
                    m.inertia_kgm2 * simpson(0.0, 12.0, [&](double x) { return 1.0 / F(x); }),
                    5e-5);
    }
}

TEST(Stribeck, HoldsUpToTheStaticTorqueAndThenRunsAway)
{
    Plant plant(mass());
    plant.set_effects(stribeck());
    plant.reset(0.0);
    for (int k = 0; k < 100; k++) {
        plant.advance({}, {-0.0499}, 5e-5);
        ASSERT_EQ(plant.omega_e_radps(), 0.0);
    }
    const auto push = [&](double torque_Nm, int steps) {
        for (int k = 0; k < steps; k++) {
            plant.advance({}, {-torque_Nm}, 5e-5);
        }
    };
    push(0.0501, 100);
    EXPECT_GT(omega_m(plant), 0.0);
    push(0.045, 2000); // it has not come past the speed from which on this much drives it
    EXPECT_EQ(omega_m(plant), 0.0);
    push(0.08, 1000);
    EXPECT_GT(omega_m(plant), 2.15);
    push(0.045, 3000);
    EXPECT_GT(omega_m(plant), 5.0);
}

/// A torque that rises slowly over the teeth of a cogging torque: rests and jumps.
TEST(Stribeck, SticksAndSlips)
{
    MotorEffects e         = stribeck();
    e.cogging_amplitude_Nm = 0.1;
    e.cogging_order        = 24.0;
    Motor m                = mass();
    m.viscous_friction_Nms = 0.01;
    Plant plant(m);
    plant.set_effects(e);
    plant.reset(0.0);
    int    jumps   = 0;
    double load_Nm = 0.0;
    for (int k = 0; k < 80000; k++) { // up to 0.2 N m one way and the other, twice
        load_Nm              = 0.2 * std::sin(2.0 * pi * k / 40000.0);
        const double theta_m = plant.theta_e_rad() / m.pole_pairs;
        const double rest_Nm = -0.1 * std::sin(24.0 * theta_m) + load_Nm;
        const bool   held    = omega_m(plant) == 0.0;
        plant.advance({}, {-load_Nm}, 5e-5);
        if (held) {
            ASSERT_EQ(omega_m(plant) == 0.0, std::abs(rest_Nm) <= 0.05) << k;
            ASSERT_GE(omega_m(plant) * rest_Nm, 0.0);
            jumps += omega_m(plant) != 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(jumps, 4);
}

TEST(Brake, FollowsItsCommandThroughALag)
{
    BrakeSettings s;
    s.command         = {{0.1, 2.0}, {0.2501, 0.5}};
    s.time_constant_s = 0.08;
    s.drag_Nm         = 0.02;
    PowderBrake brake(s);
    EXPECT_TRUE(brake.present());
    EXPECT_FALSE(PowderBrake({}).present());
    const double at_second = 2.0 * (1.0 - std::exp(-0.1501 / 0.08));
    for (int k = 0; k < 2000; k++) {
        const double t    = 2e-4 * k;
        double       want = 0.02;
        if (t > 0.2501) {
            want += 0.5 + (at_second - 0.5) * std::exp(-(t + 1e-4 - 0.2501) / 0.08);
        } else if (t > 0.1 - 1e-9) {
            want += 2.0 * (1.0 - std::exp(-(t + 1e-4 - 0.1) / 0.08));
        }
        ASSERT_NEAR(brake.at(t, 1e-4), want, 1e-12) << t;
    }
}

TEST(Brake, TakesTheEnergyAndNeverTurnsTheShaftRound)
{
    const Motor m = mass();
    for (const double sign : {1.0, -1.0}) {
        Plant plant(m);
        plant.reset(sign * 300.0);
        const ShaftLoad overhauling{-sign * 0.2, 0.0, 0.5}; // drives along with the motion
        int             steps = 0;
        while (omega_m(plant) != 0.0 && steps < 100000) {
            plant.advance({}, overhauling, 5e-5);
            ASSERT_GE(sign * omega_m(plant), 0.0);
            steps++;
        }
        const double start_J = 0.5 * m.inertia_kgm2 * 150.0 * 150.0;
        EXPECT_NEAR(sign * 0.3 * plant.theta_e_rad() / m.pole_pairs, start_J, 1e-3 * start_J);
        EXPECT_NEAR(steps * 5e-5, m.inertia_kgm2 * 150.0 / 0.3, 1e-4);
        for (const double load_Nm : {0.499, -0.499}) {
            plant.advance({}, {load_Nm, 0.0, 0.5}, 5e-5);
            EXPECT_EQ(omega_m(plant), 0.0);
        }
        plant.advance({}, {0.501, 0.0, 0.5}, 5e-5);
        EXPECT_NEAR(omega_m(plant), -0.001 / m.inertia_kgm2 * 5e-5, 1e-12);
    }
}

namespace {

constexpr double stiffness_Nmprad = 40.0;

MotorEffects elastic(double damping_Nms)
{
    MotorEffects e;
    e.load_inertia_share     = 0.6;
    e.shaft_stiffness_Nmprad = stiffness_Nmprad;
    e.shaft_damping_Nms      = damping_Nms;
    return e;
}

double energy_J(const Plant &plant)
{
    const double J = mass().inertia_kgm2;
    return 0.5 * 0.4 * J * std::pow(omega_m(plant), 2) +
           0.5 * 0.6 * J * std::pow(plant.omega_load_m_radps(), 2) +
           0.5 * stiffness_Nmprad * std::pow(plant.twist_rad(), 2);
}

/// Angular frequency of the twist over 40 of its periods, from where it rises through zero.
double oscillation_radps(Plant &plant, const ShaftLoad &load, double dt_s)
{
    double first_s = -1.0;
    int    rises   = 0;
    for (int k = 0;; k++) {
        const double before = plant.twist_rad();
        plant.advance({}, load, dt_s);
        const double after = plant.twist_rad();
        if (before < 0.0 && after >= 0.0) {
            const double now_s = dt_s * (k - before / (after - before));
            first_s            = rises == 0 ? now_s : first_s;
            if (++rises == 41) {
                return 2.0 * pi * 40.0 / (now_s - first_s);
            }
        }
    }
}

} // namespace

TEST(TwoMass, OscillatesAtItsResonanceAndWithOneEndHeldAtTheOthers)
{
    const double J = mass().inertia_kgm2;
    Plant        free(mass());
    free.set_effects(elastic(0.0));
    free.reset(0.0);
    for (int k = 0; k < 20; k++) {
        free.advance({}, {0.5}, 1e-5);
    }
    const double resonance = std::sqrt(stiffness_Nmprad * (1.0 / (0.4 * J) + 1.0 / (0.6 * J)));
    EXPECT_NEAR(oscillation_radps(free, {}, 1e-5), resonance, 1e-4 * resonance);

    MotorEffects held        = elastic(0.0);
    held.coulomb_friction_Nm = 10.0; // the motor stands: what its encoder cannot see
    Plant motor_held(mass());
    motor_held.set_effects(held);
    motor_held.reset(0.0);
    for (int k = 0; k < 20; k++) {
        motor_held.advance({}, {0.5}, 1e-5);
    }
    const double anti = std::sqrt(stiffness_Nmprad / (0.6 * J));
    EXPECT_NEAR(oscillation_radps(motor_held, {}, 1e-5), anti, 1e-4 * anti);
    EXPECT_EQ(motor_held.omega_e_radps(), 0.0);

    Plant load_held(mass());
    load_held.set_effects(elastic(0.0));
    load_held.reset(40.0); // the brake stops the load, the motor swings on
    const double other = std::sqrt(stiffness_Nmprad / (0.4 * J));
    EXPECT_NEAR(oscillation_radps(load_held, {0.0, 0.0, 100.0}, 1e-5), other, 1e-4 * other);
    EXPECT_EQ(load_held.omega_load_m_radps(), 0.0);
}

TEST(TwoMass, KeepsItsEnergyAndLosesWhatTheDampingTakes)
{
    for (const double damping_Nms : {0.0, 0.004}) {
        Plant plant(mass());
        plant.set_effects(elastic(damping_Nms));
        plant.reset(200.0);
        double       lost_J  = 0.0;
        double       work_J  = 0.0;
        const double start_J = energy_J(plant);
        const double dt_s    = 1e-5;
        const auto   slip    = [&] { return omega_m(plant) - plant.omega_load_m_radps(); };
        for (int k = 0; k < 20000; k++) {
            const double slip_before = slip();
            const double load_before = plant.omega_load_m_radps();
            const double load_Nm     = k < 5000 ? 0.3 : -0.1;
            plant.advance({}, {load_Nm}, dt_s);
            lost_J += 0.5 * dt_s * damping_Nms * (std::pow(slip_before, 2) + std::pow(slip(), 2));
            work_J += 0.5 * dt_s * load_Nm * (load_before + plant.omega_load_m_radps());
            ASSERT_NEAR(energy_J(plant) + lost_J + work_J, start_J, 2e-5 * start_J) << k;
        }
        const double J        = mass().inertia_kgm2; // both together: as a rigid shaft
        const double momentum = J * (0.4 * omega_m(plant) + 0.6 * plant.omega_load_m_radps());
        EXPECT_NEAR(momentum, J * 100.0 - 0.3 * 0.05 + 0.1 * 0.15, 1e-9);
        EXPECT_EQ(lost_J > 0.0, damping_Nms > 0.0);
    }
}

TEST(TwoMass, DampingFadesTheOscillationAsItsClosedFormSays)
{
    const double damping_Nms = 0.004;
    Plant        plant(mass());
    plant.set_effects(elastic(damping_Nms));
    plant.reset(0.0);
    for (int k = 0; k < 20; k++) {
        plant.advance({}, {0.5}, 1e-5);
    }
    const double reduced = 0.4 * 0.6 * mass().inertia_kgm2;
    const auto   swing_J = [&] { // of the masses against each other
        return 0.5 * reduced * std::pow(omega_m(plant) - plant.omega_load_m_radps(), 2) +
               0.5 * stiffness_Nmprad * std::pow(plant.twist_rad(), 2);
    };
    const double natural = std::sqrt(stiffness_Nmprad / reduced);
    const double fade    = 0.5 * damping_Nms / reduced;
    const double period  = 2.0 * pi / std::sqrt(natural * natural - fade * fade);
    const int    steps   = 2000;
    const double start_J = swing_J();
    for (int k = 0; k < 20 * steps; k++) {
        plant.advance({}, {}, period / steps);
    }
    EXPECT_NEAR(swing_J() / start_J, std::exp(-2.0 * fade * 20.0 * period), 1e-6);
}
