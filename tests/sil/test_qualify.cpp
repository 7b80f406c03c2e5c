// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "json.hpp"
#include "shipped_drive.hpp"
#include "sil/qualify/qualify.hpp"
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
    for (const Json &trial : r.json.at("trials")) {
        EXPECT_LE(trial.at("peak_current_A").number(), 4.4) << trial.at("what").text();
    }
}

/// The same motor with loops that are as noisy as PI loops on a real disc are: refused, and why.
TEST(Qualify, ANoisyDriveIsNotGood)
{
    const Qualified r =
        qualify(support::shipped_drive("ipmsm_390w_pi_foc_edges"), {"--short", "--motors", "0"});

    EXPECT_EQ(r.exit_code, 4);
    EXPECT_EQ(r.json.at("good"), false);
    EXPECT_NE(r.out.find("not good: load step: noise of v_q"), std::string::npos) << r.out;
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
