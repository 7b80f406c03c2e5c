// SPDX-License-Identifier: MIT
#include "sil/plant/motor_effects.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "plant_motor.hpp"
#include "sil/plant/plant.hpp"

using namespace sdre;
using support::motor_390w;

namespace {

const double pi = std::acos(-1.0);

SaturationMap constant_map()
{
    SaturationMap map;
    map.id_A = {-4.0, 0.0, 4.0};
    map.iq_A = {-4.0, 4.0};
    map.ld_H.assign(6, motor_390w().d_axis_inductance_H);
    map.lq_H.assign(6, motor_390w().q_axis_inductance_H);
    return map;
}

SaturationMap falling_map()
{
    SaturationMap map;
    map.id_A = {-4.0, 0.0, 4.0};
    map.iq_A = {-4.0, 0.0, 4.0};
    map.ld_H = {0.075, 0.080, 0.075, 0.070, 0.075, 0.070, 0.060, 0.065, 0.060};
    map.lq_H = {0.090, 0.115, 0.090, 0.085, 0.114, 0.085, 0.080, 0.110, 0.080};
    return map;
}

double energy_J(const Plant &plant, const Motor &m)
{
    const double w_m = plant.omega_e_radps() / m.pole_pairs;
    return 0.5 * m.inertia_kgm2 * w_m * w_m;
}

} // namespace

TEST(Plant, AdvanceFollowsStepClosely)
{
    Plant reference(motor_390w());
    Plant quick(motor_390w());
    reference.reset(300.0, 0.4);
    quick.reset(300.0, 0.4);
    for (int k = 0; k < 5000; k++) {
        const double       angle = 1.3 + 0.06 * k;
        const StatorVector v{90.0 * std::cos(angle), 90.0 * std::sin(angle)};
        reference.step(v, 0.3, 2e-4, 4);
        for (int n = 0; n < 4; n++) {
            quick.advance(v, {0.3, 0.0}, 5e-5);
        }
        const RotorVector a = reference.current_A();
        const RotorVector b = quick.current_A();
        ASSERT_NEAR(a.d, b.d, 1e-9);
        ASSERT_NEAR(a.q, b.q, 1e-9);
        ASSERT_NEAR(reference.omega_e_radps(), quick.omega_e_radps(), 1e-7);
        ASSERT_NEAR(reference.theta_e_rad(), quick.theta_e_rad(), 1e-8);
    }
}

TEST(MotorEffects, ConstantMapIsTheLinearMotorExactly)
{
    Plant        linear(motor_390w());
    Plant        mapped(motor_390w());
    MotorEffects effects;
    effects.saturation = constant_map();
    mapped.set_effects(effects);
    linear.reset(200.0);
    mapped.reset(200.0);
    for (int k = 0; k < 5000; k++) {
        const StatorVector v{80.0 * std::cos(0.05 * k), 80.0 * std::sin(0.05 * k)};
        linear.advance(v, {0.3, 1e-6}, 5e-5);
        mapped.advance(v, {0.3, 1e-6}, 5e-5);
        ASSERT_EQ(linear.current_A().d, mapped.current_A().d);
        ASSERT_EQ(linear.current_A().q, mapped.current_A().q);
        ASSERT_EQ(linear.omega_e_radps(), mapped.omega_e_radps());
    }
}

TEST(MotorEffects, MapIsBilinearAndHeldOutside)
{
    const SaturationMap map = falling_map();
    EXPECT_DOUBLE_EQ(inductance_H(map, {0.0, 0.0}).d, 0.075);
    EXPECT_DOUBLE_EQ(inductance_H(map, {4.0, 4.0}).q, 0.080);
    EXPECT_NEAR(inductance_H(map, {-2.0, 2.0}).d, 0.25 * (0.080 + 0.075 + 0.075 + 0.070), 1e-15);
    EXPECT_DOUBLE_EQ(inductance_H(map, {9.0, 9.0}).q, 0.080);
}

TEST(MotorEffects, CurrentInvertsTheFlux)
{
    const SaturationMap map = falling_map();
    std::mt19937_64     random(5);
    for (int k = 0; k < 2000; k++) {
        std::uniform_real_distribution<> any(-5.0, 5.0);
        const RotorVector                i{any(random), any(random)};
        const RotorVector                L = inductance_H(map, i);
        const RotorVector found            = saturated_current_A(map, {L.d * i.d, L.q * i.q}, {});
        ASSERT_NEAR(found.d, i.d, 1e-9);
        ASSERT_NEAR(found.q, i.q, 1e-9);
    }
}

TEST(MotorEffects, CoulombFrictionTakesItsEnergyAndStops)
{
    Motor m                = motor_390w();
    m.viscous_friction_Nms = 0.0;
    m.pm_flux_Wb           = 0.0; // no electric brake
    MotorEffects effects;
    effects.coulomb_friction_Nm = 0.05;
    Plant plant(m);
    plant.set_effects(effects);
    plant.reset(300.0);
    const double start_J = energy_J(plant, m);
    const double stop_s  = m.inertia_kgm2 * 150.0 / 0.05;
    int          steps   = 0;
    while (plant.omega_e_radps() != 0.0 && steps < 100000) {
        plant.advance({}, {}, 5e-5);
        steps++;
    }
    EXPECT_NEAR(steps * 5e-5, stop_s, 1e-4);
    EXPECT_NEAR(0.05 * plant.theta_e_rad() / m.pole_pairs, start_J, 1e-3 * start_J);
    plant.advance({}, {0.049, 0.0}, 5e-5); // held below the friction ..
    EXPECT_EQ(plant.omega_e_radps(), 0.0);
    plant.advance({}, {0.051, 0.0}, 5e-5); // .. and let go above
    EXPECT_NEAR(plant.omega_e_radps(), -m.pole_pairs * 0.001 / m.inertia_kgm2 * 5e-5, 1e-12);
}

TEST(MotorEffects, CoggingIsConservative)
{
    Motor m                = motor_390w();
    m.viscous_friction_Nms = 0.0;
    m.pm_flux_Wb           = 1e-12;
    MotorEffects effects;
    effects.cogging_amplitude_Nm = 0.1;
    effects.cogging_order        = 24.0;
    effects.cogging_second_Nm    = 0.03;
    effects.cogging_second_rad   = -0.7;
    Plant plant(m);
    plant.set_effects(effects);
    plant.reset(40.0, 0.3);
    const auto total_J =
        [&] { // T = - dW/dtheta, W = -(A / n) cos(n theta) - (B / 2n) cos(2n theta + phase)
            const double angle = 24.0 * plant.theta_e_rad() / m.pole_pairs;
            return energy_J(plant, m) - 0.1 / 24.0 * std::cos(angle) -
                   0.03 / 48.0 * std::cos(2.0 * angle - 0.7);
        };
    const double start_J = total_J();
    double       lowest  = 1e9;
    double       highest = 0.0;
    for (int k = 0; k < 20000; k++) {
        plant.advance({}, {}, 2e-5);
        ASSERT_NEAR(total_J(), start_J, 1e-6 * 0.1);
        lowest  = std::min(lowest, plant.omega_e_radps());
        highest = std::max(highest, plant.omega_e_radps());
    }
    EXPECT_GT(highest - lowest, 1.0);
}

TEST(MotorEffects, FanBrakesWithTheSquare)
{
    Motor m                = motor_390w();
    m.viscous_friction_Nms = 0.0;
    m.pm_flux_Wb           = 1e-12;
    for (double sign : {1.0, -1.0}) {
        Plant plant(m);
        plant.reset(sign * 400.0);
        for (int k = 0; k < 2000; k++) {
            plant.advance({}, {0.0, 1e-5}, 5e-5);
        }
        const double w_m = 200.0 / (1.0 + 200.0 * 1e-5 / m.inertia_kgm2 * 0.1); // w' = -k w^2 / J
        EXPECT_NEAR(plant.omega_e_radps(), sign * m.pole_pairs * w_m, 1e-6);
    }
}

TEST(MotorEffects, DriftIsAShareOfTheStartPerSecond)
{
    EXPECT_DOUBLE_EQ(drifted(2.0, 0.5, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(drifted(2.0, 0.5, 2.0), 4.0);
    EXPECT_DOUBLE_EQ(drifted(2.0, -1.0, 5.0), 0.02);
}

namespace {

MotorEffects harmonics()
{
    MotorEffects e;
    e.flux_5th = 0.03;
    e.flux_7th = -0.02;
    return e;
}

} // namespace

TEST(FluxHarmonics, AreInThePhasesVoltages)
{
    Plant plant(motor_390w());
    plant.set_effects(harmonics());
    for (int k = 0; k < 200; k++) {
        const double theta = -3.0 + 0.05 * k;
        plant.reset(250.0, theta);
        const std::array<double, 3> e = as_array(plant.emf_V());
        for (std::size_t x = 0; x < 3; x++) { // -d/dt of cos + h5 cos 5 + h7 cos 7 of its own angle
            const double at = theta - 2.0 * pi / 3.0 * static_cast<double>(x);
            ASSERT_NEAR(e[x],
                        -250.0 * 0.193 *
                            (std::sin(at) + 5.0 * 0.03 * std::sin(5.0 * at) -
                             7.0 * 0.02 * std::sin(7.0 * at)),
                        1e-9);
        }
    }
}

TEST(FluxHarmonics, CurrentsChangeAsTheRateSaysAndAnOpenPhaseStaysWithoutAny)
{
    Plant plant(motor_390w());
    plant.set_effects(harmonics());
    plant.reset(250.0, 0.3);
    for (int k = 0; k < 300; k++) {
        plant.advance({30.0, -20.0}, {}, 1e-5);
    }
    const StatorVector v{40.0, 10.0};
    const PhaseVector  rate   = plant.phase_current_rate_Aps(v);
    const PhaseVector  before = plant.phase_current_A();
    plant.advance(v, {}, 1e-8);
    EXPECT_NEAR((plant.phase_current_A().a - before.a) / 1e-8, rate.a, 1e-3 * std::abs(rate.a));
    EXPECT_NEAR((plant.phase_current_A().b - before.b) / 1e-8, rate.b, 1e-3 * std::abs(rate.b));

    plant.clear_current(1);
    std::array<double, 3> terminals{100.0, 0.0, 20.0};
    terminals[1] = plant.floating_V(terminals, 1);
    EXPECT_NEAR(plant.phase_current_rate_Aps(clarke(terminals)).b, 0.0, 1e-9);

    plant.clear_current();
    plant.coast({}, 1e-5);
    EXPECT_NEAR(plant.current_A().d, 0.0, 1e-9);
    EXPECT_NEAR(plant.current_A().q, 0.0, 1e-9);
}

/// Power balance with all effects: the input at the terminals is in the copper, the iron, the
/// fields, the masses or the load.
TEST(MotorEffects, PowerBalances)
{
    const Motor  m       = motor_390w();
    MotorEffects e       = harmonics();
    e.iron_hysteresis_Nm = 0.02;
    e.iron_eddy_Nms      = 1e-4;
    for (const double share : {0.0, 0.5}) {
        e.load_inertia_share     = share;
        e.shaft_stiffness_Nmprad = share > 0.0 ? 100.0 : 0.0;
        Plant plant(m);
        plant.set_effects(e);
        plant.reset(300.0, 0.4);
        struct Balance {
            double stored_J, in_W, out_W, iron_W;
        };
        const double load_Nm = 0.4;
        const auto   now     = [&](StatorVector v) {
            const RotorVector  i     = plant.current_A();
            const StatorVector is    = to_stator(i, plant.theta_e_rad());
            const double       c6    = std::cos(6.0 * plant.theta_e_rad());
            const double       s6    = std::sin(6.0 * plant.theta_e_rad());
            const double       psi_d = 0.193 * (1.0 + 0.01 * c6) + m.d_axis_inductance_H * i.d;
            const double       psi_q = -0.193 * 0.05 * s6 + m.q_axis_inductance_H * i.q;
            const double       flux  = (psi_d * psi_d + psi_q * psi_q) / (0.193 * 0.193);
            const double       wm    = 0.5 * plant.omega_e_radps();
            const double       wl    = plant.omega_load_m_radps();
            Balance            b{};
            b.stored_J =
                0.75 * (m.d_axis_inductance_H * i.d * i.d + m.q_axis_inductance_H * i.q * i.q) +
                0.5 * m.inertia_kgm2 * ((1.0 - share) * wm * wm + share * wl * wl) +
                0.5 * e.shaft_stiffness_Nmprad * plant.twist_rad() * plant.twist_rad();
            b.in_W   = 1.5 * (v.alpha * is.alpha + v.beta * is.beta);
            b.iron_W = flux * (0.02 * std::abs(wm) + 1e-4 * wm * wm);
            b.out_W  = 1.5 * m.stator_resistance_Ohm * (i.d * i.d + i.q * i.q) +
                      m.viscous_friction_Nms * wm * wm + load_Nm * wl + b.iron_W;
            return b;
        };
        const double dt_s    = 2e-6;
        const double start_J = now({}).stored_J;
        double       net_J   = 0.0;
        double       iron_J  = 0.0;
        for (int k = 0; k < 40000; k++) {
            const double       at = plant.theta_e_rad() + 1.9;
            const StatorVector v{85.0 * std::cos(at), 85.0 * std::sin(at)};
            const Balance      before = now(v);
            plant.advance(v, {load_Nm}, dt_s);
            const Balance after = now(v);
            net_J += 0.5 * dt_s * (before.in_W - before.out_W + after.in_W - after.out_W);
            iron_J += 0.5 * dt_s * (before.iron_W + after.iron_W);
            ASSERT_NEAR(now(v).stored_J, start_J + net_J, 1e-5) << k; // of some 5 J
        }
        EXPECT_GT(iron_J, 0.2);
    }
}

/// Saturation and harmonics of the magnet together. At rest a locked shaft has i = v / R at every angle. A short pulse of
/// voltage adds its volt-seconds to L(i) i.
TEST(MotorEffects, SaturatedCurrentIsThatOfTheFluxWithoutTheMagnet)
{
    Motor m        = motor_390w();
    m.inertia_kgm2 = 1e9; // locked
    for (double theta = -3.0; theta < 3.1; theta += 0.4) {
        MotorEffects e = harmonics();
        e.saturation   = falling_map();
        Plant plant(m);
        plant.set_effects(e);
        plant.reset(0.0, theta);
        EXPECT_NEAR(std::hypot(plant.current_A().d, plant.current_A().q), 0.0, 1e-9);
        for (const RotorVector wanted : {RotorVector{1.5, 2.5}, {-2.0, 1.0}, {0.5, -3.0}}) {
            const RotorVector v{m.stator_resistance_Ohm * wanted.d,
                                m.stator_resistance_Ohm * wanted.q};
            plant.step(v, 0.0, 1e-5, 1);
            plant.step(v, 0.0, 2.0, 4000); // forty time constants
            EXPECT_NEAR(plant.current_A().d, wanted.d, 1e-6) << theta;
            EXPECT_NEAR(plant.current_A().q, wanted.q, 1e-6) << theta;
        }
        // In a short time the flux linkages grow by the voltage: L(i) i of the map.
        plant.clear_current();
        plant.step(RotorVector{3000.0, -2000.0}, 0.0, 5e-5, 10);
        const RotorVector i = plant.current_A();
        const RotorVector L = inductance_H(falling_map(), i);
        EXPECT_NEAR(L.d * i.d, 3000.0 * 5e-5, 5e-4);
        EXPECT_NEAR(L.q * i.q, -2000.0 * 5e-5, 5e-4);
    }
}

TEST(Iron, BrakesAMotorWithoutCurrentAsItsClosedFormSays)
{
    Motor m                = motor_390w();
    m.viscous_friction_Nms = 0.0;
    MotorEffects e;
    e.iron_hysteresis_Nm = 0.02;
    e.iron_eddy_Nms      = 1e-4;
    for (const double sign : {1.0, -1.0}) {
        Plant plant(m);
        plant.set_effects(e);
        plant.reset(sign * 400.0);
        for (int k = 0; k < 4000; k++) {
            plant.coast({}, 5e-5);
        }
        const double fade = std::exp(-1e-4 / m.inertia_kgm2 * 0.2);
        EXPECT_NEAR(sign * 0.5 * plant.omega_e_radps(), (200.0 + 200.0) * fade - 200.0, 1e-9);
    }
}
