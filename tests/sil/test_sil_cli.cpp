// SPDX-License-Identifier: MIT
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "examples.hpp"
#include "json.hpp"
#include "scenario_text.hpp"
#include "sil/eval/results.hpp"
#include "temp_dir.hpp"

namespace {

using support::CommandResult;
using support::replaced;
using support::scenario_text;
using support::TempDir;

const std::string tool = "sdre-sil";

CommandResult sil(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), SDRE_SIL_EXE);
    return support::run_command(std::move(arguments));
}

void expect_refused(const std::vector<std::string> &arguments, int exit_code,
                    const std::vector<std::string> &pieces)
{
    std::string all;
    for (const std::string &argument : arguments) {
        all += " " + argument;
    }
    SCOPED_TRACE("sdre-sil" + all);
    support::expect_refused(sil(arguments), exit_code, tool, pieces);
}

/// A scenario whose supply is too low: the drive faults in its first period.
std::string faulting_scenario()
{
    return scenario_text() + "[inverter]\ndc_link_V = 50.0\n";
}

std::set<std::string> keys_of(const support::Json &object)
{
    std::set<std::string> keys;
    for (const auto &[key, value] : object.items()) {
        keys.insert(key);
    }
    return keys;
}

bool draws_plots()
{
    static const bool able = [] {
        const TempDir     dir;
        const std::string scenario = dir.write("case.toml", scenario_text());
        const auto        r        = sil({"run", scenario, "--plot", dir / "p.png"});
        return r.err.find("no Python") == std::string::npos;
    }();
    return able;
}

} // namespace

TEST(SilCli, WrongCommandLineIsOneLine)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    expect_refused({}, 1, {"subcommand"});
    expect_refused({"walk"}, 1, {"walk", "no such subcommand", "run, compare"});
    expect_refused({"run", "--sceds", "3"}, 1, {"--sceds"});
    expect_refused({"run", scenario, "--seed", "1", "--seeds", "2"}, 1, {"--seed"});
    expect_refused({"run"}, 1, {"SCENARIO"});
    expect_refused({"run", scenario, "--colour"}, 1, {"--colour"});
    expect_refused({"run", scenario, "--csv"}, 1, {"--csv"});
    expect_refused({"run", scenario, "extra"}, 1, {"extra"});
}

TEST(SilCli, HelpAndVersionAreNoErrors)
{
    for (const std::vector<std::string> &arguments :
         {std::vector<std::string>{"--help"}, {"run", "--help"}}) {
        const CommandResult r = sil(arguments);
        EXPECT_EQ(r.exit_code, 0);
        EXPECT_EQ(r.err, "");
        EXPECT_NE(r.out.find("--help"), std::string::npos);
    }
    EXPECT_EQ(sil({"--version"}).out, "sdre-sil 1.0.0\n");
}

TEST(SilCli, EveryCommandHasAnExample)
{
    EXPECT_EQ(support::commands_of(SDRE_SIL_EXE).size(), 8U);
    support::expect_examples(SDRE_SIL_EXE, tool);
}

TEST(SilCli, PrintsMetricsAndWritesNothingUnasked)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    const CommandResult r = sil({"run", scenario});

    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_EQ(r.out.rfind("case on ipmsm_390w_speed, gains: solved in process\n", 0), 0U) << r.out;
    for (const char *piece : {"whole", "settling time [ms]", "peak current [A]", "i_d [A]"}) {
        EXPECT_NE(r.out.find(piece), std::string::npos) << piece;
    }
    EXPECT_EQ(r.out.find("FAULT"), std::string::npos);
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"case.toml"}));
}

TEST(SilCli, PublishedValuesArePrintedBesideOurs)
{
    const TempDir     dir;
    const std::string scenario = dir.write(
        "case.toml", scenario_text() + "paper = { settling_time_s = 0.0123, id_A = -7.5 }\n");

    const std::string out = sil({"run", scenario}).out;

    for (const char *piece : {"paper", "12.3", "-7.500"}) {
        EXPECT_NE(out.find(piece), std::string::npos) << piece << " not in\n" << out;
    }
}

TEST(SilCli, CsvHasTheAgreedColumnsAndOneRowPerPeriod)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    ASSERT_EQ(sil({"run", scenario, "--csv", dir / "t.csv"}).exit_code, 0);

    const std::string csv = support::read_file(dir / "t.csv");
    EXPECT_EQ(csv.substr(0, csv.find('\n')),
              "time_s,omega_ref_e_radps,omega_e_radps,iq_A,id_A,iq_ref_A,id_ref_A,vq_V,vd_V,"
              "d_omega_hat,d_q_hat,d_d_hat,load_torque_Nm,torque_Nm,dc_link_V,position_e_rad,"
              "position_ref_e_rad,ia_A,ib_A,ic_A");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 101); // 20 ms at 5 kHz, both ends
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 19 * 102);
    const std::string first = csv.substr(csv.find('\n') + 1);
    EXPECT_EQ(first.rfind("0,100,100,0,0,", 0), 0U) << first.substr(0, 80);
    const std::string row = first.substr(0, first.find('\n'));
    EXPECT_NE(row.find(",0.5,0,295,"), std::string::npos) << row; // load before any torque
    EXPECT_EQ(csv.find("nan"), std::string::npos);
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"case.toml", "t.csv"}));
}

TEST(SilCli, CsvIsDeterministic)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    sil({"run", scenario, "--csv", dir / "a.csv"});
    sil({"run", scenario, "--csv", dir / "b.csv"});

    EXPECT_TRUE(support::read_file(dir / "a.csv") == support::read_file(dir / "b.csv"));
}

TEST(SilCli, JsonHasTheAgreedKeys)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    ASSERT_EQ(sil({"run", scenario, "--json", dir / "r.json"}).exit_code, 0);

    const auto r = support::Json::read(dir / "r.json");
    EXPECT_EQ(r.at("scenario"), "case");
    EXPECT_EQ(r.at("drive"), "ipmsm_390w_speed");
    EXPECT_EQ(r.at("gains"), "solved in process");
    EXPECT_EQ(r.at("uncertified").size(), 3U);
    EXPECT_EQ(r.at("fault"), "none");
    EXPECT_TRUE(r.at("fault_time_s").is_null());
    EXPECT_EQ(keys_of(r),
              (std::set<std::string>{"scenario", "drive", "seed", "gains", "uncertified", "fault",
                                     "fault_time_s", "measures"})); // no clock: the same every time
    EXPECT_EQ(keys_of(r.at("measures").at("whole")),
              (std::set<std::string>{"time_s",
                                     "settling_time_s",
                                     "dip_e_radps",
                                     "overshoot_e_radps",
                                     "steady_state_error_e_radps",
                                     "ripple_e_radps",
                                     "peak_current_A",
                                     "steady_current_A",
                                     "vq_noise_V",
                                     "vd_noise_V",
                                     "vq_noise_percent",
                                     "iq_noise_A",
                                     "torque_noise_percent",
                                     "audible_torque_percent",
                                     "audible_current_A",
                                     "equivalent_delay_s",
                                     "current_distortion_percent",
                                     "sensor_offset_hat_A",
                                     "d_omega_hat",
                                     "d_q_hat",
                                     "d_d_hat",
                                     "iq_A",
                                     "id_A",
                                     "fluctuation_rpm",
                                     "fluctuation_rate_percent",
                                     "offset_rpm",
                                     "decrease_rpm",
                                     "overshoot_percent",
                                     "within_5_percent_s",
                                     "within_2_percent_s",
                                     "within_1_percent_s"}));
}

TEST(SilCli, JsonSaysNullWhereTheSpeedNeverSettles)
{
    const TempDir     dir;
    const std::string scenario = dir.write(
        "case.toml", replaced(scenario_text(), "value_e_radps = 100.0", "value_e_radps = 400.0"));

    ASSERT_EQ(sil({"run", scenario, "--json", dir / "r.json"}).exit_code, 0);

    const auto r = support::Json::read(dir / "r.json");
    EXPECT_TRUE(r.at("measures").at("whole").at("settling_time_s").is_null());
    EXPECT_NE(sil({"run", scenario}).out.find("never"), std::string::npos);
}

TEST(SilCli, ScenarioWithoutMeasuresSaysSo)
{
    const TempDir     dir;
    const std::string text     = scenario_text();
    const std::string scenario = dir.write("case.toml", text.substr(0, text.find("[[measure]]")));

    for (const std::vector<std::string> &arguments : {std::vector<std::string>{"run", scenario},
                                                      {"run", scenario, "--seeds", "2"},
                                                      {"compare", scenario}}) {
        const CommandResult r = sil(arguments);
        EXPECT_EQ(r.exit_code, 0) << r.err;
        EXPECT_NE(r.out.find("no measures"), std::string::npos) << r.out;
        EXPECT_EQ(r.out.find("settling"), std::string::npos) << r.out;
    }
}

TEST(SilCli, SeedsPrintTheLabelsOfOneRun)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    const std::string out = sil({"run", scenario, "--seeds", "2"}).out;

    for (const char *piece : {"settling time [ms]", "peak current [A]", "whole worst", "mean"}) {
        EXPECT_NE(out.find(piece), std::string::npos) << piece;
    }
    EXPECT_EQ(out.find("settling_time_s"), std::string::npos);
}

TEST(SilCli, DistortionOfNoCurrentIsNotShown)
{
    const TempDir     dir;
    const std::string scenario =
        dir.write("case.toml", replaced(scenario_text(), "value_Nm = 0.5", "value_Nm = 0.0"));

    const CommandResult r = sil({"run", scenario, "--json", dir / "r.json"});

    EXPECT_EQ(r.exit_code, 0) << r.err;
    const support::Json json = support::Json::read(dir / "r.json");
    EXPECT_TRUE(json.at("measures").at("whole").at("current_distortion_percent").is_null())
        << r.out;
    const std::size_t row = r.out.find("current distortion [%]");
    EXPECT_EQ(r.out.substr(row, 42), "current distortion [%]                   -") << r.out;
}

TEST(SilCli, SeedsRunOnABoardToo)
{
    const TempDir     dir;
    const std::string scenario =
        std::string(SDRE_SOURCE_DIR) + "/host_tools/sil/scenarios/board_load_step.toml";
    const auto dip = [&](const std::vector<std::string> &more) {
        std::vector<std::string> arguments{"run", scenario, "--board",
                                           "api", "--json", dir / "r.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult r = sil(arguments);
        EXPECT_EQ(r.exit_code, 0) << r.err;
        EXPECT_EQ(r.out.rfind("board: api\n", 0), 0U) << r.out;
        const support::Json file = support::Json::read(dir / "r.json");
        const support::Json m    = file.at("measures").at("load_step");
        const bool          many = !more.empty() && more.front() == "--seeds";
        return (many ? m.at("worst") : m).at("dip_e_radps").number();
    };

    EXPECT_EQ(dip({"--seeds", "2"}), std::max(dip({"--seed", "1"}), dip({"--seed", "2"})));
}

// 170 MHz counter, bootstrap supplies that are charged before the run, commands in the period that the scenario names.
TEST(SilCli, ADriveForAnotherProcessorRunsOnTheFakeBoardAlone)
{
    const TempDir     dir;
    const std::string root     = SDRE_SOURCE_DIR;
    const std::string scenario = root + "/host_tools/sil/scenarios/m2310p_speed_step.toml";
    const auto        measures = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {"--json", dir / "r.json"});
        const CommandResult r = sil(arguments);
        EXPECT_EQ(r.exit_code, 0) << r.err;
        return support::Json::read(dir / "r.json").at("measures");
    };
    const support::Json core = measures({"run", scenario});
    const support::Json api  = measures({"run", scenario, "--board", "api"});
    for (const char *name : {"rated_speed", "largest_speed"}) {
        const auto number = [&](const support::Json &of, const char *key) {
            return of.at(name).at(key).number();
        };
        EXPECT_NEAR(number(api, "settling_time_s"), number(core, "settling_time_s"), 8e-4) << name;
        EXPECT_NEAR(number(api, "ripple_e_radps"), number(core, "ripple_e_radps"), 0.4) << name;
        EXPECT_LT(number(api, "overshoot_e_radps"), 3.0) << name;
        EXPECT_LT(number(api, "peak_current_A"), 1.05 * 14.0) << name;
    }
    // Every edge of the legs has its time in counts.
    const std::string load = support::replaced(
        support::read_file(root + "/host_tools/sil/scenarios/m2310p_load_step.toml"), "../../..",
        root);
    const support::Json switched = measures(
        {"run", dir.write("s.toml", load + "\n[inverter]\nmodel = \"switched\"\n").string(),
         "--board", "api"});
    EXPECT_NEAR(switched.at("load_step").at("steady_current_A").number(), 7.04, 0.1);
    EXPECT_LT(switched.at("load_step").at("ripple_e_radps").number(), 1.0);
    for (const std::vector<std::string> &arguments :
         {std::vector<std::string>{"run", scenario, "--board", "f28335"},
          {"serve", root + "/firmware/config/drives/m2310p_24v.toml", "--tcp", "0"}}) {
        const CommandResult r = sil(arguments);
        EXPECT_EQ(r.exit_code, 1);
        EXPECT_NE(r.err.find("cannot be the stm32g431 of board \"b_g431b_esc1\""),
                  std::string::npos)
            << r.err;
    }
}

TEST(SilCli, AnotherDriveTakesThePlaceOfTheScenarios)
{
    const TempDir     dir;
    const std::string root     = SDRE_SOURCE_DIR;
    const std::string scenario = root + "/host_tools/sil/scenarios/servo_case_3_4.toml";
    const std::string pid      = root + "/firmware/config/drives/servo_200w_pid.toml";

    ASSERT_EQ(sil({"run", scenario, "--drive", pid, "--json", dir / "r.json"}).exit_code, 0);

    EXPECT_EQ(support::Json::read(dir / "r.json").at("drive"), "servo_200w_pid");
    expect_refused({"run", scenario, "--drive", dir / "none.toml"}, 1, {"none.toml"});
    const std::string paper_a = dir.write("case.toml", scenario_text());
    expect_refused({"run", paper_a, "--drive", pid}, 1, {"law", "\"pid\""});
}

TEST(SilCli, SpectrumIsATableOrAPicture)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    ASSERT_EQ(sil({"run", scenario, "--spectrum", dir / "s.csv"}).exit_code, 0);
    EXPECT_EQ(
        support::read_file(dir / "s.csv").rfind("measure,frequency_Hz,amplitude_rpm\nwhole,", 0),
        0U);
    expect_refused({"run", scenario, "--spectrum", dir / "s.txt"}, 1, {"s.txt"});
    if (draws_plots()) {
        ASSERT_EQ(sil({"run", scenario, "--spectrum", dir / "s.png"}).exit_code, 0);
        EXPECT_EQ(support::read_file(dir / "s.png").rfind("\x89PNG", 0), 0U);
    }
}

TEST(SilCli, GainsSolvedInProcessAreSaidSo)
{
    const TempDir     dir;
    const std::string scenario =
        dir.write("case.toml", replaced(scenario_text(), "[controller_scale]\n",
                                        "[controller_scale]\ninertia_kgm2 = 2.0\n"));

    const CommandResult r = sil({"run", scenario, "--json", dir / "r.json"});

    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(r.out.find("gains: solved in process"), std::string::npos);
    EXPECT_EQ(support::Json::read(dir / "r.json").at("gains"), "solved in process");
}

TEST(SilCli, FaultIsExitFourWithItsReasonAndTrace)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", faulting_scenario());

    const CommandResult r =
        sil({"run", scenario, "--csv", dir / "t.csv", "--json", dir / "r.json"});

    EXPECT_EQ(r.exit_code, 4) << r.err;
    EXPECT_NE(r.out.find("FAULT at 0.0000 s: dc link out of range"), std::string::npos) << r.out;
    const auto json = support::Json::read(dir / "r.json");
    EXPECT_EQ(json.at("fault"), "dc link out of range");
    EXPECT_EQ(json.at("fault_time_s"), 0.0);
    const std::string csv = support::read_file(dir / "t.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 102);
}

TEST(SilCli, BadScenarioIsBadInput)
{
    const TempDir     dir;
    const std::string out  = dir / "t.csv";
    const auto        file = [&](const std::string &text) {
        return dir.write("case.toml", text).string();
    };

    expect_refused({"run", dir / "none.toml", "--csv", out}, 1, {"none.toml"});
    expect_refused({"run", dir.path(), "--csv", out}, 1, {dir.path().string()});
    expect_refused({"run", file("drive = "), "--csv", out}, 1, {"case.toml:1: not valid TOML"});
    expect_refused({"run", file(""), "--csv", out}, 1, {"drive is missing"});
    expect_refused({"run", file(replaced(scenario_text(), "0.02", "-1.0")), "--csv", out}, 1,
                   {"duration_s = -1"});
    expect_refused({"run", file(replaced(scenario_text(), "ipmsm_390w_speed.toml", "none.toml"))},
                   1, {"none.toml: no such file"});
    expect_refused(
        {"run", file(replaced(scenario_text(), "[plant_scale]", "[plant_scale]\nx = 1"))}, 1,
        {"x"});
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(SilCli, ControllerThatCannotBeDesignedIsExitTwo)
{
    const TempDir     dir;
    const std::string scenario =
        dir.write("case.toml", replaced(scenario_text(), "[controller_scale]\n",
                                        "[controller_scale]\nd_axis_inductance_H = 2.0\n"));

    expect_refused({"run", scenario, "--csv", dir / "t.csv"}, 2, {});
    EXPECT_FALSE(std::filesystem::exists(dir / "t.csv"));
}

TEST(SilCli, OutputThatCannotBeWrittenLeavesEarlierFiles)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    const std::string kept     = dir.write("kept.csv", "earlier");

    expect_refused({"run", scenario, "--csv", kept + "/t.csv"}, 1, {kept});
    expect_refused({"run", scenario, "--json", dir / "none/r.json"}, 1, {"none/r.json"});
    expect_refused({"run", scenario, "--csv", kept, "--json", dir / "none/r.json"}, 1, {"r.json"});
    EXPECT_TRUE(support::read_file(kept) == "earlier");
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"case.toml", "kept.csv"}));
}

TEST(SilCli, TargetThatIsADirectoryLeavesEarlierFiles)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    const std::string kept     = dir.write("kept.csv", "earlier");
    std::filesystem::create_directory(dir / "taken");

    expect_refused({"run", scenario, "--csv", kept, "--json", dir / "taken"}, 1, {"taken"});

    EXPECT_TRUE(support::read_file(kept) == "earlier");
    EXPECT_EQ(support::names_in(dir.path()),
              (std::set<std::string>{"case.toml", "kept.csv", "taken"}));
}

TEST(SilCli, LinksAreFollowedAndModesKept)
{
    namespace fs = std::filesystem;
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    const fs::path    real     = dir.write("real.csv", "earlier");
    fs::permissions(real, fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("real.csv", dir / "link.csv");
    fs::create_symlink("new.json", dir / "link.json");

    ASSERT_EQ(
        sil({"run", scenario, "--csv", dir / "link.csv", "--json", dir / "link.json"}).exit_code,
        0);

    EXPECT_TRUE(fs::is_symlink(dir / "link.csv"));
    EXPECT_TRUE(fs::is_symlink(dir / "link.json"));
    EXPECT_EQ(support::read_file(real).rfind("time_s,", 0), 0U);
    EXPECT_EQ(fs::status(real).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(support::read_file(dir / "new.json").rfind("{", 0), 0U);
    EXPECT_EQ(
        support::names_in(dir.path()),
        (std::set<std::string>{"case.toml", "link.csv", "link.json", "new.json", "real.csv"}));
}

TEST(SilCli, DevicesAndPipesAreWrittenToAsTheyAre)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    const std::string kept     = dir.write("kept.json", "earlier");

    expect_refused({"run", scenario, "--json", kept, "--csv", "/dev/full"}, 1,
                   {"/dev/full: cannot write: No space left"});
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
    EXPECT_EQ(support::read_file(kept), "earlier");
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"case.toml", "kept.json"}));
    EXPECT_EQ(sil({"run", scenario, "--csv", "/dev/null"}).exit_code, 0);

    const CommandResult r = support::run_command(
        {"/bin/sh", "-c",
         "mkfifo \"$1\"; cat \"$1\" & \"$2\" run \"$3\" --csv \"$1\" > /dev/null; wait", "sh",
         (dir / "pipe").string(), SDRE_SIL_EXE, scenario});
    EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 102);
    EXPECT_TRUE(std::filesystem::is_fifo(dir / "pipe"));
    const CommandResult both = sil({"run", scenario, "--csv", "/dev/stdout"});
    EXPECT_EQ(both.out.rfind("time_s,", 0), 0U);
    EXPECT_NE(both.out.find("\ncase on ipmsm_390w_speed"), std::string::npos);
}

TEST(SilCli, OneFileForTwoOutputsIsRefused)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    const std::string kept     = dir.write("kept", "earlier");

    expect_refused({"run", scenario, "--csv", kept, "--json", (dir / "./kept").string()}, 1,
                   {"twice"});
    EXPECT_EQ(support::read_file(kept), "earlier");
}

TEST(SilCli, PlotOfAnUnknownKindLeavesEarlierFiles)
{
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    const std::string kept     = dir.write("kept.csv", "earlier");

    expect_refused({"run", scenario, "--csv", kept, "--plot", dir / "p.jpg"}, 1,
                   {"p.jpg", ".png or a .svg"});

    EXPECT_TRUE(support::read_file(kept) == "earlier");
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"case.toml", "kept.csv"}));
}

TEST(SilCli, PlotsAreRealPictures)
{
    if (!draws_plots()) {
        GTEST_SKIP() << "built without a Python that has matplotlib";
    }
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());

    const CommandResult png = sil({"run", scenario, "--plot", dir / "p.png"});
    const CommandResult svg = sil({"run", scenario, "--plot", dir / "p.svg"});

    EXPECT_EQ(png.exit_code, 0) << png.err;
    EXPECT_EQ(support::read_file(dir / "p.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(svg.exit_code, 0) << svg.err;
    EXPECT_NE(support::read_file(dir / "p.svg").find("<svg"), std::string::npos);
    EXPECT_EQ(support::names_in(dir.path()),
              (std::set<std::string>{"case.toml", "p.png", "p.svg"}));
}

TEST(SilCli, PlotsAreRealPicturesOfEveryComparedDrive)
{
    if (!draws_plots()) {
        GTEST_SKIP() << "built without a Python that has matplotlib";
    }
    const TempDir     dir;
    const std::string scenario =
        dir.write("case.toml", support::replaced(scenario_text(), "law = \"noc\"\n", ""));
    const std::string drives = std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/";
    const std::vector<std::string> common{"compare",  scenario,
                                          "--drive",  drives + "ipmsm_390w_speed.toml",
                                          "--drive",  drives + "ipmsm_390w_conventional.toml",
                                          "--metric", "ripple_e_radps"};
    const auto                     drawn = [&](const char *name) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {"--plot", dir / name});
        const CommandResult r = sil(arguments);
        EXPECT_EQ(r.exit_code, 0) << r.err;
        return support::read_file(dir / name);
    };

    EXPECT_EQ(drawn("p.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
    const std::string svg = drawn("p.svg");
    for (const char *piece : {"<svg", "<!-- case -->", "<!-- whole, closer -->", "<!-- wanted -->",
                              "<!-- ipmsm_390w_speed -->", "<!-- ipmsm_390w_conventional -->"}) {
        EXPECT_NE(svg.find(piece), std::string::npos) << piece;
    }
    EXPECT_TRUE(svg == drawn("again.svg"));
}

TEST(SilCli, PythonWithoutMatplotlibIsOneLineBeforeAnythingRuns)
{
    if (!draws_plots()) {
        GTEST_SKIP() << "built without a Python that has matplotlib";
    }
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    const std::string kept     = dir.write("kept.csv", "earlier");
    const std::string bare     = dir.write("bare", "#!/bin/sh\nexit 1\n");
    std::filesystem::permissions(bare, std::filesystem::perms::owner_all);

    for (const std::string &python : {bare, (dir / "none").string()}) {
        setenv("SDRE_PYTHON", python.c_str(), 1);
        for (const char *command : {"run", "compare"}) {
            expect_refused({command, scenario, "--csv", kept, "--plot", dir / "p.png"}, 1,
                           {python, "no matplotlib", "install", "SDRE_PYTHON"});
        }
    }
    unsetenv("SDRE_PYTHON");

    EXPECT_TRUE(support::read_file(kept) == "earlier");
    EXPECT_EQ(support::names_in(dir.path()),
              (std::set<std::string>{"bare", "case.toml", "kept.csv"}));
}

TEST(SilCli, PlotThatCannotBeWrittenIsOneLine)
{
    if (!draws_plots()) {
        GTEST_SKIP() << "built without a Python that has matplotlib";
    }
    const TempDir     dir;
    const std::string scenario = dir.write("case.toml", scenario_text());
    std::filesystem::create_directory(dir / "taken.png");

    expect_refused({"run", scenario, "--plot", dir / "none/p.png"}, 1, {"p.png"});
    expect_refused({"run", scenario, "--plot", dir / "taken.png"}, 1, {"taken.png"});
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"case.toml", "taken.png"}));
}

TEST(SilCli, CsvInPiecesIsTheSame)
{
    sdre::Trace trace(10001); // two pieces and a part of a third
    for (std::size_t k = 0; k < trace.size(); k++) {
        trace[k].time_s = 2e-4 * static_cast<double>(k);
    }
    const TempDir dir;
    sdre::write_files({sdre::trace_file(dir / "t.csv", trace)});
    EXPECT_TRUE(sdre::read_text_file(dir / "t.csv") == sdre::trace_csv(trace));
    trace.clear();
    sdre::write_files({sdre::trace_file(dir / "t.csv", trace)});
    EXPECT_EQ(sdre::read_text_file(dir / "t.csv"), sdre::trace_csv(trace));
}

TEST(SilCli, TraceOfALongRunNeedsNoMemoryOfItsOwn)
{
    const std::size_t rows  = 4 * sdre::large_memory_B / sizeof(sdre::TraceRow);
    const pid_t       child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        sdre::Trace  trace(1);   // of one row: private
        const rlimit none{0, 0}; // private memory: no more than there is
        setrlimit(RLIMIT_DATA, &none);
        trace.reserve(rows);
        for (std::size_t k = 1; k < rows; k++) {
            trace.emplace_back().time_s = static_cast<double>(k);
        }
        bool same = true;
        for (std::size_t k = 0; k < rows; k++) {
            same = same && trace[k].time_s == static_cast<double>(k);
        }
        _exit(same ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(SilCli, DiskWithoutRoomForALongRunIsOneLine)
{
    const TempDir     dir;
    const std::string scenario = dir.write(
        "case.toml", replaced(scenario_text(), "duration_s = 0.02", "duration_s = 400.0"));
    const auto r = support::run_command(
        {"/usr/bin/env", "TMPDIR=" + (dir / "none").string(), SDRE_SIL_EXE, "run", scenario});
    support::expect_refused(r, 1, tool, {"none", "no room for", "TMPDIR", "No such file"});
}
