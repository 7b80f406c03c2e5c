// SPDX-License-Identifier: MIT
// The shipped drive at 300 rad/s and 1.5 N m with sensors that fail: single readings, lost counts, a dead encoder.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "sil/run/simulation.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

constexpr double when_s    = 0.1; // of the fault
constexpr double limit_A   = 4.0;
constexpr int    sil_seeds = 4;

std::string text_of(double speed, const std::string &fault)
{
    return fmt::format("drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml\"\n"
                       "duration_s = 0.2\ninitial_speed_e_radps = {0}\n[sensors]\n"
                       "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {0}\n"
                       "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = 1.5\n{1}",
                       speed, fault);
}

Scenario read(const std::string &text)
{
    const support::TempDir dir;
    return read_scenario_file(dir.write("s.toml", text));
}

struct Outcome {
    int    fault        = 0;
    double fault_time_s = 0.0;
    double peak_A       = 0.0; ///< after the fault
    double off_e_radps  = 0.0; ///< worst speed error after the fault
};

/// Worst of some seeds; the latest trip.
Outcome worst_of(double speed, const std::string &fault)
{
    Scenario s = read(text_of(speed, fault));
    Outcome  worst;
    for (int seed = 1; seed <= sil_seeds; seed++) {
        s.seed                        = static_cast<std::uint64_t>(seed);
        const SimulationResult result = simulate(s);
        worst.fault                   = std::max(worst.fault, result.fault);
        worst.fault_time_s            = std::max(worst.fault_time_s, result.fault_time_s);
        for (const TraceRow &row : result.trace) {
            if (row.time_s >= when_s) {
                worst.peak_A = std::max(worst.peak_A, row.peak_current_A);
                worst.off_e_radps =
                    std::max(worst.off_e_radps, std::abs(row.omega_e_radps - speed));
            }
        }
    }
    return worst;
}

const std::string dead_encoder = fmt::format(
    "[[change]]\ntime_s = {}\nset = {{ sensors = {{ encoder_dead = true }} }}\n", when_s);

std::string encoder_glitch(int counts, int samples = 1)
{
    return fmt::format("[[glitch]]\ntime_s = {}\nencoder_cnt = {}\nsamples = {}\n", when_s, counts,
                       samples);
}

} // namespace

/// EQ-ANGLE-GATE-1: beyond the gate of 7.6 counts nothing is seen of a wrong reading.
TEST(SensorFaults, SingleEncoderGlitchesDoNotTrip)
{
    for (const int counts : {1, 2, 3, 4, 5, 6, 7, 8, 12, 20, 30, 40, 150}) {
        for (const int sign : {-1, 1}) {
            const Outcome o = worst_of(300.0, encoder_glitch(sign * counts));
            EXPECT_EQ(o.fault, 0) << sign * counts;
            EXPECT_LT(o.peak_A, 1.05 * limit_A) << sign * counts;
            EXPECT_LT(o.off_e_radps, counts > 8 ? 1.5 : 10.0) << sign * counts;
        }
    }
    EXPECT_LT(worst_of(300.0, encoder_glitch(40, 3)).off_e_radps, 1.5);
}

/// The angle takes a jump over after three samples, the speed never.
TEST(SensorFaults, LostCountsMoveTheAngleOnly)
{
    for (const int counts : {-40, 40, 100}) {
        const Outcome o = worst_of(
            300.0, fmt::format("[[change]]\ntime_s = {}\nset = {{ sensors = {{ lost_counts = {}, "
                               "encoder_index = false }} }}\n",
                               when_s, counts));
        EXPECT_EQ(o.fault, 0) << counts;
        EXPECT_LT(o.peak_A, limit_A) << counts;
        EXPECT_LT(o.off_e_radps, 3.0) << counts;
    }
}

/// EQ-ANGLE-GATE-2: too slow for the currents to take its place.
TEST(SensorFaults, DeadEncoderOfASlowShaftTripsWithinMilliseconds)
{
    for (const double speed : {20.0, -20.0, 30.0, 40.0, -45.0}) {
        const Outcome o = worst_of(speed, dead_encoder);
        EXPECT_EQ(o.fault, static_cast<int>(DRIVE_FAULT_ENCODER)) << speed;
        EXPECT_LT(o.fault_time_s, when_s + 2e-3) << speed;
    }
}

/// EQ-NODO-CURRENT-1: the drive goes on, also with a motor that is not as believed.
TEST(SensorFaults, DriveGoesOnWithoutItsEncoder)
{
    for (const double speed : {60.0, 100.0, 150.0, 300.0, -300.0, 500.0}) {
        const Outcome o = worst_of(speed, dead_encoder);
        EXPECT_EQ(o.fault, 0) << speed;
        EXPECT_LT(o.peak_A, limit_A) << speed;
        EXPECT_LT(o.off_e_radps, 4.0) << speed;
    }
    for (const char *scale : {"stator_resistance_Ohm = 0.5", "stator_resistance_Ohm = 1.5",
                              "d_axis_inductance_H = 1.5\nq_axis_inductance_H = 1.5",
                              "pm_flux_Wb = 0.8", "pm_flux_Wb = 1.2", "inertia_kgm2 = 3.0"}) {
        const Outcome o =
            worst_of(300.0, fmt::format("[plant_scale]\n{}\n{}", scale, dead_encoder));
        EXPECT_EQ(o.fault, 0) << scale;
        EXPECT_LT(o.off_e_radps, 20.0) << scale;
    }
}

/// As the application stops it: by the speed of the model, and the fault where that ends.
TEST(SensorFaults, DriveStopsWithoutItsEncoder)
{
    Scenario s = read(text_of(300.0, dead_encoder));
    s.speed_reference.push_back({when_s + 0.01, 0.0});
    const SimulationResult result = simulate(s);
    EXPECT_EQ(result.fault, static_cast<int>(DRIVE_FAULT_ENCODER));
    EXPECT_GT(result.fault_time_s, when_s + 0.01);
    for (const TraceRow &row : result.trace) {
        if (row.time_s < result.fault_time_s) {
            EXPECT_LT(row.peak_current_A, 1.05 * limit_A) << row.time_s;
            EXPECT_GT(row.omega_e_radps, 5.0) << row.time_s; // does not turn back
        } else {
            EXPECT_LT(row.omega_e_radps, 40.0) << row.time_s;
            break;
        }
    }
}

TEST(SensorFaults, GlitchIsInTheSamplesThatItNames)
{
    const Scenario s =
        read(text_of(300.0, encoder_glitch(40, 2) + "[[glitch]]\ntime_s = 0.15\nia_A = 1.0\n"));
    EXPECT_EQ(glitch_at(s.glitches, when_s - 2e-4, 2e-4).encoder_cnt, 0);
    EXPECT_EQ(glitch_at(s.glitches, when_s, 2e-4).encoder_cnt, 40);
    EXPECT_EQ(glitch_at(s.glitches, when_s + 2e-4, 2e-4).encoder_cnt, 40);
    EXPECT_EQ(glitch_at(s.glitches, when_s + 4e-4, 2e-4).encoder_cnt, 0);
    EXPECT_EQ(glitch_at(s.glitches, 0.15, 2e-4).ia_A, 1.0);
    for (const char *wrong : {"samples = 0\n", "encoder = 3\n", "ia_A = 1e9\n"}) {
        EXPECT_THROW(read(text_of(300.0, std::string("[[glitch]]\ntime_s = 0.1\n") + wrong)),
                     InputError)
            << wrong;
    }
    EXPECT_THROW(read(text_of(300.0, encoder_glitch(1) + encoder_glitch(2))), InputError);
}

/// EQ-CURRENT-GATE-1, 2: up to the converter's full scale of 10 A; beyond about 1.6 A nothing is seen of it.
TEST(SensorFaults, SingleCurrentSpikesDoNotTrip)
{
    for (const char *phase : {"ia_A", "ib_A"}) {
        for (const double spike_A : {1.0, 6.0, 9.0, 20.0, -1.0, -6.0, -9.0, -20.0}) {
            const Outcome o = worst_of(
                300.0, fmt::format("[[glitch]]\ntime_s = {}\n{} = {}\n", when_s, phase, spike_A));
            EXPECT_EQ(o.fault, 0) << phase << spike_A;
            EXPECT_LT(o.peak_A, limit_A) << phase << spike_A;
            EXPECT_LT(o.off_e_radps, std::abs(spike_A) > 2.0 ? 1.0 : 2.0) << phase << spike_A;
        }
    }
}

TEST(SensorFaults, OverCurrentOfTwoSamplesTrips)
{
    const Outcome o =
        worst_of(300.0, fmt::format("[[glitch]]\ntime_s = {}\nia_A = 20.0\nsamples = 2\n", when_s));
    EXPECT_EQ(o.fault, static_cast<int>(DRIVE_FAULT_OVER_CURRENT));
    EXPECT_NEAR(o.fault_time_s, when_s + 2e-4, 1e-9);
}

namespace {

std::string broken(const std::string &keys)
{
    return fmt::format("[[fault]]\ntime_s = {}\n{}\n", when_s, keys);
}

/// Every case trips, in time and without too much current.
void expect_found(const std::string &keys, double within_s, double share,
                  std::initializer_list<double> speeds)
{
    for (const double speed : speeds) {
        const Outcome o = worst_of(speed, broken(keys));
        EXPECT_NE(o.fault, 0) << keys << " " << speed;
        EXPECT_LE(o.fault_time_s, when_s + within_s) << keys << " " << speed;
        EXPECT_LE(o.peak_A, share * limit_A) << keys << " " << speed;
    }
}

} // namespace

/// EQ-CURRENT-WATCH-3: the residual of the observer.
TEST(SensorFaults, CurrentSensorsThatLieAreFound)
{
    for (const char *phase : {"phase = \"a\"\n", "phase = \"b\"\n"}) {
        const std::string at = phase;
        expect_found(at + "kind = \"current_zero\"", 5e-3, 1.05, {100.0, 300.0, -523.0});
        expect_found(at + "kind = \"current_frozen\"", 15e-3, 1.05, {100.0, 300.0, -523.0});
        expect_found(at + "kind = \"current_gain\"\ngain = 0.3", 20e-3, 1.25, {300.0});
    }
}

/// EQ-CURRENT-GATE-2, twice in a row.
TEST(SensorFaults, OffsetsThatComeAtOnceAreFoundAtOnce)
{
    for (const char *phase : {"a", "b"}) {
        for (const double offset_A : {-6.0, -4.0, -2.0, 2.0, 4.0, 6.0}) {
            const std::string keys =
                fmt::format("kind = \"current_drift\"\nphase = \"{}\"\nrate_Aps = {}\nuntil_A = {}",
                            phase, std::copysign(1e6, offset_A), std::abs(offset_A));
            expect_found(keys, 1e-3, 1.05, {0.0, 20.0, 300.0, -523.0});
        }
    }
}

TEST(SensorFaults, BrokenMotorWireIsFound)
{
    for (const char *phase : {"a", "b", "c"}) {
        const std::string keys = fmt::format("kind = \"phase_open\"\nphase = \"{}\"", phase);
        expect_found(keys, 20e-3, 1.05, {100.0, 300.0, -523.0});
        const Outcome light = [&] {
            std::string text = text_of(300.0, broken(keys));
            text.replace(text.find("value_Nm = 1.5"), 14, "value_Nm = 0.2");
            const SimulationResult r = simulate(read(text));
            return Outcome{r.fault, r.fault_time_s, 0.0, 0.0};
        }();
        EXPECT_NE(light.fault, 0) << phase;
        EXPECT_LE(light.fault_time_s, when_s + 20e-3) << phase;
    }
}

/// EQ-CURRENT-WATCH-4, for laws without a prediction.
TEST(SensorFaults, BrokenMotorWireIsFoundByEveryLawWithReferences)
{
    Scenario s = read(text_of(300.0, broken("kind = \"phase_open\"\nphase = \"a\"")));
    s.drive =
        read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w_pi_foc_edges.toml");
    const SimulationResult r = simulate(s);
    EXPECT_EQ(r.fault, static_cast<int>(DRIVE_FAULT_PHASE));
    EXPECT_LE(r.fault_time_s, when_s + 30e-3);
}

namespace {

/// A standing shaft that is told to turn, 10 ms after something has broken.
SimulationResult started(double to_e_radps, double load_Nm, const std::string &broken)
{
    std::string text = text_of(0.0, broken);
    text.replace(text.find("value_Nm = 1.5"), 14, fmt::format("value_Nm = {}", load_Nm));
    Scenario s   = read(text);
    s.duration_s = 0.4;
    s.speed_reference.push_back({when_s + 0.01, to_e_radps});
    return simulate(s);
}

double peak_A(const SimulationResult &result)
{
    double peak = 0.0;
    for (const TraceRow &row : result.trace) {
        peak = std::max(peak, row.peak_current_A);
    }
    return peak;
}

} // namespace

/// EQ-MOTION-WATCH-1: the EMF of a shaft that the encoder does not show.
TEST(SensorFaults, EncoderThatStandsStillFromTheStartIsFoundWithin50Milliseconds)
{
    for (const double to : {20.0, 200.0, -200.0, 500.0}) {
        for (const double load_Nm : {0.0, 1.0}) {
            const SimulationResult r = started(to, load_Nm, dead_encoder);
            EXPECT_NE(r.fault, 0) << to << " " << load_Nm;
            // Against a load the currents reach their limit first: 54.4 ms, 1.057 measured.
            const double more = load_Nm > 0.0 ? 1.0 : 0.0;
            EXPECT_LE(r.fault_time_s, when_s + 0.01 + 50e-3 + more * 5e-3) << to << " " << load_Nm;
            EXPECT_LE(peak_A(r), (1.05 + more * 0.01) * limit_A) << to << " " << load_Nm;
        }
    }
}

/// EQ-MOTION-WATCH-2
TEST(SensorFaults, JammedShaftIsAStall)
{
    for (const double to : {50.0, -200.0}) {
        const SimulationResult r =
            started(to, 0.0, "[motor_effects]\ncoulomb_friction_Nm = 20.0\n");
        EXPECT_EQ(r.fault, static_cast<int>(DRIVE_FAULT_STALL)) << to;
        EXPECT_LE(r.fault_time_s, when_s + 0.01 + 70e-3) << to;
        EXPECT_LE(peak_A(r), 1.05 * limit_A) << to;
    }
}

/// EQ-MOTION-WATCH-3: twice the largest torque.
TEST(SensorFaults, LoadThatDragsTheShaftAwayIsFound)
{
    for (const double load_Nm : {4.0, -4.0}) {
        Scenario s               = read(text_of(
                          300.0, fmt::format("[[load_torque]]\ntime_s = {}\nvalue_Nm = {}\n", when_s, load_Nm)));
        s.duration_s             = 0.5;
        const SimulationResult r = simulate(s);
        EXPECT_NE(r.fault, 0) << load_Nm;
        EXPECT_LE(peak_A(r), 1.05 * limit_A) << load_Nm;
    }
}

/// EQ-MOTION-WATCH-4: the angle turns unseen until the shaft runs away from its command.
TEST(SensorFaults, CountsLostAtRestAreFoundBeforeTheShaftIsFast)
{
    for (const double counts_per_s : {-5000.0, -1000.0, 1000.0, 5000.0}) {
        for (const double load_Nm : {0.0, 0.3, 1.0}) {
            Scenario               s            = read(fmt::format("drive = \"" SDRE_SOURCE_DIR
                                                                   "/firmware/config/drives/ipmsm_390w.toml\"\n"
                                                                                            "duration_s = 2.5\n[sensors]\n"
                                                                                            "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = 0.0\n"
                                                                                            "[[load_torque]]\ntime_s = 0.05\nvalue_Nm = {}\n"
                                                                                            "[[fault]]\ntime_s = {}\nkind = \"encoder_losing\"\n"
                                                                                            "counts_per_s = {}\n",
                                                                   load_Nm, when_s, counts_per_s));
            double                 away_s       = 0.0; // the shaft has passed 20 rad/s
            double                 most_e_radps = 0.0;
            const SimulationResult r            = simulate(s);
            for (const TraceRow &row : r.trace) {
                if (row.time_s < when_s || (r.fault != 0 && row.time_s > r.fault_time_s)) {
                    continue;
                }
                most_e_radps = std::max(most_e_radps, std::abs(row.omega_e_radps));
                if (away_s == 0.0 && most_e_radps > 20.0) {
                    away_s = row.time_s;
                }
            }
            EXPECT_NE(r.fault, 0) << counts_per_s << ", " << load_Nm;
            EXPECT_LE(r.fault_time_s, away_s + 0.25) << counts_per_s << ", " << load_Nm;
            EXPECT_LE(most_e_radps, 300.0) << counts_per_s << ", " << load_Nm;
            EXPECT_LE(peak_A(r), 1.06 * limit_A) << counts_per_s << ", " << load_Nm;
        }
    }
}
