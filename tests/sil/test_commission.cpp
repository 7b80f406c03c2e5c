// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command.hpp"
#include "facts/commissioned_text.hpp"
#include "shipped_drive.hpp"
#include "sil/commission/bench.hpp"
#include "sil/commission/board_bench.hpp"
#include "sil/commission/report.hpp"
#include "temp_dir.hpp"

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "common/parallel.hpp"

using namespace sdre;

namespace {

using support::TempDir;

/// The drive file that `sdre-gains new` makes of a data sheet; viscous friction of 2 % of the rated torque at the rated speed.
Drive drive_of_facts(const std::string &name)
{
    const TempDir     dir;
    const std::string file = dir / "new.toml";
    const auto        made = support::run_command(
               {SDRE_GAINS_EXE, "new", "--facts",
                std::string(SDRE_TEST_DATA_DIR) + "/facts/" + name + ".toml", "--out", file});
    EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
    Drive d = read_drive_file(file);
    d.motor.viscous_friction_Nms =
        0.02 * d.motor.rated_torque_Nm * d.motor.pole_pairs / d.motor.rated_speed_e_radps;
    return d;
}

/// Required accuracy: 3 % R, 5 % L, 2 % flux, 5 % J, 20 % friction, a degree, 1.05 times the
/// current bound.
void expect_good(const Drive &d, const CommissionRun &r)
{
    const std::string text = commission_text(d, r);
    ASSERT_TRUE(r.finished()) << text;
    EXPECT_LE(r.peak_current_A, 1.05 * d.motor.max_current_A) << text;
    for (const CommissionLine &l : commission_lines(d, r)) {
        const double most = l.name == "resistance"                         ? 0.03
                            : l.name == "Ld" || l.name == "Lq"             ? 0.05
                            : l.name == "flux"                             ? 0.02
                            : l.name == "inertia"                          ? 0.05
                            : l.name.find("friction") != std::string::npos ? 0.2
                            : l.name == "offset"                           ? 1.0
                                                                           : 0.0;
        EXPECT_LE(std::abs(l.error), most) << l.name << "\n" << text;
    }
}

void run_seeds(const std::string &facts, int seeds, CommissionOptions o = {})
{
    const Drive d = drive_of_facts(facts);
    for (int seed = 1; seed <= seeds; seed++) {
        o.seed = static_cast<std::uint64_t>(seed);
        expect_good(d, commission(d, o));
    }
}

/// Healthy runs with seeds from 1 on that do not end by themselves are counted, and each is printed.
int failures(const std::string &name, const Drive &d, int seeds, double current_share)
{
    std::vector<CommissionRun> runs(static_cast<std::size_t>(seeds));
    parallel_for(runs.size(), [&](std::size_t k) {
        CommissionOptions o;
        o.seed          = k + 1;
        o.current_share = current_share;
        runs[k]         = commission(d, o);
    });
    int failed = 0;
    for (std::size_t k = 0; k < runs.size(); k++) {
        if (!runs[k].finished()) {
            fmt::print("{} seed {}: {} in {}\n", name, k + 1,
                       commission_reason_text(runs[k].reason),
                       commission_stage_name(runs[k].during));
            failed++;
        }
    }
    fmt::print("{}: {} of {} at the first try\n", name, seeds - failed, seeds);
    return failed;
}

} // namespace

/// The shipped motor with a bound of 3 A, as a user would begin.
TEST(Commission, SucceedsAtTheFirstTry)
{
    const Drive d = read_drive_file(support::shipped_drive("ipmsm_390w"));
    EXPECT_EQ(failures("ipmsm_390w", d, 3, 0.75), 0);
}

TEST(Commission, FindsAServoMotor)
{
    run_seeds("servo_2k2", 1);
}

/// Aligned by reluctance; its encoder counts down.
TEST(Commission, FindsAMotorWithoutMagnet)
{
    const Drive       d = drive_of_facts("syrm_6k7");
    CommissionOptions o;
    o.seed = 2;
    expect_good(d, commission(d, o));
}

TEST(Commission, TheFileIsADriveFileWithTheFoundValues)
{
    const TempDir     dir;
    const std::string out     = dir / "found.toml";
    const std::string shipped = support::shipped_drive("ipmsm_390w");
    const auto        r =
        support::run_command({SDRE_SIL_EXE, "commission", shipped, "--out", out, "--seed", "3"});

    ASSERT_EQ(r.exit_code, 0) << r.out << r.err;
    const Drive truth = read_drive_file(shipped);
    const Drive found = read_drive_file(out);
    EXPECT_EQ(found.motor.pole_pairs, truth.motor.pole_pairs);
    EXPECT_EQ(found.encoder.lines, truth.encoder.lines);
    EXPECT_EQ(found.motor.max_current_A, truth.motor.max_current_A);
    EXPECT_NEAR(found.motor.stator_resistance_Ohm, truth.motor.stator_resistance_Ohm,
                0.03 * truth.motor.stator_resistance_Ohm);
    EXPECT_NEAR(found.motor.inertia_kgm2, truth.motor.inertia_kgm2,
                0.05 * truth.motor.inertia_kgm2);
    EXPECT_NE(read_text_file(out).find("# +- "), std::string::npos);
    EXPECT_NE(found.motor.stator_resistance_Ohm, truth.motor.stator_resistance_Ohm);
}

/// A flywheel of half a million times the rotor: it does not follow the vector. Nothing is written.
TEST(Commission, AnAbortedRunWritesNoFile)
{
    const TempDir     dir;
    const std::string out   = dir / "found.toml";
    const std::string heavy = dir / "heavy.toml";
    std::string       text  = read_text_file(support::shipped_drive("ipmsm_390w"));
    const std::size_t at    = text.find("inertia_kgm2");
    text.replace(at, text.find('\n', at) - at, "inertia_kgm2 = 200.0");
    write_files({{heavy, text}});
    const auto r = support::run_command({SDRE_SIL_EXE, "commission", heavy, "--out", out});

    EXPECT_EQ(r.exit_code, 4) << r.out;
    EXPECT_NE(r.out.find("ABORTED"), std::string::npos) << r.out;
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Commission, AKeyThatCannotBeReplacedIsOneLine)
{
    EXPECT_THROW(commissioned_text("schema = 1\n[motor]\npole_pairs = 3\n", {}, 1.0, "here"),
                 InputError);
}

/// Started and watched as a master would: bounds, command and result go through the application.
TEST(CommissionAll, OnBothBoards)
{
    const Drive d = read_drive_file(support::shipped_drive("ipmsm_390w"));
    for (const BoardKind kind : {BoardKind::api, BoardKind::f28335}) {
        const CommissionRun r = commission_on_board(d, {}, kind);
        expect_good(d, r);
    }
}

/// At least 99.5 % of 200 seeds each.
TEST(CommissionAll, FirstTry)
{
    for (const char *name :
         {"ev_100kw", "outrunner_24v", "pump_256", "servo_2k2", "servo_600w_surface", "syrm_6k7"}) {
        EXPECT_LE(failures(name, drive_of_facts(name), 200, 1.0), 1) << name;
    }
    for (const char *name : {"ipmsm_390w", "servo_200w"}) {
        const Drive d = read_drive_file(support::shipped_drive(name));
        EXPECT_LE(failures(name, d, 200, 0.75), 1) << name;
    }
}

/// Shorter magnets than inductance: at the current of the first try the rotor stands off the vector.
TEST(CommissionAll, EvMachine)
{
    run_seeds("ev_100kw", 10);
}
TEST(CommissionAll, Servo2k2)
{
    run_seeds("servo_2k2", 10);
}
TEST(CommissionAll, SurfaceServo)
{
    run_seeds("servo_600w_surface", 10);
}
TEST(CommissionAll, Outrunner)
{
    run_seeds("outrunner_24v", 10);
}
TEST(CommissionAll, Pump)
{
    run_seeds("pump_256", 10);
}
TEST(CommissionAll, ReluctanceMotor)
{
    run_seeds("syrm_6k7", 10);
}
TEST(CommissionAll, SmallServo)
{
    run_seeds("servo_60w", 10);
}
TEST(CommissionAll, LargerSurfaceServo)
{
    run_seeds("spm_1500w", 10);
}
TEST(CommissionAll, TorqueMotor)
{
    run_seeds("torque_motor", 10);
}
TEST(CommissionAll, CoggingAndUnknownLines)
{
    CommissionOptions o;
    o.cogging_share = 0.02;
    o.lines_known   = false;
    run_seeds("servo_2k2", 3, o);
    run_seeds("servo_600w_surface", 3, o);
}
