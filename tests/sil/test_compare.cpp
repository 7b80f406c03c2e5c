// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "design/design.hpp"
#include "json.hpp"
#include "scenario_text.hpp"
#include "sil/eval/compare.hpp"
#include "sil/eval/seeds.hpp"
#include "sil/setup/scenario.hpp"
#include "temp_dir.hpp"

namespace {

using support::scenario_text;
using support::TempDir;

const std::string drives       = std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/";
const std::string speed        = drives + "ipmsm_390w_speed.toml";
const std::string conventional = drives + "ipmsm_390w_conventional.toml";

const std::string published = "paper = { settling_time_s = 0.0123 }\n"
                              "paper_of = { conventional_noc = { settling_time_s = 0.0456 } }\n";

support::CommandResult sil(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), SDRE_SIL_EXE);
    return support::run_command(std::move(arguments));
}

/// A scenario that names a law runs that law only.
std::string without_law()
{
    return support::replaced(scenario_text(), "law = \"noc\"\n", "");
}

/// A load step, so that something happens.
std::string load_step()
{
    return without_law() + published + "[[load_torque]]\ntime_s = 0.01\nvalue_Nm = 1.0\n";
}

} // namespace

TEST(Compare, CellsAreThoseOfRunningEachDrive)
{
    const TempDir          dir;
    const std::string      file = dir.write("case.toml", load_step());
    const sdre::Comparison c =
        sdre::compare({{file}, {speed, conventional}, {}, {"dip_e_radps", "ripple_e_radps"}, 1});
    EXPECT_EQ(c.columns, (std::vector<std::string>{"ipmsm_390w_speed", "ipmsm_390w_conventional"}));
    ASSERT_EQ(c.runs.size(), 2U);
    for (std::size_t i = 0; i < 2; i++) {
        const sdre::Scenario s      = sdre::read_scenario_file(file, i == 0 ? speed : conventional);
        const auto           metric = sdre::measure(s, sdre::simulate(s).trace).at(0);
        EXPECT_EQ(c.runs[i].cells.at("whole").at("dip_e_radps").value, metric.dip_e_radps);
        EXPECT_EQ(c.runs[i].cells.at("whole").at("ripple_e_radps").value, metric.ripple_e_radps);
        EXPECT_EQ(c.runs[i].certified, sdre::design_drive(s.drive).certificate.passed());
    }
    EXPECT_NE(c.runs[0].cells.at("whole").at("dip_e_radps").value,
              c.runs[1].cells.at("whole").at("dip_e_radps").value);
}

TEST(Compare, CellsOfSeveralSeedsAreTheWorst)
{
    const TempDir     dir;
    const std::string file =
        dir.write("case.toml", support::replaced(load_step(), "ideal = true", "ideal = false"));
    const sdre::Comparison c     = sdre::compare({{file}, {speed}, {}, {"ripple_e_radps"}, 3});
    sdre::Scenario         s     = sdre::read_scenario_file(file, speed);
    double                 worst = 0.0;
    double                 sum   = 0.0;
    for (s.seed = 1; s.seed <= 3; s.seed++) {
        const double ripple = sdre::measure(s, sdre::simulate(s).trace).at(0).ripple_e_radps;
        worst               = std::max(worst, ripple);
        sum += ripple;
    }

    EXPECT_EQ(c.runs.at(0).cells.at("whole").at("ripple_e_radps").value, worst);
    EXPECT_GT(worst, sum / 3.0);
}

TEST(Compare, ADriveThatIsNotCertifiedIsSaidToBe)
{
    const std::string servo =
        std::string(SDRE_SOURCE_DIR) + "/host_tools/sil/scenarios/servo_case_1_2.toml";
    const sdre::Comparison c =
        sdre::compare({{servo},
                       {drives + "servo_200w_cdobc_printed.toml", drives + "servo_200w_pid.toml"},
                       {},
                       {"ripple_e_radps"},
                       1});

    EXPECT_FALSE(c.runs.at(0).certified);
    EXPECT_TRUE(c.runs.at(1).certified);
    EXPECT_NE(sdre::compare_markdown(c).find("not certified"), std::string::npos);
}

TEST(Compare, OrdersAreColumnsAndReachTheController)
{
    const TempDir          dir;
    const std::string      file = dir.write("case.toml", load_step());
    const sdre::Comparison c    = sdre::compare({{file}, {speed}, {0, 2}, {"dip_e_radps"}, 1});
    EXPECT_EQ(c.columns,
              (std::vector<std::string>{"ipmsm_390w_speed, order 0", "ipmsm_390w_speed, order 2"}));
    sdre::Scenario s = sdre::read_scenario_file(file);
    s.nosc_order = s.nodo_order = 0;
    const auto metric           = sdre::measure(s, sdre::simulate(s).trace).at(0);
    EXPECT_EQ(c.runs[0].cells.at("whole").at("dip_e_radps").value, metric.dip_e_radps);
}

TEST(Compare, DrivesOfOneNameAreCalledAsTheirFiles)
{
    const TempDir          dir;
    const std::string      file = dir.write("case.toml", load_step());
    const std::string      mine = dir.write("mine.toml", support::read_file(speed));
    const sdre::Comparison c =
        sdre::compare({{file}, {speed, mine, conventional}, {}, {"dip_e_radps"}, 1});
    EXPECT_EQ(c.columns,
              (std::vector<std::string>{"ipmsm_390w_speed", "mine", "ipmsm_390w_conventional"}));
}

TEST(Compare, PublishedValuesGoToTheirLaw)
{
    const TempDir     dir;
    const std::string file  = dir.write("case.toml", load_step());
    const auto        paper = [&](const std::string &drive) {
        return sdre::read_scenario_file(file, drive).measures.at(0).paper;
    };
    EXPECT_EQ(paper("").at("settling_time_s"), 0.0123);
    EXPECT_EQ(paper(conventional).at("settling_time_s"), 0.0456);
    EXPECT_TRUE(paper(drives + "servo_200w_pid.toml").empty());
    const std::string text = sil({"compare", file, "--drive", speed, "--drive", conventional}).out;
    EXPECT_NE(text.find("(paper 12.3)"), std::string::npos) << text;
    EXPECT_NE(text.find("(paper 45.6)"), std::string::npos) << text;
}

TEST(Compare, WritesOneTableThreeWaysAlwaysTheSame)
{
    const TempDir                  dir;
    const std::string              a = dir.write("a.toml", load_step());
    const std::string              b = dir.write("b.toml", load_step());
    const std::vector<std::string> arguments{"compare",
                                             a,
                                             b,
                                             "--drive",
                                             speed,
                                             "--drive",
                                             conventional,
                                             "--csv",
                                             dir / "t.csv",
                                             "--json",
                                             dir / "t.json",
                                             "--markdown",
                                             dir / "t.md"};
    const auto                     r = sil(arguments);
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.out, support::read_file(dir / "t.md"));
    EXPECT_EQ(
        r.out.rfind(
            "| scenario | measure | metric | ipmsm_390w_speed | ipmsm_390w_conventional |\n", 0),
        0U);
    const auto lines = [](const std::string &text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    const std::string csv = support::read_file(dir / "t.csv");
    EXPECT_EQ(lines(csv), 1 + 2 * 8 * 2);
    EXPECT_EQ(lines(r.out), 2 + 2 * 8 + 2 * 4); // neither of the four runs is of a certified drive
    const auto json = support::Json::read(dir / "t.json");
    EXPECT_EQ(json.at("runs").size(), 4U);
    EXPECT_EQ(json.at("runs").at(1).at("drive"), "ipmsm_390w_conventional");
    EXPECT_EQ(json.at("runs").at(3).at("scenario"), "b");
    EXPECT_EQ(sil(arguments).out, r.out);
    EXPECT_EQ(support::read_file(dir / "t.csv"), csv);
}

TEST(Compare, FaultsAreSaidAndSetTheExitCode)
{
    const TempDir     dir;
    const std::string file =
        dir.write("case.toml", scenario_text() + "[inverter]\ndc_link_V = 50.0\n");
    const auto r = sil({"compare", file});
    EXPECT_EQ(r.exit_code, 4);
    EXPECT_NE(r.out.find("| fault |"), std::string::npos) << r.out;
}

TEST(Compare, WrongRequestsAreOneLine)
{
    const TempDir     dir;
    const std::string file    = dir.write("case.toml", scenario_text());
    const auto        refused = [&](std::vector<std::string> arguments, const std::string &piece) {
        arguments.insert(arguments.begin(), "compare");
        support::expect_refused(sil(arguments), 1, "sdre-sil", {piece});
    };
    refused({}, "SCENARIO");
    refused({file, file}, "twice");
    refused({file, "--drive", speed, "--drive", speed}, "ipmsm_390w_speed");
    refused({file, "--metric", "beauty"}, "beauty");
    refused({file, "--order", "9"}, "--order");
    refused({file, "--drive", conventional}, "law");
    refused({file, "--drive", dir / "none.toml"}, "none.toml");
    refused({dir.write("bad.toml", scenario_text() + "paper_of = { noc = { iq_A = 1.0 } }\n")},
            "paper_of");
    refused({dir.write("bad.toml", scenario_text() + "paper_of = { pdi = { iq_A = 1.0 } }\n")},
            "pdi");
}
