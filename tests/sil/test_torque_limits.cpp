// SPDX-License-Identifier: MIT
// The limits of a torque run are those of a speed run: each is tried in both, in the same situation.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "seeded_runs.hpp"
#include "sil/run/board.hpp"
#include "sil/run/simulation.hpp"

namespace {

constexpr double rated_Nm = 1.5;
constexpr double begin_s  = 0.05; // steady before
constexpr double end_s    = 0.2;
constexpr double tail_s   = 0.15;

struct Point {
    double id_A, iq_A;
};

double torque_Nm(const sdre::Motor &m, const Point &i)
{
    const double flux = m.pm_flux_Wb + (m.d_axis_inductance_H - m.q_axis_inductance_H) * i.id_A;
    return 1.5 * m.pole_pairs * flux * i.iq_A;
}

bool is_within(const sdre::Motor &m, const Point &i, double w, double current_A, double voltage_V)
{
    const double vd = m.stator_resistance_Ohm * i.id_A - w * m.q_axis_inductance_H * i.iq_A;
    const double vq =
        m.stator_resistance_Ohm * i.iq_A + w * (m.d_axis_inductance_H * i.id_A + m.pm_flux_Wb);
    return std::hypot(i.id_A, i.iq_A) <= current_A && std::hypot(vd, vq) <= voltage_V;
}

/// The largest torque of this sign within both circles, by trying all currents of a grid.
double largest_Nm(const sdre::Motor &m, double w, double sign, double current_A, double voltage_V)
{
    constexpr double step_A = 0.02;
    double           most   = 0.0;
    for (double id = -current_A; id <= 0.0; id += step_A) {
        for (double iq = 0.0; iq <= current_A; iq += step_A) {
            const Point i{id, sign * iq};
            if (is_within(m, i, w, current_A, voltage_V)) {
                most = std::max(most, sign * torque_Nm(m, i));
            }
        }
    }
    return sign * most;
}

/// A run that holds a speed, and from begin_s on meets a limit: its load is about what the limit leaves.
sdre::Scenario limited(double speed, double load_Nm)
{
    sdre::Scenario s        = sdre_test::shipped("board_torque", "ipmsm_390w");
    s.sensors               = sdre::SensorSettings();
    s.sensors.ideal         = true;
    s.initial_speed_e_radps = speed;
    s.speed_reference       = {{0.0, speed}};
    s.torque_reference      = {};
    s.load_torque           = {{begin_s, load_Nm}};
    s.duration_s            = end_s;
    s.measures.clear();
    return s;
}

/// Asks for more torque than there is.
sdre::Scenario by_torque(sdre::Scenario s, double asked_Nm)
{
    s.torque_reference = {{begin_s, asked_Nm}};
    return s;
}

/// Asks for more speed than there is torque for.
sdre::Scenario by_speed(sdre::Scenario s, double step_e_radps)
{
    s.speed_reference.push_back({begin_s, s.initial_speed_e_radps + step_e_radps});
    return s;
}

/// As simulate(), with a share of the current limit that cannot be used.
sdre::Trace derated_run(const sdre::Scenario &s, float derating)
{
    const sdre::Controller controller = sdre::prepare_controller(s);
    const double           ts         = sdre::control_period_s(s.drive);
    sdre::StepCursor       speed(s.speed_reference, s.initial_speed_e_radps);
    sdre::TorqueCommands   torques(s, controller.config);
    sdre::Board            board(s);
    drive_t                drive{};
    bridge_t               in_force{};
    sdre::Trace            trace;
    EXPECT_EQ(drive_init(&drive, &controller.config), CTL_OK);
    for (long k = 0; k < sdre::ticks_of(s); k++) {
        const double t = static_cast<double>(k) * ts;
        board.begin_tick(t);
        const drive_sample_t  sample = board.sample();
        const law_aim_t       aim{nullptr, torques.at(t)};
        const drive_command_t command{static_cast<float>(speed.at(t)), true, derating,
                                      aim.torque != nullptr ? &aim : nullptr};
        const bridge_t        next = drive_tick(&drive, &sample, &command);
        trace.push_back(sdre::row_of(t, speed.at(t), board.plant_state()));
        board.run_period(in_force);
        in_force = next;
    }
    EXPECT_EQ(drive.fault, DRIVE_FAULT_NONE);
    return trace;
}

struct Mean {
    double id_A = 0.0, iq_A = 0.0, torque_Nm = 0.0, omega_e_radps = 0.0;
};

Mean mean_of(const sdre::Trace &trace)
{
    Mean   m;
    double n = 0.0;
    for (const sdre::TraceRow &r : trace) {
        if (r.time_s >= tail_s) {
            m.id_A += r.id_A;
            m.iq_A += r.iq_A;
            m.torque_Nm += r.torque_Nm;
            m.omega_e_radps += r.omega_e_radps;
            n++;
        }
    }
    return {m.id_A / n, m.iq_A / n, m.torque_Nm / n, m.omega_e_radps / n};
}

Mean mean_of(const sdre::Scenario &s)
{
    const sdre::SimulationResult run = sdre::simulate(s);
    EXPECT_EQ(run.fault, 0);
    return mean_of(run.trace);
}

void expect_same(const Mean &torque, const Mean &speed, double tol_Nm)
{
    EXPECT_NEAR(torque.torque_Nm, speed.torque_Nm, tol_Nm);
    EXPECT_NEAR(torque.id_A, speed.id_A, 0.05);
    EXPECT_NEAR(torque.iq_A, speed.iq_A, 0.05);
}

double highest_dc_link_V(const sdre::Trace &trace)
{
    double most = 0.0;
    for (const sdre::TraceRow &r : trace) {
        most = std::max(most, r.dc_link_V);
    }
    return most;
}

} // namespace

/// Nothing limits: the currents of a torque are those of a speed run with that load.
TEST(TorqueLimits, ATorqueHasTheCurrentsOfASpeedRunInAllQuadrants)
{
    for (const double speed : {-262.0, 262.0}) {
        for (const double torque : {-rated_Nm, -0.4, 0.4, rated_Nm}) {
            SCOPED_TRACE(std::to_string(speed) + " " + std::to_string(torque));
            const sdre::Scenario s    = limited(speed, torque);
            const sdre::Motor   &m    = s.drive.motor;
            const double         drag = m.viscous_friction_Nms * speed / m.pole_pairs;
            expect_same(mean_of(by_torque(s, torque + drag)), mean_of(s), 0.005);
        }
    }
}

TEST(TorqueLimits, TheCurrentLimitIsThatOfASpeedRunInAllQuadrants)
{
    for (const double speed : {-200.0, 200.0}) {
        for (const double sign : {-1.0, 1.0}) {
            SCOPED_TRACE(std::to_string(speed) + " " + std::to_string(sign));
            const sdre::Motor   &m    = limited(speed, 0.0).drive.motor;
            const double         most = largest_Nm(m, speed, sign, m.max_current_A, 1e9);
            const sdre::Scenario s    = limited(speed, most);
            const Mean           held = mean_of(by_torque(s, 9.0 * sign));
            EXPECT_NEAR(std::hypot(held.id_A, held.iq_A), m.max_current_A, 0.02);
            EXPECT_NEAR(held.torque_Nm, most, 0.01 * rated_Nm);
            expect_same(held, mean_of(by_speed(s, 200.0 * sign)), 0.02);
        }
    }
}

/// Far beyond the speed at which the voltage is enough without weakening the flux. Either run has the same share of what the circle
/// of the voltage leaves at its speed.
TEST(TorqueLimits, TheVoltageLimitIsThatOfASpeedRun)
{
    for (const double sign : {-1.0, 1.0}) {
        const double      speed = 900.0 * sign;
        const sdre::Drive drive = limited(speed, 0.0).drive;
        const auto        share = [&](const Mean &m) {
            return m.torque_Nm / largest_Nm(drive.motor, m.omega_e_radps, sign, 4.0,
                                                   drive.inverter.dc_link_V / std::sqrt(3.0));
        };
        const sdre::Scenario s    = limited(speed, 1.4 * sign);
        const Mean           held = mean_of(by_torque(s, 2.0 * rated_Nm * sign));
        const Mean           run  = mean_of(by_speed(s, 100.0 * sign));
        EXPECT_NEAR(sign * held.omega_e_radps, 900.0, 50.0);
        EXPECT_LT(share(held), 1.01);
        EXPECT_GT(share(held), 0.95);
        EXPECT_NEAR(share(held), share(run), 0.01);
    }
}

TEST(TorqueLimits, ADeratedCurrentLimitIsThatOfASpeedRun)
{
    for (const float derating : {0.0F, 0.3F, 0.6F}) {
        for (const double sign : {-1.0, 1.0}) {
            const double         speed = 200.0;
            const sdre::Motor   &m     = limited(speed, 0.0).drive.motor;
            const double         left  = m.max_current_A * (1.0 - static_cast<double>(derating));
            const double         most  = largest_Nm(m, speed, sign, left, 1e9);
            const sdre::Scenario s     = limited(speed, most);
            const Mean           held  = mean_of(derated_run(by_torque(s, 9.0 * sign), derating));
            const Mean           run   = mean_of(derated_run(by_speed(s, 200.0 * sign), derating));
            EXPECT_LE(std::hypot(held.id_A, held.iq_A), left + 0.02);
            EXPECT_GT(sign * held.torque_Nm, 0.9 * sign * most); // the limit of i_q is derated too
            expect_same(held, run, 0.01);
        }
    }
}

/// Braking behind a rectifier: by a torque, and by a speed step. Without the limit of the regenerated power both trip.
TEST(TorqueLimits, ABrakingTorqueIsGivenUpAtTheDcLinksLimit)
{
    sdre::Scenario braking         = sdre_test::shipped("board_regeneration", "ipmsm_390w");
    braking.inverter.capacitance_F = 0.5e-3;
    sdre::Scenario torque          = braking;
    torque.speed_reference.resize(1);
    torque.torque_reference         = {{0.2, -rated_Nm}};
    torque.torque_speed_max_e_radps = 800.0;

    const sdre::Controller own                  = sdre::prepare_controller(braking);
    sdre::Controller       blind                = own;
    law_noc_config_t       laws                 = *sdre::constants_of<law_noc_config_t>(own.config);
    laws.near_optimal.current_ref.regen_start_V = 1e6F;
    sdre::set_law(blind.config, laws);

    const auto by_speed  = sdre::simulate(braking, own);
    const auto by_torque = sdre::simulate(torque, own);
    EXPECT_EQ(by_torque.fault, 0);
    EXPECT_GT(highest_dc_link_V(by_torque.trace), 345.0); // the limit was needed
    EXPECT_LT(highest_dc_link_V(by_torque.trace), 372.0);
    EXPECT_NEAR(highest_dc_link_V(by_torque.trace), highest_dc_link_V(by_speed.trace), 4.0);
    for (const sdre::TraceRow &r : by_torque.trace) {
        if (r.dc_link_V > 365.0 && r.omega_e_radps > 200.0) {
            EXPECT_GT(r.torque_Nm, -0.5 * rated_Nm) << r.time_s;
        }
    }
    EXPECT_EQ(sdre::simulate(torque, blind).fault, DRIVE_FAULT_DC_LINK);
    EXPECT_EQ(sdre::simulate(braking, blind).fault, DRIVE_FAULT_DC_LINK);
}
