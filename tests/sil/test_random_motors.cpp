// SPDX-License-Identifier: MIT
#include "sil/eval/random_motors.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "common/parallel.hpp"
#include "json.hpp"
#include "scenario_text.hpp"
#include "sil/eval/seeds.hpp"
#include "sil/run/simulation.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

/// A law that stands a motor like the believed one, and none with a fortieth of the inertia.
std::string text(const std::string &ranges)
{
    return support::scenario_text("ipmsm_390w") + ranges;
}

const std::string good  = "[motor_ranges]\nresistance = [0.9, 1.1]\ninductance = [0.9, 1.1]\n"
                          "flux = [0.9, 1.1]\ninertia = [0.9, 1.1]\n";
const std::string light = "[motor_ranges]\nresistance = [1.0, 1.0]\ninductance = [1.0, 1.0]\n"
                          "flux = [1.0, 1.0]\ninertia = [0.02, 0.03]\n";

Scenario read(const std::string &content)
{
    const support::TempDir dir;
    return read_scenario_file(dir.write("case.toml", content));
}

std::string error_of(const std::string &content)
{
    try {
        read(content);
    } catch (const InputError &e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST(ParallelFor, CallsEveryNumberOnce)
{
    std::vector<int> calls(1000, 0);
    parallel_for(calls.size(), [&](std::size_t i) { calls[i]++; });

    EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](int n) { return n == 1; }));
}

TEST(ParallelFor, NothingToDoCallsNothing)
{
    parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, FirstExceptionByNumberComesThrough)
{
    const auto fail_late = [](std::size_t i) {
        if (i % 10 == 7) {
            throw InputError("number " + std::to_string(i));
        }
    };
    try {
        parallel_for(100, fail_late);
        FAIL();
    } catch (const InputError &e) {
        EXPECT_STREQ(e.what(), "number 7");
    }
}

TEST(DrawMotor, FactorsFillTheirRangesAndNothingElse)
{
    const MotorRanges                    ranges{{0.5, 1.5}, {0.6, 1.4}, {0.7, 1.3}, {0.5, 3.0}};
    const std::pair<const char *, Range> expected[] = {{"stator_resistance_Ohm", {0.5, 1.5}},
                                                       {"d_axis_inductance_H", {0.6, 1.4}},
                                                       {"q_axis_inductance_H", {0.6, 1.4}},
                                                       {"pm_flux_Wb", {0.7, 1.3}},
                                                       {"inertia_kgm2", {0.5, 3.0}}};
    for (const auto &[key, range] : expected) {
        double lowest  = 1e9;
        double highest = 0.0;
        double sum     = 0.0;
        for (int motor = 1; motor <= 2000; motor++) {
            const double x = draw_motor(ranges, 1, motor).at(key);
            lowest         = std::min(lowest, x);
            highest        = std::max(highest, x);
            sum += x / 2000.0;
        }
        const double width = range.hi - range.lo;
        EXPECT_GE(lowest, range.lo) << key;
        EXPECT_LE(highest, range.hi) << key;
        EXPECT_LT(lowest, range.lo + 0.01 * width) << key;
        EXPECT_GT(highest, range.hi - 0.01 * width) << key;
        EXPECT_NEAR(sum, 0.5 * (range.lo + range.hi), 0.02 * width) << key; // 3 sigma of the mean
    }
}

TEST(DrawMotor, EveryFactorIsIndependentOfEachOther)
{
    const MotorRanges ranges{{0.5, 1.5}, {0.5, 1.5}, {0.5, 1.5}, {0.5, 1.5}};
    const char *keys[] = {"stator_resistance_Ohm", "d_axis_inductance_H", "q_axis_inductance_H",
                          "pm_flux_Wb", "inertia_kgm2"};
    for (const char *a : keys) {
        for (const char *b : keys) {
            double product = 0.0;
            for (int motor = 1; motor <= 2000; motor++) {
                const MotorScale m = draw_motor(ranges, 1, motor);
                product += (m.at(a) - 1.0) * (m.at(b) - 1.0) / 2000.0;
            }
            EXPECT_NEAR(product, a == b ? 1.0 / 12.0 : 0.0, 0.006) // 3 sigma
                << a << " " << b;
        }
    }
}

TEST(DrawMotor, SameNumbersSameMotor)
{
    const MotorRanges ranges{{0.5, 1.5}, {0.5, 1.5}, {0.5, 1.5}, {0.5, 3.0}};

    EXPECT_EQ(draw_motor(ranges, 3, 17), draw_motor(ranges, 3, 17));
    EXPECT_NE(draw_motor(ranges, 3, 17), draw_motor(ranges, 3, 18));
    EXPECT_NE(draw_motor(ranges, 3, 17), draw_motor(ranges, 4, 17));
}

TEST(RandomMotors, MotorsLikeTheBelievedOneAllPass)
{
    const RandomMotors runs = run_random_motors(read(text(good)), 20);

    EXPECT_EQ(runs.count, 20);
    EXPECT_TRUE(runs.failures.empty());
}

TEST(RandomMotors, FailuresSayWhatAndWhy)
{
    const Scenario     s    = read(text(light));
    const RandomMotors runs = run_random_motors(s, 3);

    ASSERT_EQ(runs.failures.size(), 3U);
    for (int i = 0; i < 3; i++) {
        const MotorFailure &f = runs.failures[static_cast<std::size_t>(i)];
        EXPECT_EQ(f.motor, i + 1);
        EXPECT_EQ(f.scale, draw_motor(*s.motor_ranges, s.seed, i + 1));
        ASSERT_GE(f.reasons.size(), 2U);
        EXPECT_NE(f.reasons.back().find("unstable"), std::string::npos) << f.reasons.back();
        EXPECT_NE(f.reasons.back().find("x what is believed"), std::string::npos);
    }
    EXPECT_NE(random_motors_text(s, runs).find("3 of 3 motors failed, 0.00 % good"),
              std::string::npos);
}

namespace {

/// Steady running with a ripple of the speed and noise of both voltages, rms.
SimulationResult ringing(const Scenario &s, double ripple_e_radps, double vq_V, double vd_V)
{
    SimulationResult r = simulate(s);
    for (std::size_t i = 0; i < r.trace.size(); i++) {
        const double sign        = i % 2 == 0 ? 1.0 : -1.0;
        r.trace[i].omega_e_radps = 100.0 + sign * ripple_e_radps;
        r.trace[i].vq_V          = sign * vq_V;
        r.trace[i].vd_V          = sign * vd_V;
    }
    return r;
}

std::vector<std::string> judged(const Scenario &s, const SimulationResult &r)
{
    return judge(s, r, measure(s, r.trace), {{0.0, 0.5, 6.0, 4.0}});
}

} // namespace

TEST(RandomMotors, RingingWithinTheBandIsNamedByWhatIsLoud)
{
    const Scenario s = read(text(good));

    EXPECT_TRUE(judged(s, ringing(s, 0.49, 5.9, 3.9)).empty());
    const auto ripple = judged(s, ringing(s, 0.51, 5.9, 3.9));
    ASSERT_EQ(ripple.size(), 1U);
    EXPECT_EQ(ripple[0], "whole: ripple 0.51 rad/s, allowed 0.5");
    const auto vq = judged(s, ringing(s, 0.49, 6.2, 3.9));
    ASSERT_EQ(vq.size(), 1U);
    EXPECT_EQ(vq[0], "whole: v_q noise 6.2 V, allowed 6");
    const auto vd = judged(s, ringing(s, 0.49, 5.9, 4.2));
    ASSERT_EQ(vd.size(), 1U);
    EXPECT_EQ(vd[0], "whole: v_d noise 4.2 V, allowed 4");
    EXPECT_EQ(judged(s, ringing(s, 0.49, 5.9, std::nan(""))).size(), 1U);
}

/// The oracle: the medians of 20 seeds of the same scenario, from `run_seeds`.
TEST(RandomMotors, LimitsAreThoseOfTheBelievedMotorInItsSeeds)
{
    Scenario s        = read(support::replaced(text(good), "ideal = true", ""));
    s.plant_scale     = {{"inertia_kgm2", 0.7}}; // of no effect
    const auto limits = noise_limits(s, prepare_controller(s));
    ASSERT_EQ(limits.size(), 1U);

    s.plant_scale.clear();
    const SeedRuns runs   = run_seeds(s, 20);
    const auto     median = [&](const std::string &metric) {
        for (const SeedSpread &spread : runs.measures[0].spread) {
            if (spread.metric == metric) {
                return *spread.median;
            }
        }
        return 0.0;
    };
    EXPECT_NEAR(limits[0].ripple_e_radps, 5.0 * median("ripple_e_radps"), 1e-9);
    EXPECT_NEAR(limits[0].vq_noise_V, 3.0 * median("vq_noise_V"), 1e-9);
    EXPECT_NEAR(limits[0].vd_noise_V, 3.0 * median("vd_noise_V"), 1e-9);
}

TEST(RandomMotors, ExactSignalsHaveTheQuietLimits)
{
    const Scenario s = read(support::replaced(text(good), "duration_s = 0.02", "duration_s = 2.0"));
    const auto     limits = noise_limits(s, prepare_controller(s));
    ASSERT_EQ(limits.size(), 1U);
    const double circle_V = s.drive.inverter.dc_link_V / std::sqrt(3.0);
    EXPECT_NEAR(limits[0].ripple_e_radps, 0.02 * s.drive.motor.rated_speed_e_radps / 523.0, 1e-9);
    EXPECT_NEAR(limits[0].vq_noise_V, 0.2 * circle_V / 170.3, 1e-9);
    EXPECT_NEAR(limits[0].vd_noise_V, 0.2 * circle_V / 170.3, 1e-9);
}

/// Half the inertia, a strong magnet and half the inductance: the speed stays within its band of 4 rad/s, and rings.
TEST(RandomMotors, MotorThatRingsOnTheBoardFails)
{
    Scenario s =
        read_scenario_file(SDRE_SOURCE_DIR "/host_tools/sil/scenarios/board_random_motors.toml");
    s.motor_ranges          = MotorRanges{{1.0, 1.0}, {0.7, 0.7}, {1.4, 1.4}, {0.55, 0.55}};
    const RandomMotors loud = run_random_motors(s, 1);
    ASSERT_EQ(loud.failures.size(), 1U);
    EXPECT_EQ(loud.tripped(), 0);
    EXPECT_EQ(loud.good(), 0);
    for (std::size_t i = 0; i + 1 < loud.failures[0].reasons.size(); i++) {
        EXPECT_NE(loud.failures[0].reasons[i].find("allowed"), std::string::npos);
    }
    s.motor_ranges = MotorRanges{{1.0, 1.0}, {0.9, 0.9}, {1.1, 1.1}, {0.8, 0.8}};
    EXPECT_TRUE(run_random_motors(s, 1).failures.empty());
}

/// Each of the three reasons, of motors that have no other.
TEST(RandomMotors, EachReasonIsGivenByItself)
{
    const auto reasons = [](const std::string &content) {
        const RandomMotors runs = run_random_motors(read(content), 1);
        return runs.failures.empty() ? std::vector<std::string>{} : runs.failures[0].reasons;
    };
    ASSERT_TRUE(reasons(text(good)).empty());

    std::string content =
        support::replaced(text(good), "band_e_radps = 3.0", "band_e_radps = 1e-9");
    const auto band = reasons(content);
    ASSERT_EQ(band.size(), 2U); // and what the motor is like
    EXPECT_NE(band[0].find("whole: not in its band at the end"), std::string::npos) << band[0];

    const auto fault = reasons(
        text(good) + "[[change]]\ntime_s = 0.019\nset = { inverter = { dc_link_V = 50.0 } }\n");
    ASSERT_GE(fault.size(), 2U);
    EXPECT_NE(fault[0].find("fault at 0.0190 s: dc link"), std::string::npos) << fault[0];

    // A load that drags the motor until its EMF flows through the diodes.
    const auto dragged =
        reasons(support::replaced(text(good), "value_Nm = 0.5", "value_Nm = -20.0"));
    ASSERT_EQ(dragged.size(), 4U);
    EXPECT_NE(dragged[1].find(" A, allowed 4.40 A"), std::string::npos) << dragged[1];
}

TEST(RandomMotors, SavedFailureIsTheSameRun)
{
    const support::TempDir dir;
    const auto             file = dir.write("case.toml", text(light));
    const Scenario         s    = read_scenario_file(file);
    const RandomMotors     runs = run_random_motors(s, 2);

    write_files(failed_motor_files(file, "", runs, dir / "failed"));
    const Scenario saved = read_scenario_file(dir / "failed" / "case_motor_2.toml");

    Scenario expected    = s;
    expected.plant_scale = draw_motor(*s.motor_ranges, s.seed, 2);
    expected.seed        = 2;
    EXPECT_EQ(saved.plant_scale, expected.plant_scale);
    EXPECT_EQ(saved.seed, 2U);
    EXPECT_FALSE(saved.motor_ranges);
    const SimulationResult a = simulate(saved);
    const SimulationResult b = simulate(expected);
    ASSERT_EQ(a.trace.size(), b.trace.size());
    for (std::size_t i = 0; i < a.trace.size(); i++) {
        ASSERT_EQ(a.trace[i].omega_e_radps, b.trace[i].omega_e_radps) << i;
    }
}

/// A resonance that was measured is that of the machine, whatever its inertia is. A scenario's own shaft is as it says.
TEST(RandomMotors, MeasuredResonanceStaysWithAnotherInertia)
{
    const auto content = [](const std::string &inertia, const std::string &more) {
        const std::string plain = support::replaced(support::scenario_text("ipmsm_390w_shaft"),
                                                    "law = \"noc\"", "law = \"noc_shaft\"");
        return support::replaced(plain, "[plant_scale]\n", "[plant_scale]\n" + inertia) + more;
    };
    const std::string  twice = "inertia_kgm2 = 2.0\n";
    const MotorEffects one   = read(content("", "")).motor_effects;
    const MotorEffects two   = read(content(twice, "")).motor_effects;
    const MotorEffects own   = read(content(twice, "[motor_effects]\nload_inertia_share = 0.5\n"
                                                     "shaft_stiffness_Nmprad = 99.0\n"))
                                 .motor_effects;
    EXPECT_GT(one.shaft_stiffness_Nmprad, 0.0);
    EXPECT_NEAR(two.shaft_stiffness_Nmprad, 2.0 * one.shaft_stiffness_Nmprad, 1e-9);
    EXPECT_NEAR(two.shaft_damping_Nms, 2.0 * one.shaft_damping_Nms, 1e-12);
    EXPECT_EQ(own.shaft_stiffness_Nmprad, 99.0);

    const Scenario     s    = read(content("", light));
    const RandomMotors runs = run_random_motors(s, 1);
    Scenario           kept = s;
    kept.plant_scale        = draw_motor(*s.motor_ranges, s.seed, 1);
    kept.motor_effects.shaft_stiffness_Nmprad *= kept.plant_scale.at("inertia_kgm2");
    kept.motor_effects.shaft_damping_Nms *= kept.plant_scale.at("inertia_kgm2");
    const SimulationResult   run     = simulate(kept);
    std::vector<std::string> of_kept = judge(kept, run, measure(kept, run.trace), {});
    ASSERT_EQ(runs.failures.size(), 1U);
    ASSERT_FALSE(of_kept.empty());
    EXPECT_EQ(runs.failures[0].reasons[0], of_kept[0]);
    const SimulationResult stiff = simulate([&] {
        Scenario other      = kept;
        other.motor_effects = s.motor_effects;
        return other;
    }());
    EXPECT_NE(stiff.trace.back().omega_e_radps, run.trace.back().omega_e_radps);
}

TEST(RandomMotors, SavedFailureOfAnotherDriveNamesThatDrive)
{
    const support::TempDir dir;
    const auto             file = dir.write("case.toml", text(light));
    const auto             other =
        std::filesystem::path(SDRE_SOURCE_DIR) / "firmware/config/drives/ipmsm_390w_speed.toml";
    const RandomMotors runs = run_random_motors(read_scenario_file(file, other), 1);

    write_files(failed_motor_files(file, other, runs, dir / "failed"));

    ASSERT_EQ(runs.failures.size(), 1U);
    EXPECT_EQ(read_scenario_file(dir / "failed" / "case_motor_1.toml").drive.name,
              "ipmsm_390w_speed");
}

TEST(RandomMotors, MissingOrWrongRangesAreRefused)
{
    EXPECT_THROW(run_random_motors(read(text("")), 1), InputError);
    EXPECT_NE(error_of(text("[motor_ranges]\nresistance = [1.1, 0.9]\n")).find("[motor_ranges]"),
              std::string::npos);
    EXPECT_NE(error_of(text(good + "colour = [1, 2]\n")).find("colour"), std::string::npos);
}

TEST(RandomMotors, CommandPrintsTheShareAndSavesFailures)
{
    const support::TempDir dir;
    const auto             file = dir.write("case.toml", text(light)).string();

    const support::CommandResult r = support::run_command(
        {SDRE_SIL_EXE, "motors", file, "--count", "2", "--failures", (dir / "out").string(),
         "--csv", dir / "m.csv", "--json", dir / "m.json"});

    EXPECT_EQ(r.exit_code, 4) << r.err;
    EXPECT_EQ(r.err, ""); // progress is for terminals
    EXPECT_NE(r.out.find("2 of 2 motors failed"), std::string::npos) << r.out;
    EXPECT_TRUE(std::filesystem::exists(dir / "out" / "case_motor_1.toml"));
    EXPECT_TRUE(std::filesystem::exists(dir / "out" / "case_motor_2.toml"));
    const std::string csv = support::read_file(dir / "m.csv");
    EXPECT_EQ(csv.rfind("motor,resistance,d_axis_inductance,q_axis_inductance,flux,inertia,failed,"
                        "reasons\n1,1,1,1,1,0.02",
                        0),
              0U)
        << csv;
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_NE(csv.find(",1,\""), std::string::npos) << csv;
    const support::Json json = support::Json::read(dir / "m.json");
    EXPECT_EQ(json.at("motors"), 2);
    EXPECT_EQ(json.at("failed"), 2);
    EXPECT_EQ(json.at("failures").at(1).at("motor"), 2);
    EXPECT_EQ(json.at("failures").at(1).at("scale").at("pm_flux_Wb"), 1.0);
}

TEST(RandomMotors, CommandWithoutFailuresIsExitZero)
{
    const support::TempDir dir;
    const auto             file = dir.write("case.toml", text(good)).string();

    const support::CommandResult r = support::run_command(
        {SDRE_SIL_EXE, "motors", file, "--count", "2", "--csv", dir / "m.csv"});

    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(support::read_file(dir / "m.csv").find(",0,\"\"\n"), std::string::npos);
}
