// SPDX-License-Identifier: MIT
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "common/file_output.hpp"
#include "drive/drive_file.hpp"
#include "drive_text.hpp"
#include "examples.hpp"
#include "json.hpp"
#include "temp_dir.hpp"

namespace {

using support::CommandResult;
using support::DriveText;
using support::TempDir;

const std::string tool = "sdre-gains";
const std::string shipped =
    std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/ipmsm_390w.toml";
const std::string second_board =
    std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/m2310p_24v.toml";
const std::string tables = std::string(SDRE_SOURCE_DIR) + "/firmware/config";
/// Designed in milliseconds, the shipped one in seconds: for tests of files.
const std::string quick =
    std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/servo_200w_pid.toml";

CommandResult gains(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), SDRE_GAINS_EXE);
    return support::run_command(std::move(arguments));
}

void expect_refused(const std::vector<std::string> &arguments, int exit_code,
                    const std::vector<std::string> &pieces)
{
    std::string all;
    for (const std::string &argument : arguments) {
        all += " " + argument;
    }
    SCOPED_TRACE("sdre-gains" + all);
    support::expect_refused(gains(arguments), exit_code, tool, pieces);
}

/// Tables are made for a board only.
DriveText on_board()
{
    return DriveText().add_section("board").set("board", "name", "\"board_390w\"");
}

/// A drive that solves but must not be written: the observer is too quick for the control period.
DriveText uncertified()
{
    return on_board().set("nodo", "Q", "[1.0e14, 1.1e14, 1.2e14, 85.0e6, 86.0e6, 90.0e6]");
}

} // namespace

TEST(GainsCli, WrongCommandLineIsOneLine)
{
    expect_refused({}, 1, {"subcommand"});
    expect_refused({"frobnicate"}, 1,
                   {"frobnicate", "no such subcommand", "generate, image, report, describe"});
    expect_refused({"--frobnicate"}, 1, {"--frobnicate", "no such option"});
    expect_refused({"reprot", shipped}, 1, {"reprot", "report"});
    expect_refused({"report", "--jsno"}, 1, {"--jsno"}); // though DRIVE is missing too
    expect_refused({"report", "--jsno", shipped}, 1, {"--jsno", "sdre-gains report --help"});
    expect_refused({"report"}, 1, {"DRIVE"});
    expect_refused({"generate"}, 1, {"DRIVE"});
    expect_refused({"care"}, 1, {"PROBLEM"});
    expect_refused({"report", shipped, "extra"}, 1, {"extra"});
    expect_refused({"report", "--colour", shipped}, 1, {"--colour"});
    expect_refused({"generate", shipped, "--out"}, 1, {"--out"});
    expect_refused({"report", shipped, "care", "x.json"}, 1, {});
}

TEST(GainsCli, GenerateNeedsExactlyOneTarget)
{
    const TempDir dir;

    expect_refused({"generate", shipped}, 1, {"--out DIR", "--check DIR"});
    expect_refused({"generate", shipped, "--out", dir.path(), "--check", tables}, 1,
                   {"--out DIR", "--check DIR"});
    EXPECT_TRUE(support::names_in(dir.path()).empty());
}

TEST(GainsCli, HelpAndVersionAreNoErrors)
{
    for (const std::vector<std::string> &arguments : {std::vector<std::string>{"--help"},
                                                      {"report", "--help"},
                                                      {"generate", "-h"},
                                                      {"care", "--help"}}) {
        const CommandResult r = gains(arguments);
        EXPECT_EQ(r.exit_code, 0);
        EXPECT_EQ(r.err, "");
        EXPECT_NE(r.out.find("--help"), std::string::npos);
    }
    EXPECT_EQ(gains({"--version"}).out, "sdre-gains 1.0.0\n");
    EXPECT_EQ(gains({"--version"}).exit_code, 0);
}

TEST(GainsCli, BadDriveFileIsBadInputForEveryCommand)
{
    const TempDir     dir;
    const std::string out  = dir / "out";
    const std::string file = dir.write("bad.toml", "[motor\n");
    for (const std::string &drive : {(dir / "none.toml").string(), dir.path().string(), file}) {
        expect_refused({"report", drive}, 1, {drive + ":"});
        expect_refused({"report", drive, "--json"}, 1, {drive + ":"});
        expect_refused({"generate", drive, "--out", out}, 1, {drive + ":"});
        expect_refused({"generate", drive, "--check", tables}, 1, {drive + ":"});
    }
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(GainsCli, BadKeyIsBadInput)
{
    const TempDir dir;
    const auto    refused = [&](DriveText text, const std::vector<std::string> &pieces) {
        const std::string        file = dir.write("drive.toml", text.str());
        std::vector<std::string> all  = pieces;
        all.push_back(file + ": ");
        expect_refused({"report", file, "--json"}, 1, all);
    };

    refused(DriveText().erase("motor", "pm_flux_Wb"), {"[motor] pm_flux_Wb is missing"});
    refused(DriveText().set("motor", "colour", "1"), {"[motor] colour", "inertia_kgm2"});
    refused(DriveText().set("motor", "inertia_kgm2", "-1.0"), {"inertia_kgm2 = -1", "1000"});
    refused(DriveText().set("motor", "inertia_kgm2", "nan"), {"inertia_kgm2 = nan", "1000"});
    refused(DriveText().set("motor", "inertia_kgm2", "\"1\""),
            {"inertia_kgm2 = ", "must be a number"});
    refused(DriveText().set("motor", "d_axis_inductance_H", "0.2"), {"Ld <= Lq"});
    refused(DriveText().set("nosc", "Q", "[1e300, 1.0, 1.0]"), {"Q[0] = 1e+300", "1e+15"});
    refused(DriveText().set("nodo", "T", "[1e300, 1.0, 1.0]"), {"T[0] = 1e+300", "1e+12"});
    refused(DriveText().set("", "schema", "2"), {"schema = 2"});
    refused(DriveText().erase_section("nodo"), {"nodo is missing"});
}

TEST(GainsCli, GenerateWritesTablesThatCheck)
{
    const TempDir     dir;
    const std::string out = dir / "a/b";

    const CommandResult made    = gains({"generate", quick, "--out", out});
    const CommandResult checked = gains({"generate", quick, "--check", out});

    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(made.err, "");
    EXPECT_EQ(
        made.out,
        "servo_200w_pid: certified; wrote gain_tables.h, gain_tables.c and board_config.c to " +
            out + "\n");
    EXPECT_EQ(support::names_in(out),
              (std::set<std::string>{"board_config.c", "gain_tables.c", "gain_tables.h"}));
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    EXPECT_EQ(checked.out, "servo_200w_pid: certified; " + out + " matches\n");
}

TEST(GainsCli, GenerateTwiceGivesTheSameBytes)
{
    const TempDir     dir;
    const std::string first  = dir / "first";
    const std::string second = dir / "second";

    gains({"generate", shipped, "--out", first});
    gains({"generate", quick, "--out", second});
    gains({"generate", shipped, "--out", second});

    for (const std::string name : {"/gain_tables.h", "/gain_tables.c", "/board_config.c"}) {
        EXPECT_EQ(support::read_file(first + name), support::read_file(second + name));
    }
}

TEST(GainsCli, CommittedTablesCheck)
{
    const CommandResult r = gains({"generate", shipped, "--check", tables});

    EXPECT_EQ(r.exit_code, 0) << r.err;
}

TEST(GainsCli, CommittedTablesOfTheSecondBoardCheck)
{
    const CommandResult r = gains({"generate", second_board, "--check", tables + "/stm32g431"});

    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.out, "cycles of a control period: nothing checked, none are recorded for "
                     "stm32g431; it has 8500\nm2310p_24v: certified; " +
                         tables + "/stm32g431 matches\n");
    EXPECT_EQ(gains({"generate", second_board, "--check", tables}).exit_code, 3);
}

// Octets, and 64 bits at once: not the words of an F28335.
TEST(GainsCli, HexIsForTheStoreOfItsProcessor)
{
    const TempDir dir;
    expect_refused({"image", second_board, "--hex", dir / "image.hex"}, 1,
                   {"--hex", "stm32g431", "sdre-drive load"});
    EXPECT_EQ(gains({"image", second_board, "--out", dir / "image"}).exit_code, 0);
}

TEST(GainsCli, CheckMismatchIsExitThree)
{
    const TempDir dir;
    ASSERT_EQ(gains({"generate", quick, "--out", dir.path()}).exit_code, 0);
    const std::string header = support::read_file(dir / "gain_tables.h");
    const std::string source = support::read_file(dir / "gain_tables.c");

    dir.write("gain_tables.c", support::replaced(source, ".l1 = 1.49333330e+04f",
                                                 ".l1 = 1.49333345e+04f")); // 1e-7
    EXPECT_EQ(gains({"generate", quick, "--check", dir.path()}).exit_code, 0);
    dir.write("gain_tables.c",
              support::replaced(source, ".l1 = 1.49333330e+04f", ".l1 = 1.49334413e+04f"));
    expect_refused({"generate", quick, "--check", dir.path()}, 3,
                   {"gain_tables.c", "1.49334413e+04f", "1.49333330e+04f"});
    dir.write("gain_tables.c", source);
    dir.write("gain_tables.h",
              support::replaced(header, "DIGEST \"fnv1a64:", "DIGEST \"fnv1a64:5b"));
    expect_refused({"generate", quick, "--check", dir.path()}, 3, {"gain_tables.h", "fnv1a64:5b"});
}

TEST(GainsCli, CheckOfAnotherDriveIsExitThree)
{
    expect_refused({"generate",
                    std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/ipmsm_390w_paper.toml",
                    "--uncertified", "--check", tables},
                   3, {"gain_tables.h"});
}

TEST(GainsCli, CheckWithoutFilesIsBadInput)
{
    const TempDir dir;
    expect_refused({"generate", quick, "--check", dir.path()}, 1, {"gain_tables.h"});
    expect_refused({"generate", quick, "--check", dir / "none"}, 1, {"gain_tables.h"});

    ASSERT_EQ(gains({"generate", quick, "--out", dir.path()}).exit_code, 0);
    std::filesystem::remove(dir / "gain_tables.c");
    expect_refused({"generate", quick, "--check", dir.path()}, 1, {"gain_tables.c"});
}

TEST(GainsCli, OutputThatCannotBeMadeIsBadInput)
{
    const TempDir     dir;
    const std::string file = dir.write("file", "kept");

    expect_refused({"generate", quick, "--out", file}, 1, {file});
    expect_refused({"generate", quick, "--out", file + "/sub"}, 1, {file});
    expect_refused({"generate", quick, "--out", "/proc/sdre"}, 1, {"/proc/sdre"});
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"file"}));
    EXPECT_EQ(support::read_file(file), "kept");
}

TEST(GainsCli, StandardOutputThatIsFullIsBadInput)
{
    // the report of the shipped drive is longer than a buffer, that of a servo is not
    for (const auto &[argument, drive] :
         {std::pair<std::string, std::string>{"--help", shipped},
          {"report", shipped},
          {"report", SDRE_SOURCE_DIR "/firmware/config/drives/servo_200w_pid.toml"}}) {
        const CommandResult r = support::run_command(
            {"/bin/sh", "-c", "\"$@\" > /dev/full", "sh", SDRE_GAINS_EXE, argument, drive});
        EXPECT_EQ(r.exit_code, 1) << argument;
        EXPECT_NE(r.err.find("standard output: cannot write: No space left"), std::string::npos);
    }
}

TEST(GainsCli, TwoAtOnceDoNotDisturbEachOther)
{
    const TempDir       dir;
    const std::string   out = dir / "out";
    const CommandResult r   = support::run_command(
          {"/bin/sh", "-c",
           "for i in 1 2 3 4; do \"$@\" & p=\"$p $!\"; done; for i in $p; do wait $i || exit 9; done",
           "sh", SDRE_GAINS_EXE, "generate", quick, "--out", out});

    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(gains({"generate", quick, "--check", out}).exit_code, 0);
    EXPECT_EQ(support::names_in(out),
              (std::set<std::string>{"board_config.c", "gain_tables.c", "gain_tables.h"}));
}

TEST(GainsCli, RefusedDesignLeavesEarlierOutput)
{
    const TempDir     dir;
    const std::string header = dir.write("gain_tables.h", "earlier header");
    const std::string source = dir.write("gain_tables.c", "earlier source");
    const TempDir     input;
    const std::string drive = input.write("drive.toml", uncertified().str());

    expect_refused({"generate", drive, "--out", dir.path()}, 2, {drive, "not certified", "nodo"});
    expect_refused({"generate", drive, "--check", dir.path()}, 2, {"not certified"});
    expect_refused({"generate", drive, "--out", dir / "new"}, 2, {"not certified"});

    EXPECT_EQ(support::read_file(header), "earlier header");
    EXPECT_EQ(support::read_file(source), "earlier source");
    EXPECT_EQ(support::names_in(dir.path()),
              (std::set<std::string>{"gain_tables.c", "gain_tables.h"}));
}

TEST(GainsCli, UnsolvableDesignIsExitTwo)
{
    const TempDir     dir;
    const std::string drive = dir.write(
        "drive.toml", on_board().set("nodo", "Q", "[0.0, 0.0, 0.0, 85.0, 86.0, 90.0]").str());

    expect_refused({"generate", drive, "--out", dir / "out"}, 2, {});
    expect_refused({"report", drive}, 2, {});
    EXPECT_FALSE(std::filesystem::exists(dir / "out"));
}

TEST(GainsCli, ReportAnswersForAnUncertifiedDrive)
{
    const TempDir     dir;
    const std::string drive = dir.write("drive.toml", uncertified().str());

    const CommandResult text = gains({"report", drive});
    const CommandResult json = gains({"report", drive, "--json"});

    EXPECT_EQ(text.exit_code, 2);
    EXPECT_EQ(text.err, "");
    EXPECT_NE(text.out.find("verdict: not certified"), std::string::npos);
    EXPECT_EQ(json.exit_code, 2);
    EXPECT_EQ(support::Json::parse(json.out).at("certificate").at("certified"), false);
}

TEST(GainsCli, ReportOfTheShippedDriveIsCertified)
{
    const CommandResult text = gains({"report", shipped});
    const CommandResult json = gains({"report", "--json", shipped});

    EXPECT_EQ(text.exit_code, 0);
    EXPECT_NE(text.out.find("verdict: certified"), std::string::npos);
    EXPECT_EQ(json.exit_code, 0);
    EXPECT_EQ(json.err, "");
    EXPECT_EQ(support::Json::parse(json.out).at("certificate").at("certified"), true);
}

namespace {

/// The board of the 390 W motor with other ratings.
std::string board_for_560_V()
{
    std::string text =
        support::read_file(SDRE_SOURCE_DIR "/firmware/config/boards/board_390w.toml");
    for (const auto &[from, to] : std::vector<std::pair<std::string, std::string>>{
             {"\"board_390w\"", "\"spm\""},
             {"= 3e-6", "= 1.5e-6"},
             {"= 10.0 ", "= 40.0 "},
             {"rated_current_A          = 5.0", "rated_current_A = 15.0"},
             {"trip_current_A           = 9.0", "trip_current_A = 30.0"},
             {"dc_link_range_V          = 450.0", "dc_link_range_V = 900.0"},
             {"rated_dc_link_V          = 450.0", "rated_dc_link_V = 800.0"}}) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    }
    return text;
}

} // namespace

// A drive without board is for simulations: it is designed and reported, and no image is made.
TEST(GainsCli, TablesAndImagesNeedABoard)
{
    const TempDir     dir;
    const std::string drive = dir.write("drive.toml", DriveText().str());
    EXPECT_EQ(gains({"report", drive}).exit_code, 2); // for its verdict, not for its board
    for (const std::vector<std::string> &arguments :
         {std::vector<std::string>{"generate", drive, "--out", dir / "out"},
          {"image", drive, "--out", dir / "image"},
          {"image", drive, "--hex", dir / "image.hex"}}) {
        expect_refused(arguments, 1,
                       {drive + ": [board] name is missing", "board_200w, board_390w"});
    }
    EXPECT_EQ(support::names_in(dir.path()), std::set<std::string>{"drive.toml"});
}

TEST(GainsCli, NewWritesTheBoardAndItsDeadTime)
{
    const TempDir     dir;
    const std::string drive = dir / "d.toml";
    const std::string facts = SDRE_TEST_DATA_DIR "/facts/spm_1500w.toml";
    dir.write("spm.toml", board_for_560_V());
    std::string text = support::read_file(facts);
    text.replace(text.find("dead_time_ns = 1500\n"), 20, "board = \"spm\"\n");
    const std::string own = dir.write("facts.toml", text);
    ASSERT_EQ(gains({"new", "--facts", own, "--out", drive}).exit_code, 0);
    EXPECT_NE(support::read_file(drive).find("[board]\nname = \"spm\"\n"), std::string::npos);
    EXPECT_NE(support::read_file(drive).find("1.5e-06      # chosen: least of the board"),
              std::string::npos);
    EXPECT_EQ(sdre::read_drive_file(drive).current_sensors.range_A, 40.0);
    expect_refused({"new", "--facts", facts, "--board", "nix", "--out", drive}, 1,
                   {"board = \"nix\"", "board_200w, board_390w"});
    expect_refused({"new", "--facts", facts, "--board", "board_390w", "--out", dir / "x"}, 1,
                   {"dead_time_s = 1.5e-06", "board_390w"});
}

TEST(GainsCli, NewWritesPositionsOrSaysWhyNot)
{
    const TempDir dir;
    const auto    made = [&dir](const std::string &name, const std::string &why) {
        const std::string out = dir / (name + ".toml");
        const auto        r =
            gains({"new", "--facts", std::string(SDRE_TEST_DATA_DIR "/facts/") + name + ".toml",
                   "--out", out});
        EXPECT_EQ(r.exit_code, 0) << r.err;
        const bool takes = sdre::read_drive_file(out).position.has_value();
        EXPECT_EQ(takes, r.err.find("note: no [position]") == std::string::npos) << name << r.err;
        EXPECT_NE(r.err.find(why), std::string::npos) << name << r.err;
        if (takes) {
            EXPECT_NE(gains({"report", out}).out.find("verdict: certified"), std::string::npos)
                << name;
        }
        return takes;
    };
    for (const char *name : {"servo_2k2", "servo_600w_surface", "torque_motor"}) {
        EXPECT_TRUE(made(name, "")) << name;
    }
    EXPECT_FALSE(made("pump_256", "start weights of the speed are not certified"));
    EXPECT_FALSE(made("ev_100kw", "start weights of the speed are not certified"));
    EXPECT_FALSE(made("outrunner_24v", "pwm_frequency_Hz = 20000 is not allowed"));
}

TEST(GainsCli, NewLeavesTorquesOutThatTheFrequencyHasNoTimeFor)
{
    const TempDir dir;
    std::string   sheet = sdre::read_text_file(SDRE_TEST_DATA_DIR "/facts/outrunner_24v.toml");
    sheet.replace(sheet.find("pwm_kHz = 20"), 12, "pwm_kHz = 23.5");
    const std::string out = dir / "drive.toml";
    const auto        r   = gains({"new", "--facts", dir.write("sheet.toml", sheet), "--out", out});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(r.err.find("note: no [torque]"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("\"noc\" with [torque] needs"), std::string::npos) << r.err;
    EXPECT_FALSE(sdre::read_drive_file(out).torque.has_value()); // and it can be read
}

TEST(GainsCli, TuneAddsThePositionsThatNewLeftOut)
{
    const TempDir     dir;
    const std::string out = dir / "d.toml";
    ASSERT_EQ(gains({"new", "--facts", SDRE_TEST_DATA_DIR "/facts/syrm_6k7.toml", "--out", out})
                  .exit_code,
              0);
    ASSERT_FALSE(sdre::read_drive_file(out).position);
    const std::vector<std::string> tune{"tune", out, "--no-qualify"};
    ASSERT_EQ(gains(tune).exit_code, 0);
    const sdre::Drive tuned = sdre::read_drive_file(out);
    ASSERT_TRUE(tuned.position);
    EXPECT_EQ(tuned.position->Q[1], tuned.nosc.Q[0]);
    EXPECT_EQ(tuned.position->T, tuned.nosc.T);
    EXPECT_NE(gains({"report", out}).out.find("verdict: certified"), std::string::npos);
    ASSERT_EQ(gains(tune).exit_code, 0); // they stay, once
    const std::string again = support::read_file(out);
    EXPECT_NE(again.find("[position]"), std::string::npos);
    EXPECT_EQ(again.find("[position]"), again.rfind("[position]"));
}

TEST(GainsCli, TuneAddsNoPositionsToADriveThatWasCertifiedWithout)
{
    const TempDir     dir;
    const std::string made = dir / "made.toml";
    ASSERT_EQ(
        gains({"new", "--facts", SDRE_TEST_DATA_DIR "/facts/torque_motor.toml", "--out", made})
            .exit_code,
        0);
    const std::string text = support::read_file(made);
    const std::string out  = dir.write("d.toml", text.substr(0, text.find("[position]")));
    ASSERT_FALSE(sdre::read_drive_file(out).position);
    const auto r = gains({"tune", out, "--no-qualify"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.err.find("[position]"), std::string::npos) << r.err;
    EXPECT_FALSE(sdre::read_drive_file(out).position);
}

TEST(GainsCli, EveryCommandHasAnExample)
{
    EXPECT_EQ(support::commands_of(SDRE_GAINS_EXE).size(), 9U);
    support::expect_examples(SDRE_GAINS_EXE, tool);
}

TEST(GainsCli, WhatIsToldToBeCopiedIsQuoted)
{
    const TempDir     dir;
    const std::string sheet = SDRE_TEST_DATA_DIR "/facts/outrunner_24v.toml";
    const std::string drive = dir / "it's a motor.toml";
    const auto        r     = gains({"new", "--facts", sheet, "--out", drive});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    const std::size_t from = r.out.find("tune ") + 5;
    const std::string word = r.out.substr(from, r.out.find(" --out TUNED") - from);
    EXPECT_EQ(support::run_command({"/bin/sh", "-c", "printf %s " + word}).out, drive);
    const std::string plain = dir / "motor.toml";
    const auto        same  = gains({"new", "--facts", sheet, "--out", plain});
    EXPECT_NE(same.out.find("tune " + plain + " --out"), std::string::npos) << same.out;
}

TEST(GainsCli, FrequencyThatTheCounterHasNotGoesThroughEveryCommand)
{
    const std::string both = "7999.147 Hz, the nearest to 8000 Hz that the counter has";
    const TempDir     dir;
    const std::string drive = dir / "d.toml";
    const std::string out   = dir / "out";
    const auto        says  = [&](const std::vector<std::string> &arguments) {
        const CommandResult r = gains(arguments);
        EXPECT_EQ(r.exit_code, 0) << arguments[0] << r.err;
        EXPECT_NE(r.out.find(both), std::string::npos) << arguments[0] << r.out;
    };
    dir.write("spm.toml", board_for_560_V());
    says({"new", "--facts", SDRE_TEST_DATA_DIR "/facts/spm_1500w.toml", "--board", "spm", "--out",
          drive});
    EXPECT_NE(support::read_file(drive).find("8000.0       # pwm_frequency_kHz = 8; the counter's "
                                             "nearest is 7999.147"),
              std::string::npos);
    says({"tune", drive, "--no-qualify"});
    says({"tune", drive, "--no-qualify"}); // says it once in the file
    const std::string tuned = support::read_file(drive);
    EXPECT_NE(tuned.find("# for PWM at " + both), std::string::npos);
    EXPECT_EQ(tuned.find("# for PWM at"), tuned.rfind("# for PWM at"));
    says({"generate", drive, "--out", out});
    says({"generate", drive, "--check", out});
    says({"report", drive});
    says({"image", drive, "--out", dir / "image"});
    EXPECT_EQ(gains({"describe", drive, "--out", dir / "d.md"}).exit_code, 0);
    EXPECT_NE(support::read_file(dir / "d.md").find("| PWM | " + both), std::string::npos);
    const support::Json json = support::Json::parse(gains({"report", drive, "--json"}).out);
    EXPECT_EQ(json.at("pwm_wanted_Hz").number(), 8000.0);
    EXPECT_NEAR(json.at("pwm_frequency_Hz").number(), 75e6 / (2 * 4688), 1e-9);
    EXPECT_NEAR(json.at("control_period_s").number(), 2 * 4688 / 75e6, 1e-18);
}

TEST(GainsCli, CareSolvesAFile)
{
    const TempDir     dir; // x' = u, q = 4, r = 1: X = 2, pole at -2
    const std::string file =
        dir.write("p.json", R"({"A": [[0]], "B": [[1]], "R": [[1]], "Q": [[4]], "more": "x"})");

    const CommandResult json = gains({"care", file, "--json"});
    const CommandResult text = gains({"care", file});

    ASSERT_EQ(json.exit_code, 0) << json.err;
    const support::Json result = support::Json::parse(json.out);
    EXPECT_NEAR(result.at("X")[0][0].number(), 2.0, 1e-15);
    EXPECT_NEAR(result.at("closed_loop_eigenvalues")[0][0].number(), -2.0, 1e-15);
    EXPECT_LT(result.at("relative_residual").number(), 1e-15);
    EXPECT_EQ(text.exit_code, 0);
    EXPECT_NE(text.out.find("X ="), std::string::npos);
    EXPECT_NE(text.out.find("residual"), std::string::npos);
}

TEST(GainsCli, CareRefusesBrokenFiles)
{
    const TempDir dir;
    const auto file = [&](const std::string &text) { return dir.write("p.json", text).string(); };

    expect_refused({"care", dir / "none.json"}, 1, {"none.json"});
    expect_refused({"care", dir.path()}, 1, {dir.path().string()});
    expect_refused({"care", file("{")}, 1, {"p.json", "JSON"});
    expect_refused({"care", file("")}, 1, {"p.json", "JSON"});
    expect_refused({"care", file("[1]")}, 1, {"p.json", "object"});
    expect_refused({"care", file(R"({"A": [[0]], "B": [[1]], "R": [[1]]})"), "--json"}, 1, {"'Q'"});
    expect_refused({"care", file(R"({"A": [[0, 1]], "B": [[1]], "R": [[1]], "Q": [[1]]})")}, 1,
                   {"'A'"});
    expect_refused({"care", file(R"({"A": [["x"]], "B": [[1]], "R": [[1]], "Q": [[1]]})")}, 1,
                   {"'A'", "row 1, column 1"});
    expect_refused({"care", file(R"({"A": [[1]], "B": [[0]], "R": [[1]], "Q": [[1]]})")}, 2,
                   {"stabilis"});
    expect_refused({"care", file(R"({"A": [[1]], "B": [[1]], "R": [[-1]], "Q": [[1]]})")}, 2,
                   {"R"});
    expect_refused({"care", file(R"({"A": [[0]], "B": [[1]], "R": [[1]], "Q": [[0]]})")}, 2, {});
}

TEST(GainsCli, CareWithHugeNumbersAnswersOrRefusesInOneLine)
{
    const TempDir dir;
    for (const std::string text :
         {R"({"A": [[0]], "B": [[1]], "R": [[1]], "Q": [[1e300]]})",
          R"({"A": [[0]], "B": [[1e300]], "R": [[1]], "Q": [[1]]})",
          R"({"A": [[1e300]], "B": [[1]], "R": [[1e-300]], "Q": [[1e300]]})",
          R"({"A": [[0]], "B": [[1]], "R": [[1]], "Q": [[1e999]]})"}) {
        const CommandResult r = gains({"care", dir.write("p.json", text), "--json"});
        if (r.exit_code == 0) {
            EXPECT_FALSE(support::Json::parse(r.out).at("X")[0][0].is_null()) << text;
        } else {
            EXPECT_TRUE(r.exit_code == 1 || r.exit_code == 2) << text << r.err;
            support::expect_refused(r, r.exit_code, tool);
        }
    }
}

TEST(GainsCli, UncertifiedTablesAreWrittenOnDemandAndSaySo)
{
    const TempDir     dir;
    const std::string out = dir / "out";
    const std::string printed =
        std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/servo_200w_cdobc_printed.toml";

    expect_refused({"generate", printed, "--out", out}, 2,
                   {"not certified", "sensitivity peak 122"});
    EXPECT_FALSE(std::filesystem::exists(out + "/gain_tables.h"));

    const CommandResult r = gains({"generate", printed, "--uncertified", "--out", out});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(r.out.find("not certified, faithful to paper B, CDOBC"), std::string::npos);
    EXPECT_NE(
        support::read_file(out + "/gain_tables.h").find("NOT CERTIFIED: speed loop: sensitivity"),
        std::string::npos);
    EXPECT_EQ(gains({"generate", printed, "--uncertified", "--check", out}).exit_code, 0);
}

TEST(GainsCli, CertifiedServoTablesCompileTheSameWithAndWithoutTheOption)
{
    const TempDir     dir;
    const std::string drive =
        std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/servo_200w_cdobc.toml";

    ASSERT_EQ(gains({"generate", drive, "--out", dir / "a"}).exit_code, 0);
    ASSERT_EQ(gains({"generate", drive, "--uncertified", "--out", dir / "b"}).exit_code, 0);
    const std::string header = support::read_file(dir / "a/gain_tables.h");
    EXPECT_EQ(header, support::read_file(dir / "b/gain_tables.h"));
    EXPECT_EQ(header.find("NOT CERTIFIED"), std::string::npos);
}

TEST(GainsCli, OnlyPaperAsLawIsTuned)
{
    const std::string root = SDRE_SOURCE_DIR;
    const TempDir     dir;

    expect_refused({"tune", root + "/firmware/config/drives/servo_200w_pid.toml", "--spec",
                    root + "/firmware/config/specs/ipmsm_390w.toml", "--out", dir / "t.toml"},
                   1, {"\"pid\"", "no weights"});
}
