// SPDX-License-Identifier: MIT
#include "tune/drive_text.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "design/design.hpp"
#include "shipped_drive.hpp"

namespace {

using support::read_file;
using support::replaced;
using support::TempDir;

const std::filesystem::path board_drive = support::shipped_drive("ipmsm_390w");
const std::filesystem::path board_spec =
    std::filesystem::path(SDRE_SOURCE_DIR) / "firmware/config/specs/ipmsm_390w.toml";

/// A specification of its own, so that retuning the shipped drive changes no test but one.
const std::string spec_text = R"(speed_e_radps  = 300.0
load_before_Nm = 0.75
load_step_Nm   = 0.75
band_e_radps   = 0.5
largest_pole   = 0.98
voltage_V      = 31.6
d_axis_error_A = 0.35
voltage_headroom_V = 330.0
current_noise_A = 0.010
current_lsb_A   = 0.00488
[[case]]
mechanical      = 1.0
electrical      = 1.0
dip_e_radps     = 5.0
settling_time_s = 0.012
ripple_e_radps  = 0.6
[[case]]
mechanical      = 2.0
electrical      = 1.5
dip_e_radps     = 6.0
settling_time_s = 0.016
ripple_e_radps  = 0.8
)";

sdre::TuneSpec own_spec()
{
    const TempDir dir;
    return sdre::read_tune_spec(dir.write("spec.toml", spec_text));
}

/// A result as tune_drive() would return it, without the search.
sdre::TuneResult found()
{
    sdre::TuneResult r;
    r.drive       = sdre::read_drive_file(board_drive);
    r.cases       = {{5.05, 0.0084, 0.6, 303.0, 0.929}, {4.92, 0.0088, 0.63, 333.0, 0.944}};
    r.worst_ratio = 1.01;
    r.evaluations = 17;
    return r;
}

std::string sections()
{
    return sdre::tuned_sections(found(), own_spec());
}

/// The complaint about a specification, without the file's path; one line.
std::string complaint(const std::string &text)
{
    const TempDir dir;
    const auto    file = dir.write("spec.toml", text);
    try {
        sdre::read_tune_spec(file);
    } catch (const sdre::InputError &error) {
        const std::string what = error.what();
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        EXPECT_EQ(what.rfind(file.string() + ":", 0), 0U) << what;
        return what.substr(file.string().size() + 1);
    }
    return "accepted";
}

void expect_complaint(const std::string &text, const std::vector<std::string> &pieces)
{
    const std::string what = complaint(text);
    for (const std::string &piece : pieces) {
        EXPECT_NE(what.find(piece), std::string::npos) << "'" << piece << "' not in: " << what;
    }
}

std::filesystem::path spec_of(const std::string &drive)
{
    return board_spec.parent_path() / (drive + ".toml");
}

/// `tune` leaves a shipped drive as it is. Exit code 2 says that its specification is missed.
void expect_kept(const std::string &name, int exit_code)
{
    const TempDir     dir;
    const auto        drive = support::shipped_drive(name);
    const std::string out   = (dir / "tuned.toml").string();
    const auto        result =
        support::run_command({SDRE_GAINS_EXE, "tune", drive.string(), "--spec",
                              spec_of(name).string(), "--out", out, "--no-qualify"});

    ASSERT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(read_file(out), read_file(drive));
}

/// The specification without the line that starts with `key`.
std::string without(const std::string &key)
{
    std::string       text = spec_text;
    const std::size_t at   = text.find(key);
    return text.erase(at, text.find('\n', at) + 1 - at);
}

} // namespace

TEST(Tune, ShippedSpecificationIsRead)
{
    EXPECT_GE(sdre::read_tune_spec(board_spec).cases.size(), 2U);
}

TEST(Tune, SpecificationReachesItsPlaces)
{
    const sdre::TuneSpec spec = own_spec();

    EXPECT_EQ(spec.speed_e_radps, 300.0);
    EXPECT_EQ(spec.load_before_Nm, 0.75);
    EXPECT_EQ(spec.load_step_Nm, 0.75);
    EXPECT_EQ(spec.band_e_radps, 0.5);
    EXPECT_EQ(spec.largest_pole, 0.98);
    EXPECT_EQ(spec.voltage_V, 31.6);
    EXPECT_EQ(spec.voltage_headroom_V, 330.0);
    EXPECT_EQ(spec.d_axis_error_A, 0.35);
    EXPECT_EQ(spec.current_noise_A, 0.010);
    EXPECT_EQ(spec.current_lsb_A, 0.00488);
    ASSERT_EQ(spec.cases.size(), 2U);
    EXPECT_EQ(spec.cases[0].mechanical, 1.0);
    EXPECT_EQ(spec.cases[1].mechanical, 2.0);
    EXPECT_EQ(spec.cases[1].electrical, 1.5);
    EXPECT_EQ(spec.cases[1].dip_e_radps, 6.0);
    EXPECT_EQ(spec.cases[1].settling_time_s, 0.016);
    EXPECT_EQ(spec.cases[1].ripple_e_radps, 0.8);
}

TEST(Tune, SpecificationMistakesAreOneLine)
{
    const std::string &text = spec_text;
    for (const std::string key :
         {"speed_e_radps", "load_before_Nm", "load_step_Nm", "band_e_radps", "largest_pole",
          "voltage_V", "voltage_headroom_V", "d_axis_error_A", "current_noise_A", "current_lsb_A",
          "dip_e_radps", "settling_time_s", "ripple_e_radps", "mechanical", "electrical"}) {
        expect_complaint(without(key + " "), {key + " is missing"});
    }
    expect_complaint("colour = 1\n" + text, {"colour is not a known key"});
    expect_complaint(text + "colour = 1\n", {"colour is not a known key"}); // of the last case
    expect_complaint(replaced(text, "largest_pole   = 0.98", "largest_pole   = 1.0"),
                     {"largest_pole = 1 ", "0.1 .. 0.9999"});
    expect_complaint(replaced(text, "load_step_Nm   = 0.75", "load_step_Nm   = 0.0"),
                     {"load_step_Nm = 0 "});
    expect_complaint(replaced(text, "load_step_Nm   = 0.75", "load_step_Nm   = nan"),
                     {"load_step_Nm"});
    expect_complaint(replaced(text, "load_step_Nm   = 0.75", "load_step_Nm   = \"0.75\""),
                     {"load_step_Nm"});
    expect_complaint(replaced(text, "settling_time_s = 0.012", "settling_time_s = -0.012"),
                     {"settling_time_s"});
    expect_complaint(replaced(text, "mechanical      = 1.0", "mechanical      = 2.0"),
                     {"case", "nominal"});
    expect_complaint(replaced(text, "electrical      = 1.0", "electrical      = 0.5"),
                     {"case", "nominal"});
    expect_complaint(text.substr(0, text.find("[[case]]")), {"case"});
    expect_complaint(text.substr(0, text.find("[[case]]")) + "case = 3\n", {"case"});
    expect_complaint("speed_e_radps = \n", {"not valid TOML"});
    EXPECT_THROW(sdre::read_tune_spec(board_spec.string() + ".none"), sdre::InputError);
}

TEST(Tune, CommandRefusesWithOneLineAndLeavesTheDriveFile)
{
    const TempDir     dir;
    const std::string text  = read_file(board_drive);
    const std::string drive = dir.write("drive.toml", text).string();
    const std::string bad   = dir.write("spec.toml", without("voltage_V ")).string();
    const std::string tool  = "sdre-gains";
    const auto        tune  = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {SDRE_GAINS_EXE, "tune"});
        return support::run_command(arguments);
    };

    support::expect_refused(tune({drive, "--spec", bad}), 1, tool, {"voltage_V is missing"});
    support::expect_refused(tune({drive, "--spec", (dir / "none").string()}), 1, tool, {"none"});
    support::expect_refused(tune({(dir / "none").string(), "--spec", board_spec.string()}), 1, tool,
                            {"none"});
    support::expect_refused(tune({board_spec.string(), "--spec", board_spec.string()}), 1, tool);
    EXPECT_EQ(read_file(drive), text);
    EXPECT_EQ(support::names_in(dir.path()), (std::set<std::string>{"drive.toml", "spec.toml"}));
}

TEST(Tune, SectionsReplaceThoseOfTheShippedDriveOnly)
{
    const std::string text  = read_file(board_drive);
    const std::string tuned = sdre::with_sections(text, sections());
    const std::string head  = text.substr(0, text.find("# The weights below"));

    const std::string tail = text.substr(text.find("\n# Positions."));

    EXPECT_EQ(tuned, head + sections() + tail);
    EXPECT_EQ(sdre::with_sections(tuned, sections()), tuned);
}

TEST(Tune, WeightsThatWereKeptAreSaidSo)
{
    sdre::TuneResult r = found();
    r.kept             = true;
    const std::string kept =
        sdre::with_sections(read_file(board_drive), sdre::tuned_sections(r, own_spec()));

    EXPECT_NE(kept.find("were kept by `sdre-gains tune`"), std::string::npos);
    const std::string again = sdre::with_sections(kept, sections());
    EXPECT_EQ(again.find("were kept by"), std::string::npos);
    EXPECT_EQ(again, sdre::with_sections(read_file(board_drive), sections()));
}

TEST(Tune, SectionsBeforeOthersKeepThemByteForByte)
{
    const std::string head = "# a note\nschema = 1\nname = \"x\"\n\n";
    const std::string old  = "[nosc]\norder = 2 # old\nQ = [1.0, 1.0, 1.0]\n[nodo]\norder = 1\n";
    const std::string tail = "[encoder]\nlines  =  2500 # odd   spaces\n\n\n# the end";
    const std::string once = sdre::with_sections(head + old + tail, sections());

    EXPECT_EQ(once, head + sections() + tail);
    EXPECT_EQ(sdre::with_sections(once, sections()), once);
}

TEST(Tune, SectionsApartFromEachOtherAreBothReplaced)
{
    const std::string text = "[nodo]\norder = 1\n[encoder]\nlines = 2500\n[nosc]\norder = 2\n";
    const std::string once = sdre::with_sections(text, sections());

    EXPECT_EQ(once, sections() + "[encoder]\nlines = 2500\n");
    EXPECT_EQ(sdre::with_sections(once, sections()), once);
}

TEST(Tune, CommentsOfTheNextSectionAreKept)
{
    const std::string text =
        "[nosc]\nQ = [\n  1.0,\n  2.0]\n# of nodo\n[nodo]\n# inside\norder = 1\n\n"
        "# of the encoder\n[encoder]\nlines = 2500\n";
    const std::string once = sdre::with_sections(text, sections());

    EXPECT_EQ(once, sections() + "\n# of the encoder\n[encoder]\nlines = 2500\n");
    EXPECT_EQ(sdre::with_sections(once, sections()), once);
    EXPECT_EQ(sdre::with_sections("[nosc]\n[nodo]\norder = 1\n# the end\n", sections()),
              sections() + "# the end\n");
}

TEST(Tune, HeadersThatCannotBeFoundAreRefusedBeforeTheSearch)
{
    for (const std::string header : {"[ nosc ]", "  [nosc]"}) {
        const TempDir     dir;
        const std::string text = support::replaced(read_file(board_drive), "[nosc]", header);
        const std::string file = dir.write("drive.toml", text);

        support::expect_refused(
            support::run_command({SDRE_GAINS_EXE, "tune", file, "--spec", board_spec.string()}), 1,
            "sdre-gains", {"drive.toml", "[nosc]"});
        EXPECT_EQ(read_file(file), text);
    }
}

TEST(Tune, SectionsReadBackAsTheResult)
{
    const TempDir dir;
    const auto    file =
        dir.write("drive.toml", sdre::with_sections(read_file(board_drive), sections()));
    const sdre::Drive back = sdre::read_drive_file(file);

    EXPECT_EQ(sdre::drive_digest(back), sdre::drive_digest(found().drive));
    for (const char *piece :
         {"(17 evaluations)", "load step of 0.75 N m at 300 rad/s",
          "dip 5.05 (wanted 5), settled 8.4 ms (12). With noise: 3 sigma 0.60 (0.6)",
          "x2, R, L, flux x1.5", "form = \"encoder\""}) {
        EXPECT_NE(sections().find(piece), std::string::npos) << piece;
    }
}

TEST(Tune, ScoreDoesNotSeeTheLastDigits)
{
    const sdre::Drive    drive = sdre::read_drive_file(board_drive);
    const sdre::TuneSpec spec  = own_spec();
    sdre::Drive          other = drive;
    other.motor.inertia_kgm2 *= 1.0 + 1e-13;
    other.motor.q_axis_inductance_H *= 1.0 - 1e-13;
    for (int i = 0; i < 10; i++) {
        const double      d = 0.03 * i;
        const sdre::Point x{0.6 + d, 1.2 - d, 8.2 - d, 3.6 + 2.0 * d, 3.0 - d, -0.5 + d};
        const sdre::Score a = sdre::score(sdre::with_weights(drive, spec, x), spec);
        const sdre::Score b = sdre::score(sdre::with_weights(other, spec, x), spec);
        ASSERT_LT(a.worst, 10.0);
        EXPECT_EQ(a.value, b.value) << i;
        EXPECT_EQ(a.worst, b.worst) << i;
    }
}

TEST(Tune, WeightsAreJudgedAsTheyAreWritten)
{
    const sdre::TuneSpec spec = own_spec();
    const sdre::Point    x{0.61234567, 1.2345678, 8.2345678, 3.6543210, 3.0123456, -0.5432109};
    sdre::TuneResult     r;
    r.drive = sdre::with_weights(sdre::read_drive_file(board_drive), spec, x);
    r.cases = sdre::score(r.drive, spec).cases;
    const TempDir     dir;
    const std::string text =
        sdre::with_sections(read_file(board_drive), sdre::tuned_sections(r, spec));
    const sdre::Drive back = sdre::read_drive_file(dir.write("drive.toml", text));

    EXPECT_EQ(sdre::drive_digest(back), sdre::drive_digest(r.drive));
    EXPECT_EQ(sdre::score(back, spec).value, sdre::score(r.drive, spec).value);
}

TEST(Tune, ShippedDriveIsWhatTheSearchFinds)
{
    expect_kept("ipmsm_390w", 0);
}

TEST(Tune, DriveForEdgesOfTheirOwnIsWhatTheSearchFinds)
{
    // Three times the inertia in saturated iron dips by 8.85 rad/s; 8.4 are wanted. Certified weights
    // do not reach it.
    expect_kept("ipmsm_390w_own_edges", 2);
}

TEST(Tune, WeightsThatAreNotCertifiedAreMovedUntilTheyAre)
{
    // The best weights for these edges are unstable with 0.55 of the inertia.
    const sdre::Drive      drive = sdre::read_drive_file(board_drive);
    const sdre::TuneSpec   spec  = sdre::read_tune_spec(spec_of("ipmsm_390w_own_edges"));
    const sdre::TuneResult found = sdre::tune_drive(drive, spec, [](int, double) {});

    EXPECT_FALSE(found.kept);
    EXPECT_TRUE(sdre::design_drive(found.drive).certificate.passed());
}

TEST(Tune, SpecificationThatIsMissedIsSaidAndIsExitTwo)
{
    const TempDir     dir;
    std::string       text = read_file(board_spec);
    const std::string dip  = "dip_e_radps     = 4.75";
    text.replace(text.find(dip), dip.size(), "dip_e_radps = 4.0");
    const std::string spec = dir.write("a spec.toml", text).string();
    const std::string out  = (dir / "tuned.toml").string();
    const auto r = support::run_command({SDRE_GAINS_EXE, "tune", board_drive.string(), "--spec",
                                         spec, "--out", out, "--no-qualify"});
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_NE(r.out.find("written; certified, and THE SPECIFICATION IS NOT MET"), std::string::npos)
        << r.out;
    EXPECT_NE(r.out.find("next: larger values in '" + spec + "'"), std::string::npos) << r.out;
    EXPECT_TRUE(sdre::design_drive(sdre::read_drive_file(out)).certificate.passed());
}

TEST(Tune, SpecificationFarOutOfReachWritesNothing)
{
    const TempDir     dir;
    const std::string text = read_file(board_drive);
    const std::string file = dir.write("drive.toml", text).string();
    std::string       spec = replaced(spec_text, "dip_e_radps     = 5.0", "dip_e_radps     = 0.1");
    spec                   = replaced(spec, "settling_time_s = 0.012", "settling_time_s = 1e-4");
    spec = dir.write("spec.toml", spec.substr(0, spec.rfind("[[case]]"))).string();

    const auto result = support::run_command({SDRE_GAINS_EXE, "tune", file, "--spec", spec});

    // The search goes for speed alone, as far as the certificate does not follow.
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    const std::string last = result.err.substr(result.err.rfind('\n', result.err.size() - 2) + 1);
    EXPECT_EQ(last.rfind("sdre-gains: " + spec + ": the best weights found are not certified", 0),
              0U)
        << last;
    EXPECT_EQ(read_file(file), text);
}
