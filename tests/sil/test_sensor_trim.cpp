// SPDX-License-Identifier: MIT
// Errors of the current sensors that the application learns and takes off, on the realistic board. SDRE_TRIM=all prints the ripple.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shipped_drive.hpp"
#include "sil/board/board_run.hpp"
#include "sil/eval/metrics.hpp"
#include "sweep.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

struct Case {
    double      speed_e_radps = 300.0;
    double      load_Nm       = 0.75;
    double      offset_a_A    = 0.0; ///< of the readings, from 0.1 s on
    double      offset_b_A    = 0.0;
    double      gain_a        = 1.0;
    double      gain_b        = 1.0;
    std::string more{};       ///< of the scenario
    double      time_s = 6.0; ///< after the error
};

Scenario scenario_of(const Case &c, int seed)
{
    const support::TempDir dir;
    Scenario               s = read_scenario_file(
                      dir.write(
                          "s.toml",
                          fmt::format("drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml\"\n"
                                                    "duration_s = {}\ninitial_speed_e_radps = {}\n"
                                                    "[sensors]\nideal = false\n"
                                                    "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {}\n"
                                                    "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = {}\n"
                                                    "[[change]]\ntime_s = 0.1\nset = {{ sensors = {{ adc_offset_a_A = {}, "
                                                    "adc_offset_b_A = {}, adc_gain_a = {}, adc_gain_b = {} }} }}\n"
                                                    "[[measure]]\nname = \"end\"\ntime_s = 0.1\nband_e_radps = 5.0\n"
                                                    "tail_s = 0.2\n{}",
                                      0.1 + c.time_s, c.speed_e_radps, c.speed_e_radps, c.load_Nm, c.offset_a_A,
                                      c.offset_b_A, c.gain_a, c.gain_b, c.more)),
                      support::shipped_drive("ipmsm_390w"));
    s.seed = static_cast<std::uint64_t>(seed);
    return s;
}

struct Result {
    double ripple_e_radps = 0.0; ///< of the last 0.2 s; the worst seed
    double zero_a_A =
        0.0; ///< moved from the calibrated zero; the one furthest from what it should be
    double zero_b_A = 0.0;
    int    faults   = 0;
};

double further(double a, double b, double from)
{
    return std::abs(a - from) > std::abs(b - from) ? a : b;
}

/// One after the other: a process has one firmware.
Result run(const Case &c, std::size_t seeds)
{
    const double codes_per_A = 4096.0 / 20.0;
    Result       worst{0.0, c.offset_a_A, c.offset_b_A, 0};
    for (std::size_t seed = 1; seed <= seeds; seed++) {
        const Scenario    s   = scenario_of(c, static_cast<int>(seed));
        const BoardResult out = simulate_on_board(s, BoardKind::api);
        worst.ripple_e_radps =
            std::max(worst.ripple_e_radps, measure(s, out.result.trace).back().ripple_e_radps);
        worst.zero_a_A =
            further(worst.zero_a_A, (out.zero_a_cnt - 2048.0) / codes_per_A, c.offset_a_A);
        worst.zero_b_A =
            further(worst.zero_b_A, (out.zero_b_cnt - 2048.0) / codes_per_A, c.offset_b_A);
        worst.faults += out.result.fault == DRIVE_FAULT_NONE ? 0 : 1;
    }
    if (std::getenv("SDRE_TRIM") != nullptr) {
        fmt::print("{} rad/s, {} N m, {} A, {} A, x{}, x{}, {}: ripple {:.3f} rad/s, zeros {:.1f}, "
                   "{:.1f} mA\n",
                   c.speed_e_radps, c.load_Nm, c.offset_a_A, c.offset_b_A, c.gain_a, c.gain_b,
                   c.more, worst.ripple_e_radps, 1e3 * worst.zero_a_A, 1e3 * worst.zero_b_A);
    }
    EXPECT_EQ(worst.faults, 0);
    return worst;
}

constexpr double wanted_e_radps = 0.15;

} // namespace

/// Without the trim the ripple is 0.15 to 0.43 rad/s.
TEST(SensorTrim, OffsetsAndGainsLeaveTheRippleOfGoodSensors)
{
    for (const double load : {0.75, 1.5}) {
        for (const double speed : {100.0, 200.0, 300.0, 500.0, -300.0}) {
            const double sign = speed < 0.0 ? -1.0 : 1.0;
            const Case   c{speed, sign * load, 0.05, 0.0, 1.0, 1.02};
            const Result r = run(c, support::swept<std::size_t>(10, 1, 2));
            EXPECT_LE(r.ripple_e_radps, wanted_e_radps) << speed << " " << load;
            EXPECT_NEAR(r.zero_a_A, 0.05, 0.003) << speed << " " << load;
            EXPECT_NEAR(r.zero_b_A, 0.0, 0.003) << speed << " " << load;
        }
    }
}

TEST(SensorTrim, EachErrorAlone)
{
    for (const Case &c : {Case{300.0, 0.75, 0.0, -0.08}, Case{300.0, 1.5, 0.0, 0.0, 1.02},
                          Case{300.0, 1.5, 0.0, 0.0, 0.97}, Case{400.0, 0.5, -0.1, 0.1}}) {
        const Result r = run(c, support::swept<std::size_t>(3, 1, 1));
        EXPECT_LE(r.ripple_e_radps, wanted_e_radps);
        EXPECT_NEAR(r.zero_a_A, c.offset_a_A, 0.003);
        EXPECT_NEAR(r.zero_b_A, c.offset_b_A, 0.003);
    }
}

/// Good sensors with motors, loads, discs and inverters that are not ideal.
TEST(SensorTrim, GoodSensorsAreBelieved)
{
    for (const char *more :
         {"", "[plant_scale]\nd_axis_inductance_H = 0.7\nq_axis_inductance_H = 0.7\n",
          "[plant_scale]\nd_axis_inductance_H = 1.5\nq_axis_inductance_H = 1.5\n",
          "[plant_scale]\nd_axis_inductance_H = 1.3\nq_axis_inductance_H = 0.8\n",
          "[plant_scale]\npm_flux_Wb = 1.3\nstator_resistance_Ohm = 0.5\ninertia_kgm2 = 3.0\n",
          "[motor_effects]\ncogging_amplitude_Nm = 0.1\ncogging_order = 12\nflux_5th = 0.02\n",
          "[load_sine]\namplitude_Nm = 0.3\nfrequency_Hz = 2.0\n",
          "[inverter]\nmodel = \"switched\"\nswitch_drop_V = 1.5\ndiode_drop_V = 1.0\n"}) {
        for (const double speed : {100.0, 300.0, 500.0}) {
            const Result r =
                run({speed, 0.75, 0.0, 0.0, 1.0, 1.0, more}, support::swept<std::size_t>(3, 1, 1));
            EXPECT_LE(std::abs(r.zero_a_A), 0.006) << more << speed;
            EXPECT_LE(std::abs(r.zero_b_A), 0.006) << more << speed;
        }
    }
}

/// A load that swings once in an electrical turn looks most like an offset: the worst is 6 mA.
TEST(SensorTrim, ALoadThatSwingsWithTheAngleIsNoOffset)
{
    for (const double speed : {100.0, 200.0, 300.0}) {
        const std::string more = fmt::format("[load_sine]\namplitude_Nm = 0.2\nfrequency_Hz = {}\n",
                                             speed / 6.283185307);
        const Result      r =
            run({speed, 0.75, 0.0, 0.0, 1.0, 1.0, more}, support::swept<std::size_t>(10, 1, 2));
        EXPECT_LE(std::abs(r.zero_a_A), 0.010) << speed;
        EXPECT_LE(std::abs(r.zero_b_A), 0.010) << speed;
    }
}

/// Inductances 1.5 times as large turn what the voltage says, and the torque contradicts: nothing is learned.
TEST(SensorTrim, WithWrongInductancesItLearnsRightlyOrNothing)
{
    for (const double scale : {0.7, 1.15, 1.3, 1.5}) {
        for (const double speed : {100.0, 300.0, 500.0}) {
            const std::string more =
                fmt::format("[plant_scale]\nd_axis_inductance_H = {}\nq_axis_inductance_H = {}\n",
                            scale, scale);
            const Result r = run({speed, 0.75, 0.05, -0.03, 1.0, 1.0, more},
                                 support::swept<std::size_t>(3, 1, 1));
            EXPECT_GE(r.zero_a_A, -0.003) << scale << " " << speed;
            EXPECT_LE(r.zero_a_A, 0.06) << scale << " " << speed;
            EXPECT_LE(r.zero_b_A, 0.003) << scale << " " << speed;
            EXPECT_GE(r.zero_b_A, -0.045) << scale << " " << speed;
        }
    }
}
