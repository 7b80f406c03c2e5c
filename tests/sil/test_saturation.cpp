// SPDX-License-Identifier: MIT
/// The plant with a map of the iron is compared with a machine in closed form. The map comes from the drive file.
#include <cmath>

#include <gtest/gtest.h>

#include "common/toml_reader.hpp"
#include "iron.hpp"
#include "plant_motor.hpp"
#include "sil/plant/plant.hpp"
#include "sil/run/simulation.hpp"
#include "sil/setup/scenario.hpp"

namespace {

using sdre::Plant;
using sdre::RotorVector;
using sdre::StatorVector;
using support::Iron;

sdre::MotorEffects effects_of(const Iron &iron)
{
    sdre::MotorEffects e;
    e.flux = sdre::SaturatedMotor(std::make_shared<const sdre::FluxMap>(
        support::fine_id_axis, support::fine_iq_axis,
        support::psi_d(iron, support::fine_id_axis, support::fine_iq_axis),
        support::psi_q(iron, support::fine_id_axis, support::fine_iq_axis)));
    return e;
}

/// At 300 rad/s with a load of 1.5 N m.
sdre::PlantState steady(const sdre::Drive &drive, const std::string &more = "")
{
    const auto s = sdre::read_scenario_table(
        sdre::parse_toml_text("duration_s = 0.3\ninitial_speed_e_radps = 300\n"
                              "[[speed_reference]]\ntime_s = 0\nvalue_e_radps = 300\n"
                              "[[load_torque]]\ntime_s = 0\nvalue_Nm = 1.5\n" +
                                  more,
                              "steady"),
        "steady", "steady", drive, drive.law);
    const auto result = sdre::simulate(s, sdre::prepare_controller(s));
    EXPECT_EQ(result.fault, 0);
    const sdre::TraceRow &end = result.trace.back();
    sdre::PlantState      x;
    x.current_A     = {end.id_A, end.iq_A};
    x.omega_e_radps = end.omega_e_radps;
    return x;
}

double torque_Nm(const Iron &iron, RotorVector i)
{
    return 3.0 * (iron.psi_d(i.d, i.q) * i.q - iron.psi_q(i.d, i.q) * i.d);
}

/// Energy of the field: co-energy in closed form, taken from the product of fluxes and currents.
double field_J(const Iron &iron, RotorVector i)
{
    const double i_m = iron.magnet_Wb / iron.ld_H;
    const auto   u   = [&](double d, double q) {
        return 0.5 * (iron.ld_H * d * d + iron.lq_H * q * q);
    };
    const double first = 1.0 + iron.b * u(i_m, 0.0);
    const double co    = first / iron.b * std::log((1.0 + iron.b * u(i.d + i_m, i.q)) / first);
    return 1.5 * (iron.psi_d(i.d, i.q) * i.d + iron.psi_q(i.d, i.q) * i.q - co);
}

} // namespace

TEST(Saturation, MapOfConstantInductancesIsTheLinearMotor)
{
    Iron linear;
    linear.b = 0.0;
    Plant plain(support::motor_390w());
    Plant mapped(support::motor_390w());
    mapped.set_effects(effects_of(linear));
    plain.reset(200.0);
    mapped.reset(200.0);
    for (int k = 0; k < 4000; k++) {
        const StatorVector v{80.0 * std::cos(0.05 * k), 80.0 * std::sin(0.05 * k)};
        plain.advance(v, {0.3}, 5e-5);
        mapped.advance(v, {0.3}, 5e-5);
        ASSERT_NEAR(plain.current_A().d, mapped.current_A().d, 1e-8);
        ASSERT_NEAR(plain.current_A().q, mapped.current_A().q, 1e-8);
        ASSERT_NEAR(plain.omega_e_radps(), mapped.omega_e_radps(), 1e-6);
    }
}

/// The terminals' energy goes into the winding's heat, the shaft and the field.
TEST(Saturation, EnergyIsKept)
{
    const Iron  iron;
    sdre::Motor m          = support::motor_390w();
    m.viscous_friction_Nms = 0.0;
    Plant plant(m);
    plant.set_effects(effects_of(iron));
    plant.reset(300.0);
    constexpr double dt_s     = 1e-5;
    double           fed_J    = 0.0;
    double           heat_J   = 0.0;
    double           shaft_J  = 0.0;
    const double     before_J = field_J(iron, {});
    for (int k = 0; k < 3000; k++) {
        const RotorVector v{-60.0 + 10.0 * std::sin(1e-2 * k), 80.0 + 20.0 * std::sin(2e-2 * k)};
        const RotorVector a   = plant.current_A();
        const double      w_a = plant.omega_e_radps();
        const double      T_a = plant.torque_Nm();
        plant.step(v, 0.0, dt_s, 1);
        const RotorVector b = plant.current_A();
        fed_J += dt_s * 0.75 * (v.d * (a.d + b.d) + v.q * (a.q + b.q));
        heat_J +=
            dt_s * 0.75 * m.stator_resistance_Ohm * (a.d * a.d + a.q * a.q + b.d * b.d + b.q * b.q);
        shaft_J += dt_s * 0.25 * (T_a + plant.torque_Nm()) * (w_a + plant.omega_e_radps()) / 2.0;
    }
    EXPECT_GT(std::abs(field_J(iron, plant.current_A()) - before_J), 0.05);
    EXPECT_NEAR(fed_J - heat_J - shaft_J, field_J(iron, plant.current_A()) - before_J,
                2e-3 * std::abs(fed_J));
}

TEST(Saturation, CurrentRisesWithTheIncrementalInductance)
{
    Iron iron;
    iron.b = 0.45;
    Plant plant(support::motor_390w());
    plant.set_effects(effects_of(iron));
    plant.reset(0.0);
    for (int k = 0; k < 4000; k++) { // heavy shaft: towards 3.5 A on the q axis
        plant.step(RotorVector{0.0, 2.48 * 3.5}, 3.0 * 0.1 * plant.current_A().q, 1e-6, 1);
    }
    const RotorVector i  = plant.current_A();
    const auto        f  = effects_of(iron).flux->at(i.d, i.q);
    const auto        r  = plant.phase_current_rate_Aps({0.0, 10.0}); // along the q axis at angle 0
    const auto        di = sdre::by_inductance(f, -2.48 * i.d, 10.0 - 2.48 * i.q);
    EXPECT_NEAR(plant.theta_e_rad(), 0.0, 0.05);
    EXPECT_NEAR(r.a, di[0], 0.06 * std::abs(di[1]));
    EXPECT_NEAR((r.b - r.c) / std::sqrt(3.0), di[1], 0.06 * std::abs(di[1]));
}

TEST(Saturation, RunsWithTheMapOfTheDriveFile)
{
    Iron iron;
    iron.b                       = 0.4;
    const auto       drive       = support::saturated_drive(iron);
    const auto       x           = steady(drive);
    constexpr double friction_Nm = 1e-4 * 150.0;
    EXPECT_NEAR(x.omega_e_radps, 300.0, 0.05);
    EXPECT_NEAR(torque_Nm(iron, x.current_A), 1.5 + friction_Nm, 5e-3);
    EXPECT_NEAR(x.current_A.d, -0.5 * x.current_A.q * x.current_A.q / drive.motor.mtpa.k_A, 0.03);

    // A machine with another L and magnet has the map so scaled.
    const auto other = steady(drive, "[plant_scale]\npm_flux_Wb = 1.1\nd_axis_inductance_H = 0.9\n"
                                     "q_axis_inductance_H = 0.9\n");
    const auto T     = [&](RotorVector i) {
        const double d = 1.1 * 0.193 + 0.9 * (iron.psi_d(i.d, i.q) - 0.193);
        return 3.0 * (d * i.q - 0.9 * iron.psi_q(i.d, i.q) * i.d);
    };
    EXPECT_NEAR(T(other.current_A), 1.5 + friction_Nm, 5e-3);
}

TEST(Saturation, ScenarioHasItsOwnIron)
{
    Iron iron;
    iron.b = 0.4;
    const auto x =
        steady(support::saturated_drive(iron), "[motor_effects]\nid_A = [-5, 5]\niq_A = [-5, 5]\n"
                                               "ld_H = [0.07, 0.07, 0.07, 0.07]\n"
                                               "lq_H = [0.1, 0.1, 0.1, 0.1]\n");
    EXPECT_NEAR(3.0 * (0.193 + (0.07 - 0.1) * x.current_A.d) * x.current_A.q, 1.515, 5e-3);
}
