// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "json.hpp"
#include "shipped_drive.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/qualify/map.hpp"
#include "sil/qualify/qualify.hpp"
#include "sil/run/simulation.hpp"
#include "temp_dir.hpp"

namespace {

using support::Json;
using support::TempDir;

struct Qualified {
    int         exit_code;
    std::string out;
    Json        json;
};

Qualified qualify(const std::string &drive, const std::vector<std::string> &more)
{
    const TempDir            dir;
    const std::string        file = dir / "q.json";
    std::vector<std::string> all{SDRE_SIL_EXE, "qualify", drive, "--json", file};
    all.insert(all.end(), more.begin(), more.end());
    const support::CommandResult r = support::run_command(all);
    return {r.exit_code, r.out, Json::parse(support::read_file(file))};
}

} // namespace

TEST(Qualify, FrequencyThatTheCounterHasNotIsSaidWithTheWantedOne)
{
    sdre::Qualification q;
    q.inverter.pwm_frequency_Hz = 75e6 / (2 * 4688);
    q.inverter.pwm_wanted_Hz    = 8000.0;
    const std::string both      = "PWM at 7999.147 Hz, the nearest to 8000 Hz that the counter has";
    EXPECT_NE(sdre::qualification_text(q).find("\n" + both + "\n"), std::string::npos);
    EXPECT_NE(sdre::qualification_html(q).find("<p>" + both), std::string::npos);
    const Json json = Json::parse(sdre::qualification_json(q));
    EXPECT_EQ(json.at("pwm_wanted_Hz").number(), 8000.0);
    EXPECT_NEAR(json.at("pwm_frequency_Hz").number(), 7999.147, 1e-3);
    q.inverter.pwm_wanted_Hz = q.inverter.pwm_frequency_Hz;
    EXPECT_EQ(sdre::qualification_text(q).find("PWM"), std::string::npos);
}

TEST(Qualify, TheShippedDriveIsGood)
{
    const Qualified r = qualify(support::shipped_drive("ipmsm_390w"), {"--short", "--noise", "7"});

    EXPECT_EQ(r.exit_code, 0) << r.out;
    EXPECT_EQ(r.json.at("good"), true);
    EXPECT_EQ(r.json.at("motors").at("good"), 40);
    EXPECT_EQ(r.json.at("trials").size(), 12U);
    EXPECT_EQ(r.json.at("torques").at("good"), true);
    EXPECT_NE(r.out.find("\ntorques at 261.5 rad/s: a tenth of the rated one after"),
              std::string::npos);
    for (const Json &trial : r.json.at("trials")) {
        EXPECT_LE(trial.at("peak_current_A").number(), 4.4) << trial.at("what").text();
    }
}

/// The map: an independent run at one of its points has the same ripples, and every limit is judged.
TEST(Qualify, MapIsOfSteadyRunsOverThePlane)
{
    const sdre::Drive    drive = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    const sdre::PlaneMap map   = sdre::plane_map(drive, 3, 1);
    ASSERT_EQ(map.points.size(), 9U);
    EXPECT_TRUE(sdre::map_reasons(map).empty());
    EXPECT_EQ(map.points[0].speed_e_radps, 0.0);
    EXPECT_LT(map.points[0].torque_Nm, -2.4);
    EXPECT_EQ(map.points[4].torque_Nm, 0.0);
    EXPECT_GT(map.points[8].speed_e_radps, 1190.0);

    sdre::Scenario s        = sdre::at_speed(drive, 523.0, 0.0);
    const double   friction = 1e-4 * 0.5 * map.points[5].speed_e_radps;
    const double   ramp_s   = sdre::steady_after_s(drive, map.points[5].speed_e_radps - 523.0);
    s.speed_reference       = {{0.0, map.points[5].speed_e_radps}};
    s.load_ramps            = {{ramp_s, 2.0 * ramp_s, map.points[5].torque_Nm - friction}};
    s.duration_s            = 3.0 * ramp_s + 0.2;
    s.measures              = {{"steady", 3.0 * ramp_s - 1e-6, 1.0, {}}};
    s.measures[0].tail_s    = 0.2;
    const auto m            = sdre::measure(s, sdre::simulate(s).trace).at(0);
    EXPECT_NEAR(m.effort.vq_noise_V, map.points[5].board.vq_V, 0.02 * map.points[5].board.vq_V);
    EXPECT_NEAR(m.effort.vd_noise_V, map.points[5].board.vd_V, 0.02 * map.points[5].board.vd_V);
    EXPECT_NEAR(m.iq_A, 2.0, 1.0);
}

TEST(Qualify, EveryLimitOfTheMapIsJudged)
{
    sdre::PlaneMap good;
    good.points      = {sdre::MapPoint{}, sdre::MapPoint{}};
    good.ideal_limit = {0.2, 0.2, 0.02};
    good.board_limit = {10.0, 10.0, 0.0};
    EXPECT_TRUE(sdre::map_reasons(good).empty());
    const auto reasons = [&](auto change) {
        sdre::PlaneMap bad = good;
        change(bad.points[1]);
        return sdre::map_reasons(bad);
    };
    const double nan = std::nan("");
    for (const double much : {11.0, nan}) {
        for (double sdre::Ripples::*value :
             {&sdre::Ripples::vq_V, &sdre::Ripples::vd_V, &sdre::Ripples::speed_e_radps}) {
            EXPECT_EQ(reasons([&](sdre::MapPoint &p) { p.ideal.*value = much; }).size(), 1U);
        }
        for (double sdre::Ripples::*value : {&sdre::Ripples::vq_V, &sdre::Ripples::vd_V}) {
            EXPECT_EQ(reasons([&](sdre::MapPoint &p) { p.board.*value = much; }).size(), 1U);
        }
    }
    EXPECT_EQ(reasons([](sdre::MapPoint &p) { p.faults = 1; }).size(), 1U);
    EXPECT_EQ(reasons([](sdre::MapPoint &p) { p.board.speed_e_radps = 1.0; }).size(), 0U);
}

TEST(Qualify, PictureOfTheMapShowsWhatIsBeyond)
{
    sdre::PlaneMap map;
    map.points      = std::vector<sdre::MapPoint>(4);
    map.ideal_limit = {0.2, 0.2, 0.02};
    map.board_limit = {10.0, 10.0, 0.0};
    const auto reds = [&] {
        const std::string svg = sdre::map_svg(map);
        std::size_t       n   = 0;
        for (std::size_t at = svg.find("#d7301f"); at != std::string::npos;
             at             = svg.find("#d7301f", at + 1)) {
            n++;
        }
        return n;
    };
    EXPECT_EQ(reds(), 0U);
    map.points[3].board.vd_V = 10.5;
    EXPECT_EQ(reds(), 1U);
    map.points[0].ideal.vq_V = 0.3;
    EXPECT_EQ(reds(), 2U);
}

/// The same motor with loops that are as noisy as PI loops on a real disc are: refused, and why.
TEST(Qualify, ANoisyDriveIsNotGood)
{
    const Qualified r =
        qualify(support::shipped_drive("ipmsm_390w_pi_foc"), {"--short", "--motors", "0"});

    EXPECT_EQ(r.exit_code, 4);
    EXPECT_EQ(r.json.at("good"), false);
    EXPECT_NE(r.out.find("not good: load step: noise of v_q"), std::string::npos) << r.out;
}

TEST(Qualify, TorquesAreTriedWhereTheDriveTakesThem)
{
    const sdre::Drive drive = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    const auto        found = sdre::torque_trial(drive, 2);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->reasons.empty()) << found->reasons.front();
    // The oracle: the same steps in a run of their own, by the trace.
    const sdre::Scenario         s       = sdre::torque_scenario(drive);
    const sdre::SimulationResult r       = sdre::simulate(s, sdre::prepare_controller(s)); // seed 1
    double                       rated_s = 0.0;
    for (const sdre::TraceRow &row : r.trace) {
        if (row.time_s >= s.measures[2].time_s && row.torque_Nm < 0.15 + 0.9 * (1.5 - 0.15)) {
            rated_s = row.time_s - s.measures[2].time_s;
        } else if (row.time_s > s.measures[2].time_s) {
            break;
        }
    }
    const double period_s = 200e-6;
    EXPECT_NEAR(*found->rated_s, rated_s + 0.5 * period_s, period_s);
    EXPECT_GT(rated_s, found->least_rated_s); // no drive beats it
    EXPECT_LT(*found->tenth_s, *found->rated_s);

    const std::string words = sdre::torque_words(*found);
    EXPECT_NE(words.find(": good"), std::string::npos) << words;
    EXPECT_FALSE(
        sdre::torque_trial(sdre::read_drive_file(support::shipped_drive("ipmsm_390w_pi_foc")), 1));
}

/// The current limit is below what the rated torque takes.
TEST(Qualify, TorquesOfAPoorDriveAreNotGood)
{
    sdre::Drive weak           = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    weak.motor.max_current_A   = 1.6; // below what the rated torque takes
    weak.motor.rated_torque_Nm = 1.5;
    const auto little          = sdre::torque_trial(weak, 1);
    ASSERT_TRUE(little);
    ASSERT_FALSE(little->reasons.empty());
    EXPECT_NE(sdre::torque_words(*little).find("all of the rated torque does not come"),
              std::string::npos)
        << sdre::torque_words(*little);
}

TEST(Qualify, TrialsAreMadeOfTheDrivesNumbers)
{
    sdre::Drive      drive   = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    const sdre::Plan plan    = sdre::qualification_plan(drive, 0.04);
    drive.motor.inertia_kgm2 = 10.0 * drive.motor.inertia_kgm2;
    const sdre::Plan heavy   = sdre::qualification_plan(drive, 0.04);
    ASSERT_EQ(plan.trials.size(), heavy.trials.size());

    EXPECT_DOUBLE_EQ(plan.trials[0].scenario.load_torque.back().value, 1.5);
    EXPECT_DOUBLE_EQ(plan.trials[0].scenario.initial_speed_e_radps, 261.5);
    // A count a period is 2 pi rad/s of the field: a ten thousandth of a turn, 2 pole pairs, 200 us.
    const double counts = plan.trials[1].scenario.initial_speed_e_radps / (2.0 * std::acos(-1.0));
    EXPECT_NEAR(counts, std::round(counts), 1e-9);
    EXPECT_GT(heavy.trials[3].scenario.duration_s, 2.0 * plan.trials[3].scenario.duration_s);
    EXPECT_LT(heavy.trials[0].most_dip_e_radps, 0.3 * plan.trials[0].most_dip_e_radps);
    EXPECT_DOUBLE_EQ(plan.trials[0].scenario.sensors.adc_full_scale_A, 10.0);
}
