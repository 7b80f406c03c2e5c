// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "sil/eval/compare.hpp"
#include "sil/eval/equal_noise.hpp"
#include "temp_dir.hpp"

namespace {

using namespace sdre;
using support::TempDir;

const std::string drives = std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/";
const std::string noc    = drives + "ipmsm_390w_counts.toml";
const std::string pi_foc = drives + "ipmsm_390w_pi_foc.toml";
const std::string ladrc  = drives + "ipmsm_390w_ladrc.toml";

/// Constant speed and load on the board, a perfect disc.
std::string short_text()
{
    return "drive = \"" + noc +
           "\"\nduration_s = 0.1\nseed = 1\ninitial_speed_e_radps = 300.0\n"
           "[sensors]\nideal = false\nencoder_quadrature_error_cnt = 0.0\n"
           "encoder_duty_error_cnt = 0.0\nencoder_jitter_rms_cnt = 0.0\n"
           "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = 300.0\n"
           "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = 0.75\n"
           "[[measure]]\nname = \"hold\"\ntime_s = 0.05\nband_e_radps = 2.0\n";
}

support::CommandResult compare_on(const std::string &file, std::vector<std::string> more)
{
    std::vector<std::string> arguments{SDRE_SIL_EXE, "compare", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return support::run_command(std::move(arguments));
}

} // namespace

TEST(EqualNoise, EveryLawHasOneKnob)
{
    Drive       d     = with_bandwidth(read_drive_file(noc), 4.0);
    const Drive plain = read_drive_file(noc);
    EXPECT_DOUBLE_EQ(d.nodo.T[2], plain.nodo.T[2] / 4.0);
    EXPECT_DOUBLE_EQ(d.nodo.T[0], plain.nodo.T[0] / 4.0);
    EXPECT_EQ(d.nodo.Q, plain.nodo.Q);
    d = with_bandwidth(read_drive_file(pi_foc), 0.5);
    EXPECT_DOUBLE_EQ(d.cascade.symmetrical_optimum_a, 4.26);
    EXPECT_DOUBLE_EQ(with_bandwidth(d, 1e3).cascade.symmetrical_optimum_a, 1.05);
    d = with_bandwidth(read_drive_file(ladrc), 0.5);
    EXPECT_DOUBLE_EQ(d.cascade.controller_radps, 276.0);
    EXPECT_DOUBLE_EQ(d.cascade.observer_radps, 355.0);
    EXPECT_THROW(with_bandwidth(read_drive_file(drives + "servo_200w_pid.toml"), 1.0), InputError);
}

TEST(EqualNoise, FactorMakesTheNoiseAndSlowerIsLess)
{
    const TempDir     dir;
    const std::string file = dir.write("hold.toml", short_text());
    for (const std::string &drive : {ladrc}) { // pi_foc is in the next test
        Scenario     s     = read_scenario_file(file, drive);
        const double as_is = *noise_V(s, 1);
        const double want  = 0.7 * as_is;
        const auto   match = match_noise(s, want, 1);
        EXPECT_TRUE(match.reached) << drive;
        EXPECT_LT(match.factor, 1.0) << drive;
        s.drive = with_bandwidth(s.drive, match.factor);
        EXPECT_NEAR(*noise_V(s, 1), want, noise_tolerance * want) << drive;
    }
}

TEST(EqualNoise, TableIsThatOfTheFirstDrivesNoise)
{
    const TempDir        dir;
    const std::string    file = dir.write("hold.toml", short_text());
    const CompareRequest request{{file}, {pi_foc, noc}, {}, {"vq_noise_V"}, 1, true, {}};
    const Comparison     c = compare(request);
    ASSERT_EQ(c.runs.size(), 2U);
    EXPECT_TRUE(c.missed.empty());
    const double wanted = *noise_V(read_scenario_file(file, pi_foc), 1);
    EXPECT_DOUBLE_EQ(*c.runs[0].cells.at("hold").at("vq_noise_V").value, wanted);
    EXPECT_EQ(c.columns[0], "ipmsm_390w_pi_foc, symmetrical_optimum_a = 2.13");
    for (const CompareRun &run : c.runs) {
        EXPECT_NEAR(*run.cells.at("hold").at("vq_noise_V").value, wanted, noise_tolerance * wanted)
            << run.column;
    }
}

TEST(EqualNoise, WhatCannotBeReachedIsOneLine)
{
    const TempDir     dir;
    const std::string file = dir.write("hold.toml", short_text());
    const auto        r = compare_on(file, {"--drive", pi_foc, "--equal-noise", "--noise", "5000"});
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_NE(
        r.out.find("ipmsm_390w_pi_foc: 5e+03 V of noise in v_q cannot be reached; nearest is "),
        std::string::npos)
        << r.out;
    EXPECT_NE(r.out.find("| v_q noise [V rms] |"), std::string::npos) << r.out;
}

TEST(EqualNoise, WrongRequestsAreOneLine)
{
    const TempDir     dir;
    const std::string file = dir.write("hold.toml", short_text());
    support::expect_refused(compare_on(file, {"--noise", "30"}), 1, "sdre-sil", {"--equal-noise"});
    support::expect_refused(
        compare_on(file, {"--equal-noise", "--drive", drives + "ipmsm_390w_conventional.toml"}), 1,
        "sdre-sil", {"conventional_noc", "no bandwidth"});
}
