// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "common/toml_reader.hpp"
#include "shipped_drive.hpp"
#include "sil/eval/bench.hpp"
#include "sil/eval/pi_foc.hpp"
#include "sil/eval/seeds.hpp"
#include "sil/run/board.hpp"
#include "sil/run/simulation.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

const std::string head =
    "drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w_speed.toml\"\n"
    "duration_s = 0.05\ninitial_speed_e_radps = 300.0\n";
/// Voltages are given in the open loop: with the rotor where the seed would put it they would move it at once.
const std::string at_zero = "initial_angle_e_rad = 0.0\n";

const std::string body = "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = 300.0\n"
                         "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = 0.75\n"
                         "[[measure]]\nname = \"start\"\ntime_s = 0.0\nband_e_radps = 3.0\n";

Scenario read(const std::string &text)
{
    const support::TempDir dir;
    return read_scenario_file(dir.write("s.toml", text));
}

std::string error_of(const std::string &text)
{
    try {
        read(text);
    } catch (const InputError &e) {
        return e.what();
    }
    return "";
}

bool same(const SimulationResult &a, const SimulationResult &b)
{
    return std::equal(a.trace.begin(), a.trace.end(), b.trace.begin(), b.trace.end(),
                      [](const TraceRow &x, const TraceRow &y) {
                          return x.omega_e_radps == y.omega_e_radps && x.iq_A == y.iq_A &&
                                 x.vq_V == y.vq_V;
                      });
}

/// Period by period without a controller: a constant duty vector that turns with the rotor.
bridge_t open_loop(double angle)
{
    const auto leg = [&](double shift) {
        return static_cast<float>(0.5 + 0.2 * std::cos(angle - shift));
    };
    return {{leg(0.0), leg(2.0943951), leg(4.1887902)}, true};
}

} // namespace

TEST(RealisticScenario, DefaultsAreTheShippedBoard)
{
    const Scenario s = read(head + body + "[sensors]\n");
    EXPECT_FALSE(s.sensors.ideal);
    EXPECT_EQ(s.drive.encoder.lines, 2500);
    EXPECT_EQ(s.sensors.adc_bits, 12);
    EXPECT_DOUBLE_EQ(s.sensors.adc_full_scale_A, 10.0);
    EXPECT_DOUBLE_EQ(s.sensors.adc_noise_rms_A, 0.010);
    EXPECT_DOUBLE_EQ(s.drive.inverter.dead_time_s, 3e-6);
    EXPECT_DOUBLE_EQ(s.dc_link_V, 295.0);
    EXPECT_EQ(s.seed, 1U);
    EXPECT_TRUE(read(head + body).sensors.ideal);
    EXPECT_TRUE(read(head + body + "[sensors]\nideal = true\n").sensors.ideal);
}

TEST(RealisticScenario, SamplesAreQuantised)
{
    const Scenario s = read(head + body +
                            "[sensors]\nadc_noise_rms_A = 0.0\nencoder_quadrature_error_cnt = 0.0\n"
                            "encoder_duty_error_cnt = 0.0\nencoder_jitter_rms_cnt = 0.0\n");
    Board          board(s);
    double         angle = 2.0;
    for (int k = 0; k < 500; k++) {
        board.begin_tick(2e-4 * k);
        const drive_sample_t sample = board.sample();
        const PhaseVector    i      = board.plant().phase_current_A();
        const double         lsb    = 20.0 / 4096.0;
        ASSERT_LE(std::abs(static_cast<double>(sample.ia_A) - i.a), 0.5 * lsb + 1e-6);
        ASSERT_LE(std::abs(static_cast<double>(sample.ib_A) - i.b), 0.5 * lsb + 1e-6);
        const double codes = static_cast<double>(sample.ia_A) / lsb;
        ASSERT_NEAR(codes, std::round(codes), 1e-4);
        ASSERT_NEAR(
            std::remainder(static_cast<double>(sample.theta_e_rad) - board.plant().theta_e_rad(),
                           2.0 * std::acos(-1.0)),
            0.0, 6.3e-4 + 1e-6); // half a count
        board.run_period(open_loop(angle += 0.06));
    }
}

TEST(RealisticScenario, SamplingInstantLiesBeforeThePeriod)
{
    const Scenario late              = read(at_zero + head + body +
                                            "[sensors]\nadc_noise_rms_A = 0.0\nadc_bits = 24\n"
                                                         "encoder_lines = 1000000\n");
    Scenario       early             = late;
    early.sensors.sampling_advance_s = 2e-5;
    Board a(late);
    Board b(early);
    for (int k = 0; k < 50; k++) {
        a.begin_tick(2e-4 * k);
        b.begin_tick(2e-4 * k);
        const double theta_a = static_cast<double>(a.sample().theta_e_rad);
        const double theta_b = static_cast<double>(b.sample().theta_e_rad);
        if (k > 0) {
            const double w = a.plant().omega_e_radps();
            ASSERT_NEAR(std::remainder(theta_a - theta_b, 2.0 * std::acos(-1.0)), 2e-5 * w, 2e-5);
        }
        a.run_period(open_loop(2.0 + 0.06 * k));
        b.run_period(open_loop(2.0 + 0.06 * k));
        // Split elsewhere, the dead time sees the current at another instant: 1.2e-3 measured.
        ASSERT_NEAR(a.plant().omega_e_radps(), b.plant().omega_e_radps(), 6e-3);
    }
}

TEST(RealisticScenario, SeedRepeatsAndMatters)
{
    Scenario               s          = read(head + "seed = 5\n" + body + "[sensors]\n");
    const Controller       controller = prepare_controller(s);
    const SimulationResult five       = simulate(s, controller);
    EXPECT_EQ(s.seed, 5U);
    EXPECT_TRUE(same(five, simulate(s, controller)));
    s.seed = 6;
    EXPECT_FALSE(same(five, simulate(s, controller)));
    s.sensors.ideal              = true;
    const SimulationResult ideal = simulate(s, controller);
    s.seed                       = 7;
    EXPECT_TRUE(same(ideal, simulate(s, controller)));
}

TEST(RealisticScenario, SeedRunsReportWorstAndMean)
{
    const Scenario   s    = read(head + body + "[sensors]\n");
    const SeedRuns   runs = run_seeds(s, 5);
    const Controller c    = prepare_controller(s);
    double           sum  = 0.0;
    double           top  = 0.0;
    for (std::uint64_t seed = 1; seed <= 5; seed++) {
        Scenario one        = s;
        one.seed            = seed;
        const double ripple = measure(one, simulate(one, c).trace)[0].ripple_e_radps;
        sum += ripple;
        top = std::max(top, ripple);
    }
    ASSERT_EQ(runs.measures.size(), 1U);
    for (const SeedSpread &spread : runs.measures[0].spread) {
        if (spread.metric == "ripple_e_radps") {
            EXPECT_DOUBLE_EQ(*spread.worst, top);
            EXPECT_NEAR(*spread.mean, sum / 5.0, 1e-12);
        }
    }
    EXPECT_NE(seeds_json(s, runs).find("\"worst\""), std::string::npos);
}

TEST(RealisticScenario, ChangesActAtTheirTime)
{
    const Scenario s = read(head + body + R"(
[sensors]
ideal = true
[[change]]
time_s = 0.02
set = { sensors = { ideal = false, adc_offset_a_A = 1.0, adc_noise_rms_A = 0.0 } }
[[change]]
time_s = 0.03
set = { sensors = { adc_offset_a_A = 0.0, lost_counts = 50 }, inverter = { dc_link_V = 200.0 }, load_sine = { amplitude_Nm = 0.5, frequency_Hz = 25.0, start_s = 0.03 } }
[[change]]
time_s = 0.04
set = { plant_scale = { inertia_kgm2 = 3.0 } }
)");
    ASSERT_EQ(s.changes.size(), 3U);
    EXPECT_FALSE(s.changes[0].changes_plant);
    EXPECT_FALSE(s.changes[1].sensors->ideal); // kept from the change before
    EXPECT_TRUE(s.changes[2].changes_plant);
    Board board(s);
    for (int k = 0; k < 250; k++) {
        const double t = 2e-4 * k;
        board.begin_tick(t);
        const drive_sample_t sample = board.sample();
        const double         i_a    = board.plant().phase_current_A().a;
        const double         offset = static_cast<double>(sample.ia_A) - i_a;
        const double         lag =
            std::remainder(board.plant().theta_e_rad() - static_cast<double>(sample.theta_e_rad),
                           2.0 * std::acos(-1.0));
        ASSERT_NEAR(offset, k < 100 || k >= 150 ? 0.0 : 1.0, 0.003) << k;
        ASSERT_NEAR(lag, k < 150 ? 0.0 : 50.0 * 2.0 * 2.0 * std::acos(-1.0) / 10000.0, 1e-3) << k;
        ASSERT_FLOAT_EQ(sample.dc_link_V, k < 150 ? 295.0F : 200.0F) << k;
        if (k == 199) {
            ASSERT_NEAR(board.plant_state().load_Nm,
                        0.75 + 0.5 * std::sin(2.0 * std::acos(-1.0) * 25.0 * 0.0099), 1e-9);
        }
        board.run_period(open_loop(1.5708 + board.plant().theta_e_rad() + 0.03));
    }
}

TEST(RealisticScenario, DeadTimeComesWithRealSensors)
{
    const auto end_speed = [](const std::string &tables) {
        const Scenario s = read(at_zero + head + body + tables);
        Board          board(s);
        for (int k = 0; k < 100; k++) {
            board.begin_tick(2e-4 * k);
            board.run_period(open_loop(1.5708 + 300.0 * 2e-4 * (k + 0.5)));
        }
        return board.plant().omega_e_radps();
    };
    const double none = end_speed("");
    EXPECT_NEAR(end_speed("[sensors]\n[inverter]\ndead_time_s = 0.0\n"), none, 1e-4);
    EXPECT_NEAR(end_speed("[sensors]\n"), end_speed("[inverter]\ndead_time_s = 3e-6\n"), 1e-9);
    EXPECT_GT(std::abs(end_speed("[sensors]\n") - none), 0.01);
}

TEST(RealisticScenario, OverridesReachTheDrive)
{
    const Scenario s =
        read("max_current_A = 5.0\n" + head + body + "[inverter]\nupdates_per_period = 2\n");
    EXPECT_DOUBLE_EQ(s.drive.motor.max_current_A, 5.0);
    EXPECT_DOUBLE_EQ(control_period_s(s.drive), 1e-4);
}

TEST(RealisticScenario, DriftChangesTheMotor)
{
    const Scenario s =
        read(head + body + "[motor_effects]\nresistance_drift = 5.0\nflux_drift = -1.0\n");
    const Scenario none = read(head + body);
    Board          a(s);
    Board          b(none);
    for (int k = 0; k < 200; k++) {
        a.begin_tick(2e-4 * k);
        b.begin_tick(2e-4 * k);
        if (k == 0) {
            EXPECT_DOUBLE_EQ(a.plant().torque_Nm(), b.plant().torque_Nm());
        }
        a.run_period(open_loop(1.5708 + 300.0 * 2e-4 * (k + 0.5)));
        b.run_period(open_loop(1.5708 + 300.0 * 2e-4 * (k + 0.5)));
    }
    EXPECT_GT(std::abs(a.plant().current_A().q - b.plant().current_A().q), 0.01);
}

TEST(RealisticScenario, PeakCurrentIsSeenBetweenInstants)
{
    const SimulationResult r =
        simulate(read(head + body + "[sensors]\n[inverter]\nmodel = \"switched\"\n"));
    for (const TraceRow &row : r.trace) {
        ASSERT_GE(row.peak_current_A, std::hypot(row.id_A, row.iq_A) - 1e-12);
    }
}

TEST(RealisticScenario, BothInverterModelsGiveTheSameSteadyState)
{
    const std::string text = head + body + "[inverter]\ndead_time_s = 3e-6\nmodel = ";
    const auto        last = [&](const char *which) {
        return simulate(read(text + "\"" + which + "\"\n")).trace.back();
    };
    const TraceRow a = last("averaged");
    const TraceRow b = last("switched");
    EXPECT_NEAR(a.iq_A, b.iq_A, 0.02);
    EXPECT_NEAR(a.vq_V, b.vq_V, 0.5);
}

TEST(RealisticScenario, PiFocHoldsTheSpeed)
{
    const Scenario       s = read(head + body + "[sensors]\n");
    Board                board(s);
    const pi_foc_gains_t gains = pi_foc_gains(s.drive);
    pi_foc_t             pi{};
    pi_foc_init(&pi, &gains);
    bridge_t in_force{{0.5F, 0.5F, 0.5F}, true};
    for (int k = 0; k < 4000; k++) {
        board.begin_tick(2e-4 * k);
        const drive_sample_t  sample  = board.sample();
        const drive_command_t command = {300.0F, true, 0.0F, nullptr};
        const bridge_t        out     = pi_foc_tick(&pi, &sample, &command);
        board.run_period(in_force);
        in_force = out;
    }
    EXPECT_NEAR(board.plant().omega_e_radps(), 300.0, 3.0);
}

TEST(RealisticScenario, WrongInputIsOneLine)
{
    const std::pair<const char *, const char *> cases[] = {
        {"[sensors]\nadc_bits = 40\n", "adc_bits"},
        {"[sensors]\nlines = 1\n", "lines"},
        {"[sensors]\nsampling_advance_s = 1.5e-4\n", "sampling_advance_s"},
        {"[sensors]\nencoder_count_late_s = 2e-5\n", "encoder_count_late_s"},
        {"[sensors]\nlost_counts = 4\n", "lost_counts"},
        {"[inverter]\nmodel = \"magic\"\n", "model"},
        {"[inverter]\nregeneration = \"maybe\"\n", "regeneration"},
        {"[inverter]\nduty_min = 0.9\nduty_max = 0.5\n", "duty_min"},
        {"[inverter]\ndead_time_s = 1.0\n", "dead_time_s"},
        {"[inverter]\nripple_V = -1.0\n", "[inverter] ripple_V = -1 is not allowed"},
        {"[inverter]\nripple_V = 295.0\n", "ripple_V = 295 is not allowed: must be below the"},
        {"[inverter]\nripple_V = 9.0\nripple_Hz = 0.5\n", "ripple_Hz = 0.5 is not allowed"},
        {"[inverter]\nripple_V = 9.0\nripple_Hz = 1001.0\n", "ripple_Hz = 1001 is not allowed"},
        {"[inverter]\nripple_V = true\n", "ripple_V = true is not allowed: must be a number"},
        {"[inverter]\nupdates_per_period = 3\n", "updates_per_period"},
        {"[motor_effects]\ncogging_amplitude_Nm = 0.1\n", "cogging_order"},
        {"[motor_effects]\nstribeck_speed_m_radps = 1.0\n", "static_friction_Nm"},
        {"[motor_effects]\ncoulomb_friction_Nm = 0.2\nstatic_friction_Nm = 0.1\n"
         "stribeck_speed_m_radps = 1.0\n",
         "coulomb_friction_Nm"},
        {"[motor_effects]\nshaft_stiffness_Nmprad = 1.0\n", "load_inertia_share"},
        {"[motor_effects]\nload_inertia_share = 0.5\nshaft_stiffness_Nmprad = 1e5\n",
         "shaft_stiffness_Nmprad"},
        {"[motor_effects]\nload_inertia_share = 0.5\nshaft_stiffness_Nmprad = 1.0\n"
         "shaft_damping_Nms = 10.0\n",
         "shaft_damping_Nms"},
        {"[motor_effects]\nflux_5th = 0.5\n", "flux_5th"},
        {"[[brake_torque]]\ntime_s = 0.0\nvalue_Nm = -1.0\n", "brake_torque"},
        {"[load_brake]\ntime_s = 1.0\n", "[load_brake] time_s"},
        {"[motor_effects]\nid_A = [0.0, 1.0]\n", "iq_A"},
        {"[motor_effects]\nid_A = [1.0, 0.0]\niq_A = [0.0, 1.0]\n", "must increase"},
        {"[motor_effects]\nid_A = [0.0, 1.0]\niq_A = [0.0, 1.0]\nld_H = [1.0]\n", "ld_H"},
        {"[[load_ramp]]\ntime_s = 0.2\nuntil_s = 0.1\nto_Nm = 1.0\n", "until_s"},
        {"[[load_ramp]]\ntime_s = 0.1\nuntil_s = 0.3\nto_Nm = 1.0\n"
         "[[load_ramp]]\ntime_s = 0.2\nuntil_s = 0.4\nto_Nm = 1.0\n",
         "ramp before"},
        {"[load_fan]\n", "Nm_per_radps2"},
        {"[load_sine]\namplitude_Nm = \"x\"\n", "amplitude_Nm"},
        {"[[change]]\ntime_s = 0.1\nset = {}\n", "plant_scale"},
        {"[[change]]\ntime_s = 0.1\nset = { weather = 1, sensors = {} }\n", "weather"},
        {"[[change]]\ntime_s = 0.1\nset = { sensors = { adc_bits = 1 } }\n", "adc_bits"}};
    for (const auto &[tables, piece] : cases) {
        const std::string error = error_of(head + body + tables);
        EXPECT_NE(error.find(piece), std::string::npos) << tables << " -> " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
    EXPECT_NE(error_of("seed = -1\n" + head + body).find("seed"), std::string::npos);
    EXPECT_NE(error_of("max_current_A = 0\n" + head + body).find("max_current_A"),
              std::string::npos);
    EXPECT_NE(error_of(head + body +
                       "[[load_torque]]\ntime_s = 0.02\nvalue_Nm = 1.0\n"
                       "[[load_ramp]]\ntime_s = 0.01\nuntil_s = 0.03\nto_Nm = 0.0\n")
                  .find("load_ramp"),
              std::string::npos);
}

TEST(RealisticScenario, CommandLineSeeds)
{
    const support::TempDir dir;
    const std::string      file = dir.write("s.toml", head + body + "[sensors]\n").string();
    const std::string      json = (dir / "m.json").string();
    const auto             many =
        support::run_command({SDRE_SIL_EXE, "run", file, "--seeds", "3", "--json", json});
    EXPECT_EQ(many.exit_code, 0) << many.err;
    const std::string text = support::read_file(json);
    EXPECT_NE(text.find("\"seeds\": 3"), std::string::npos);
    EXPECT_NE(text.find("\"mean\""), std::string::npos);
    const auto one   = support::run_command({SDRE_SIL_EXE, "run", file, "--seed", "2"});
    const auto other = support::run_command({SDRE_SIL_EXE, "run", file, "--seed", "3"});
    EXPECT_EQ(one.exit_code, 0);
    EXPECT_NE(one.out, other.out);
    support::expect_refused(
        support::run_command({SDRE_SIL_EXE, "run", file, "--seed", "2", "--seeds", "3"}), 1,
        "sdre-sil");
    support::expect_refused(support::run_command({SDRE_SIL_EXE, "run", file, "--seeds", "0"}), 1,
                            "sdre-sil");
}

TEST(RealisticScenario, BenchPrintsItsFigures)
{
    const auto bench = support::run_command({SDRE_SIL_EXE, "bench"});
    EXPECT_EQ(bench.exit_code, 0) << bench.err;
    for (const char *piece : {"averaged inverter", "switched inverter", "drive_tick", "PI-FOC"}) {
        EXPECT_NE(bench.out.find(piece), std::string::npos) << bench.out;
    }
}

TEST(Runaway, ALoadThatDrivesTheTrippedMotorEndsTheRun)
{
    for (const std::string board : {"", "[sensors]\nsampling_advance_s = 5e-5\n",
                                    "[sensors]\n[inverter]\nmodel = \"switched\"\n"}) {
        for (const double load_Nm : {-300.0, 1e5}) { // in some 60 periods, and within one
            const Scenario s =
                read(head + body + board +
                     fmt::format("[[load_torque]]\ntime_s = 0.02\nvalue_Nm = {}\n", load_Nm));
            const double           ts = control_period_s(s.drive);
            const SimulationResult r  = simulate(s);

            EXPECT_NE(r.fault, 0);
            EXPECT_EQ(r.ended, runaway_fault);
            ASSERT_LT(r.trace.size(), 250U);
            EXPECT_GT(r.trace.back().time_s, 0.0199);
            for (const TraceRow &row : r.trace) {
                EXPECT_LT(std::abs(row.omega_e_radps) * ts, std::acos(-1.0)); // half a turn
                EXPECT_TRUE(std::isfinite(row.peak_current_A) && std::isfinite(row.dc_link_V) &&
                            std::isfinite(row.torque_Nm) && std::isfinite(row.vq_V));
            }
        }
    }
    EXPECT_NE(std::string(fault_name(runaway_fault)).find("runs away"), std::string::npos);
}

TEST(RealisticScenario, RippleIsReadAndChanges)
{
    const InverterSettings none = read(head + body + "[inverter]\n").inverter;
    EXPECT_EQ(none.ripple_V, 0.0);
    EXPECT_EQ(none.ripple_Hz, 300.0);
    const Scenario s = read(
        head + body +
        "[sensors]\n[inverter]\nripple_V = 29.5\nripple_Hz = 100.0\n"
        "[[change]]\ntime_s = 0.02\nset = { inverter = { ripple_V = 0.0 } }\n"
        "[[change]]\ntime_s = 0.03\nset = { inverter = { dc_link_V = 250.0, ripple_V = 5.0 } }\n");
    EXPECT_EQ(s.inverter.ripple_V, 29.5);
    EXPECT_EQ(s.inverter.ripple_Hz, 100.0);
    ASSERT_EQ(s.changes.size(), 2U);
    EXPECT_EQ(s.changes[0].inverter->ripple_V, 0.0);
    EXPECT_EQ(s.changes[0].inverter->ripple_Hz, 100.0); // keeps what it does not name
    EXPECT_EQ(s.changes[1].inverter->ripple_V, 5.0);
    for (const TraceRow &row : simulate(s).trace) {
        const double t = row.time_s;
        if (t > 0.0202 && t < 0.0299) {
            EXPECT_EQ(row.dc_link_V, 295.0) << t;
        } else if (t > 0.0301) {
            EXPECT_NEAR(row.dc_link_V, 250.0, 5.001) << t;
        }
    }
    EXPECT_NE(error_of(head + body + "[inverter]\ndc_link_V = 200.0\nripple_V = 250.0\n")
                  .find("the source's 200 V"),
              std::string::npos);
}

TEST(RealisticScenario, ChopperIsReadAndNeedsALinkThatCanRise)
{
    const auto with = [](const std::string &keys) { return head + body + "[inverter]\n" + keys; };
    const std::string      blocks = "regeneration = \"blocks\"\n";
    const InverterSettings none   = read(with(blocks)).inverter;
    EXPECT_FALSE(none.chopper_on_V);
    const InverterSettings some =
        read(with(blocks + "chopper_on_V = 380.0\nchopper_hysteresis_V = 8.0\n"
                           "chopper_resistance_Ohm = 47.0\n"))
            .inverter;
    EXPECT_EQ(some.chopper_on_V.value_or(0.0), 380.0);
    EXPECT_EQ(some.chopper_hysteresis_V, 8.0);
    EXPECT_EQ(some.chopper_resistance_Ohm, 47.0);
    EXPECT_NE(error_of(with(blocks + "chopper_on_V = 299.0\n")).find("chopper_on_V"),
              std::string::npos); // off at 294 V: below the source
    EXPECT_NE(error_of(with("chopper_on_V = 380.0\n")).find("stiff"), std::string::npos);
}

TEST(RealisticScenario, IronLossesNeedAMagnet)
{
    Drive drive            = read_drive_file(support::shipped_drive("ipmsm_390w"));
    drive.motor.pm_flux_Wb = 0.0;
    const auto with        = [&](const char *key) {
        const std::string text = head + body + "[motor_effects]\n" + key + "\n";
        return read_scenario_table(parse_toml_text(text, "s"), "s", "s", drive, drive.law);
    };
    EXPECT_EQ(with("coulomb_friction_Nm = 0.1").motor_effects.coulomb_friction_Nm, 0.1);
    EXPECT_THROW(with("iron_eddy_Nms = 1e-4"), InputError);
    EXPECT_THROW(with("iron_hysteresis_Nm = 0.02"), InputError);
}
