// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "scenario_text.hpp"
#include "shipped_drive.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"
#include "temp_dir.hpp"

namespace {

using support::TempDir;

struct Outcome {
    sdre::Scenario             scenario;
    sdre::SimulationResult     result;
    std::vector<sdre::Metrics> metrics;
};

Outcome run(const sdre::Scenario &scenario)
{
    sdre::SimulationResult     result  = sdre::simulate(scenario);
    std::vector<sdre::Metrics> metrics = sdre::measure(scenario, result.trace);
    return {scenario, std::move(result), std::move(metrics)};
}

sdre::Scenario shipped(const std::string &name)
{
    return sdre::read_scenario_file(std::filesystem::path(SDRE_SOURCE_DIR) /
                                    "host_tools/sil/scenarios" / (name + ".toml"));
}

sdre::Scenario scenario_on(const std::string &drive)
{
    const TempDir dir;
    return sdre::read_scenario_file(dir.write("case.toml", support::scenario_text(drive)));
}

/// 300 rad/s, the load of Fig. 5, 0.4 s.
sdre::Scenario load_step()
{
    sdre::Scenario s        = scenario_on("ipmsm_390w_speed");
    s.duration_s            = 0.4;
    s.initial_speed_e_radps = 300.0;
    s.speed_reference       = {{0.0, 300.0}};
    s.load_torque           = {{0.0, 0.75}, {0.2, 1.5}};
    s.measures[0].time_s    = 0.2;
    return s;
}

double settling_s(const sdre::Metrics &m)
{
    return m.settling_time_s.value_or(std::numeric_limits<double>::infinity());
}

double peak_voltage(const sdre::Trace &trace)
{
    double peak = 0.0;
    for (const sdre::TraceRow &row : trace) {
        peak = std::max(peak, std::hypot(row.vd_V, row.vq_V));
    }
    return peak;
}

double peak_current(const sdre::Trace &trace)
{
    double peak = 0.0;
    for (const sdre::TraceRow &row : trace) {
        peak = std::max(peak, std::hypot(row.id_A, row.iq_A));
    }
    return peak;
}

bool all_finite(const sdre::Trace &trace)
{
    return std::all_of(trace.begin(), trace.end(), [](const sdre::TraceRow &r) {
        return std::isfinite(r.omega_e_radps) && std::isfinite(r.iq_A) && std::isfinite(r.id_A) &&
               std::isfinite(r.vq_V) && std::isfinite(r.vd_V) && std::isfinite(r.d_omega_hat);
    });
}

} // namespace

TEST(ClosedLoop, Fig5LoadStepWithTheRightParameters)
{
    const Outcome r = run(shipped("fig5_load_step"));

    EXPECT_EQ(r.result.fault, 0);
    EXPECT_EQ(r.result.fault_time_s, 0.0);
    EXPECT_EQ(r.result.uncertified.size(), 3U); // the margins of both axes, and L x0.56
    ASSERT_EQ(r.metrics.size(), 2U);
    EXPECT_NEAR(r.metrics[0].d_omega_hat, -3571.0, 0.01 * 3571.0);
    EXPECT_NEAR(r.metrics[1].d_omega_hat, -7143.0, 0.01 * 7143.0);
    EXPECT_LE(settling_s(r.metrics[1]), 0.036);
    EXPECT_LT(r.metrics[0].steady_state_error_e_radps, 0.1);
    EXPECT_LT(r.metrics[1].steady_state_error_e_radps, 0.1);
    EXPECT_GT(r.metrics[1].dip_e_radps, 3.0); // the step is felt
}

TEST(ClosedLoop, Fig6LoadStepWithWrongParameters)
{
    const Outcome r = run(shipped("fig6_load_step_varied"));

    EXPECT_EQ(r.result.fault, 0);
    EXPECT_FALSE(r.result.compiled_table);
    ASSERT_EQ(r.metrics.size(), 2U);
    EXPECT_NEAR(r.metrics[0].d_omega_hat, -2661.0, 0.02 * 2661.0);
    EXPECT_NEAR(r.metrics[1].d_omega_hat, -5339.0, 0.02 * 5339.0);
    EXPECT_NEAR(r.metrics[0].d_q_hat, 158.0, 0.05 * 158.0);
    EXPECT_NEAR(r.metrics[1].d_q_hat, 117.0, 0.05 * 117.0);
    EXPECT_LE(settling_s(r.metrics[1]), 0.0034); // 2.8 ms; the paper has 85
    EXPECT_NEAR(r.metrics[1].dip_e_radps, 4.04, 0.2);
    EXPECT_LT(r.metrics[0].steady_state_error_e_radps, 0.1);
    EXPECT_LT(r.metrics[1].steady_state_error_e_radps, 0.1);
}

TEST(ClosedLoop, Fig7SpeedStepWithWrongParameters)
{
    const Outcome r = run(shipped("fig7_speed_step"));

    EXPECT_EQ(r.result.fault, 0);
    ASSERT_EQ(r.metrics.size(), 2U);
    EXPECT_LE(settling_s(r.metrics[1]), 0.031); // 27.8 ms; the paper has 86
    EXPECT_LT(r.metrics[1].overshoot_e_radps, 0.5);
    EXPECT_LE(r.metrics[1].peak_current_A, 4.1); // 3.96 of 4 that the drive may ask for
    EXPECT_LT(r.metrics[1].steady_state_error_e_radps, 0.1);
    EXPECT_NEAR(r.result.trace.back().omega_e_radps, 400.0, 0.1);
}

TEST(ClosedLoop, Fig8FluxWeakeningStaysWithinItsLimits)
{
    const Outcome r = run(shipped("fig8_flux_weakening"));

    EXPECT_EQ(r.result.fault, 0);
    ASSERT_EQ(r.metrics.size(), 2U);
    EXPECT_TRUE(r.metrics[1].settling_time_s.has_value());
    EXPECT_NEAR(r.result.trace.back().omega_e_radps, 720.0, 7.2);
    EXPECT_LE(peak_voltage(r.result.trace), 173.2 / std::sqrt(3.0) * (1.0 + 1e-3));
    EXPECT_LE(peak_current(r.result.trace), 4.4);
    EXPECT_LT(r.metrics[1].id_A, -0.1); // it does weaken the flux
}

TEST(ClosedLoop, Fig4ParameterStepsKeepTheSpeed)
{
    for (const std::string order : {"0", "1", "2", "3"}) {
        const Outcome r = run(shipped("fig4_parameter_steps_nd" + order));

        EXPECT_EQ(r.result.fault, 0) << order;
        ASSERT_EQ(r.metrics.size(), 3U);
        // Half of every parameter: a limit cycle, its mean 1.3 to 2.0 rad/s beside the reference.
        EXPECT_LT(r.metrics[0].steady_state_error_e_radps, 3.0) << order;
        for (std::size_t i = 1; i < 3; i++) {
            EXPECT_LE(settling_s(r.metrics[i]), 0.02) << order << " " << r.metrics[i].name;
            EXPECT_LT(r.metrics[i].steady_state_error_e_radps, 0.1)
                << order << " " << r.metrics[i].name;
        }
    }
}

TEST(ClosedLoop, DisturbanceIsTheLoadOverTheInertia)
{
    // d_w = -np T / J at rest in the observer: load plus what the model does not know.
    const Outcome r = run(load_step());

    EXPECT_NEAR(r.metrics[0].d_omega_hat, -2.0 * 1.5 / 0.00042, 0.01 * 7143.0);
    EXPECT_NEAR(r.metrics[0].iq_A * 3.0 * (0.193 - 0.03893 * r.metrics[0].id_A),
                1.5 + 0.0001 * 150.0, 2e-3); // torque balance; measured 2e-4
}

TEST(ClosedLoop, SameScenarioSameTrace)
{
    const Outcome first  = run(shipped("fig5_load_step"));
    const Outcome second = run(shipped("fig5_load_step"));

    ASSERT_EQ(first.result.trace.size(), second.result.trace.size());
    for (std::size_t k = 0; k < first.result.trace.size(); k++) {
        const sdre::TraceRow &a = first.result.trace[k];
        const sdre::TraceRow &b = second.result.trace[k];
        ASSERT_EQ(a.omega_e_radps, b.omega_e_radps);
        ASSERT_EQ(a.iq_A, b.iq_A);
        ASSERT_EQ(a.vq_V, b.vq_V);
        ASSERT_EQ(a.d_omega_hat, b.d_omega_hat);
    }
}

TEST(ClosedLoop, TraceHasOneRowPerPeriodAndTheCommands)
{
    const Outcome r = run(load_step());

    ASSERT_EQ(r.result.trace.size(), 2001U);
    EXPECT_EQ(r.result.trace[0].time_s, 0.0);
    EXPECT_EQ(r.result.trace[0].omega_e_radps, 300.0);
    EXPECT_EQ(r.result.trace[0].iq_A, 0.0);
    EXPECT_NEAR(r.result.trace[2000].time_s, 0.4, 1e-12);
    EXPECT_EQ(r.result.trace[999].load_torque_Nm, 0.75);
    EXPECT_EQ(r.result.trace[1000].load_torque_Nm, 1.5);
    EXPECT_EQ(r.result.trace[1000].omega_ref_e_radps, 300.0);
    EXPECT_NEAR(r.result.trace[2000].torque_Nm, 1.5 + 0.0001 * 150.0, 2e-3);
    EXPECT_GT(r.result.simulated_seconds_per_second, 0.0);
}

TEST(ClosedLoop, VoltageActsOnePeriodAfterItsTick)
{
    sdre::Scenario s        = load_step();
    s.duration_s            = 0.002;
    s.initial_speed_e_radps = 0.0;
    s.speed_reference       = {{0.0, 50.0}};
    s.load_torque           = {};
    s.measures.clear();

    const auto trace = sdre::simulate(s).trace;

    // The speed reference moves from the second tick on, within the current range of the first.
    ASSERT_EQ(trace[0].vq_V, 0.0);
    EXPECT_NE(trace[1].vq_V, 0.0); // computed from this sample,
    EXPECT_EQ(trace[1].iq_A, 0.0);
    EXPECT_EQ(trace[2].iq_A, 0.0); // not yet in force in the period that follows,
    EXPECT_NE(trace[3].iq_A, 0.0); // felt at the end of the one after it
    EXPECT_NEAR(trace[3].iq_A, trace[1].vq_V * 2e-4 / 0.11391, 0.01 * trace[3].iq_A);
}

TEST(ClosedLoop, ServoRejectsALoadStep)
{
    sdre::Scenario s           = scenario_on("servo_200w");
    s.duration_s               = 0.4;
    s.initial_speed_e_radps    = 400.0;
    s.speed_reference          = {{0.0, 400.0}};
    s.load_torque              = {{0.2, 0.64}};
    s.measures[0].time_s       = 0.2;
    s.measures[0].band_e_radps = 4.0;

    const Outcome r = run(s);

    EXPECT_EQ(r.result.fault, 0);
    EXPECT_EQ(r.result.trace.size(), 4001U); // two control periods per PWM period
    EXPECT_TRUE(r.metrics[0].settling_time_s.has_value());
    EXPECT_LT(r.metrics[0].steady_state_error_e_radps, 0.1);
    EXPECT_NEAR(r.metrics[0].d_omega_hat, -4.0 * 0.64 / 0.000135, 0.01 * 18963.0);
    EXPECT_NEAR(r.metrics[0].id_A, 0.0, 0.01);
}

TEST(ClosedLoop, MotorMayDifferInOneParameterByHalfOrTwice)
{
    for (const std::string key :
         {"stator_resistance_Ohm", "d_axis_inductance_H", "q_axis_inductance_H", "pm_flux_Wb",
          "inertia_kgm2", "viscous_friction_Nms"}) {
        for (const double factor : {0.5, 1.5, 2.0}) {
            sdre::Scenario s = load_step();
            s.plant_scale    = {{key, factor}};

            const Outcome r = run(s);

            EXPECT_EQ(r.result.fault, 0) << key << " " << factor;
            EXPECT_TRUE(all_finite(r.result.trace));
            // Twice Ld turns the reluctance torque around, so that the current limit is too low for the
            // load; with twice Lq the current loop oscillates. Neither trips.
            const bool inductance = key == "d_axis_inductance_H" || key == "q_axis_inductance_H";
            if (!inductance || factor < 2.0) {
                EXPECT_LE(settling_s(r.metrics[0]), 0.02) << key << " " << factor; // measured 9 ms
                EXPECT_LT(r.metrics[0].steady_state_error_e_radps, 0.1) << key << " " << factor;
            }
        }
    }
}

TEST(ClosedLoop, ControllerMayBelieveOneParameterWrong)
{
    for (const auto &[key, factor] : std::vector<std::pair<std::string, double>>{
             {"q_axis_inductance_H", 2.0}, {"d_axis_inductance_H", 0.5}, {"inertia_kgm2", 0.5}}) {
        sdre::Scenario s   = load_step();
        s.controller_scale = {{key, factor}};

        const Outcome r = run(s);

        EXPECT_EQ(r.result.fault, 0) << key;
        EXPECT_FALSE(r.result.compiled_table);
        EXPECT_LT(r.metrics[0].steady_state_error_e_radps, 0.1) << key;
    }
}

TEST(ClosedLoop, MirroredCommandsGiveAMirroredTrace)
{
    constexpr double speed_tolerance   = 1e-3; // rad/s; single precision in the core
    constexpr double current_tolerance = 1e-3; // A
    sdre::Scenario   s                 = load_step();
    s.speed_reference.push_back({0.1, 350.0});
    const auto forward      = sdre::simulate(s).trace;
    s.initial_speed_e_radps = -s.initial_speed_e_radps;
    for (sdre::Step &step : s.speed_reference) {
        step.value = -step.value;
    }
    for (sdre::Step &step : s.load_torque) {
        step.value = -step.value;
    }

    const auto backward = sdre::simulate(s).trace;

    ASSERT_EQ(forward.size(), backward.size());
    double speed = 0.0, iq = 0.0, id = 0.0;
    for (std::size_t k = 0; k < forward.size(); k++) {
        speed = std::max(speed, std::abs(forward[k].omega_e_radps + backward[k].omega_e_radps));
        iq    = std::max(iq, std::abs(forward[k].iq_A + backward[k].iq_A));
        id    = std::max(id, std::abs(forward[k].id_A - backward[k].id_A));
    }
    EXPECT_LT(speed, speed_tolerance);
    EXPECT_LT(iq, current_tolerance);
    EXPECT_LT(id, current_tolerance);
}

TEST(ClosedLoop, OverSpeedOpensTheGates)
{
    sdre::Scenario s = load_step();
    s.duration_s     = 0.2;
    s.load_torque    = {{0.02, -8.0}}; // drives the motor beyond anything it can hold
    s.measures.clear();

    const auto r = sdre::simulate(s);

    ASSERT_NE(r.fault, 0);
    EXPECT_GT(r.fault_time_s, 0.02);
    EXPECT_TRUE(all_finite(r.trace));
    for (const sdre::TraceRow &row : r.trace) {
        if (row.time_s > r.fault_time_s) {
            EXPECT_EQ(row.vq_V, 0.0);
            EXPECT_EQ(row.vd_V, 0.0);
        }
    }
}

TEST(ClosedLoop, StartBeyondTheTripSpeedNeverDrives)
{
    sdre::Scenario s        = load_step();
    s.duration_s            = 0.05;
    s.initial_speed_e_radps = 1600.0; // trip at 1569
    s.load_torque           = {};
    s.measures.clear();

    const auto r = sdre::simulate(s);

    EXPECT_EQ(r.fault, DRIVE_FAULT_OVER_SPEED);
    EXPECT_EQ(r.fault_time_s, 0.0);
    EXPECT_LT(r.trace.back().omega_e_radps, 1600.0); // the diodes brake: the emf exceeds the link
    EXPECT_EQ(peak_voltage(r.trace), 0.0);
    EXPECT_TRUE(all_finite(r.trace));
}

TEST(ClosedLoop, SupplyOutsideItsRangeIsAFault)
{
    for (const double dc_link_V : {50.0, 450.0}) {
        sdre::Scenario s = load_step();
        s.duration_s     = 0.01;
        s.dc_link_V      = dc_link_V;

        EXPECT_EQ(sdre::simulate(s).fault, DRIVE_FAULT_DC_LINK) << dc_link_V;
    }
}

TEST(ClosedLoop, ImpossibleCommandIsAFault)
{
    sdre::Scenario s  = load_step();
    s.duration_s      = 0.01;
    s.speed_reference = {{0.005, 5000.0}};

    const auto r = sdre::simulate(s);

    EXPECT_EQ(r.fault, DRIVE_FAULT_COMMAND);
    EXPECT_NEAR(r.fault_time_s, 0.005, 1e-12);
}

TEST(ClosedLoop, FaultOpensTheGatesInTheSamePeriod)
{
    sdre::Scenario s = load_step();
    s.duration_s     = 0.11;
    s.speed_reference.push_back({0.1, 5000.0}); // out of range: a fault in steady state

    const auto r = sdre::simulate(s);

    const auto current = [&](std::size_t k) {
        return std::hypot(r.trace[k].id_A, r.trace[k].iq_A);
    };
    ASSERT_EQ(r.fault, DRIVE_FAULT_COMMAND);
    ASSERT_NEAR(r.fault_time_s, 0.1, 1e-12);
    EXPECT_NEAR(current(500), current(499), 1e-3);
    EXPECT_LT(current(501), 0.8 * current(500)); // the diodes oppose it at once; measured 0.7
}

TEST(ClosedLoop, SpeedIsHeldWhereNoReferenceIsGiven)
{
    sdre::Scenario s = load_step();
    s.speed_reference.clear();
    s.load_torque.clear();
    s.duration_s = 0.3;

    const auto trace = sdre::simulate(s).trace;

    EXPECT_EQ(trace.front().omega_ref_e_radps, 300.0);
    EXPECT_NEAR(trace.back().omega_e_radps, 300.0, 0.1);
}

TEST(ClosedLoop, PlantChangesInFlight)
{
    sdre::Scenario s = load_step();
    s.load_torque    = {{0.0, 1.0}};
    s.changes.resize(1);
    s.changes[0].time_s      = 0.2;
    s.changes[0].plant_scale = {{"pm_flux_Wb", 1.5}};

    const auto trace = sdre::simulate(s).trace;

    EXPECT_NEAR(trace[999].torque_Nm, 1.0, 0.05);
    EXPECT_GT(trace[1000].torque_Nm, 1.3); // same current, more flux
    EXPECT_NEAR(trace[1000].iq_A, trace[999].iq_A, 0.01);
}

TEST(ClosedLoop, SeriesOrderOfTheScenarioIsUsed)
{
    sdre::Scenario s = load_step();
    s.drive          = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    s.duration_s     = 0.01;
    EXPECT_TRUE(sdre::simulate(s).compiled_table);
    s.nosc_order = s.drive.nosc.order;
    s.nodo_order = s.drive.nodo.order;
    EXPECT_TRUE(sdre::simulate(s).compiled_table);
    s.nosc_order = 0;
    EXPECT_FALSE(sdre::simulate(s).compiled_table);
}

TEST(ClosedLoop, UncertifiedGainsAreNamed)
{
    sdre::Scenario s                  = load_step();
    s.duration_s                      = 0.01;
    s.drive.inverter.pwm_frequency_Hz = 1000.0;

    const auto r = sdre::simulate(s);

    EXPECT_FALSE(r.uncertified.empty());
    EXPECT_EQ(r.trace.size(), 11U);
}

TEST(ClosedLoop, SaliencyTheCoreRefusesIsADesignError)
{
    sdre::Scenario s   = load_step();
    s.controller_scale = {{"d_axis_inductance_H", 2.0}}; // Ld > Lq

    EXPECT_THROW(sdre::simulate(s), sdre::DesignError);
}

TEST(ClosedLoop, FaultsHaveNames)
{
    EXPECT_STREQ(sdre::fault_name(DRIVE_FAULT_NONE), "none");
    EXPECT_STREQ(sdre::fault_name(DRIVE_FAULT_SAMPLE), "invalid sample");
    EXPECT_STREQ(sdre::fault_name(DRIVE_FAULT_OVER_CURRENT), "over current");
    EXPECT_STREQ(sdre::fault_name(DRIVE_FAULT_DC_LINK), "dc link out of range");
    EXPECT_STREQ(sdre::fault_name(DRIVE_FAULT_OVER_SPEED), "over speed");
    EXPECT_STREQ(sdre::fault_name(DRIVE_FAULT_COMMAND), "command out of range");
    EXPECT_STREQ(sdre::fault_name(DRIVE_FAULT_NUMERIC), "law not a number");
}
