// SPDX-License-Identifier: MIT
/// `tune` of laws that know more of the machine: noc_shaft and noc_iron.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "design/design.hpp"
#include "design/law_design.hpp"
#include "design/noc_iron/iron_loop.hpp"
#include "design/noc_shaft/shaft_loop.hpp"
#include "shaft_drives.hpp"
#include "shipped_drive.hpp"
#include "temp_dir.hpp"
#include "tune/auto_tune.hpp"
#include "tune/drive_text.hpp"
#include "tune/goals.hpp"
#include "tune/load_step.hpp"
#include "tune/search.hpp"
#include "tune/start_weights.hpp"

namespace {

using support::TempDir;

sdre::Drive shipped(const std::string &name)
{
    return sdre::read_drive_file(support::shipped_drive(name));
}

/// `tune` reaches this for the rigid drive: the settling time is at 1.82 of its goal (docs/motors.md has the goals).
constexpr double rigid_worst = 1.82;

void expect_as_good_as_rigid(const sdre::AutoTuneResult &r)
{
    EXPECT_TRUE(sdre::design_drive(r.tuned.drive).certificate.passed());
    EXPECT_LE(r.tuned.worst_ratio, rigid_worst);
    EXPECT_LE(r.tuned.cases[0].voltage_noise_V, 1.02 * r.goals.voltage_noise_V);
}

double ratio_of(const sdre::Score &s, const sdre::TuneSpec &spec, const std::string &name)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < spec.cases.size(); i++) {
        for (const sdre::GoalRatio &g : goal_ratios(s.cases[i], spec.cases[i], spec)) {
            worst = g.name == name ? std::max(worst, g.ratio) : worst;
        }
    }
    return worst;
}

} // namespace

/// A coordinate moves one weight of the drive, or two that are the same, and no other.
TEST(TuneLaws, EachCoordinateIsAWeightOfTheLaw)
{
    for (const auto &[name, count] : {std::pair<std::string, std::size_t>{"ipmsm_390w", 6},
                                      {"ipmsm_390w_iron", 6},
                                      {"ipmsm_390w_shaft", 10}}) {
        const sdre::Drive    own  = sdre::start_weights(shipped(name), 1.0);
        const sdre::TuneSpec spec = [&own] {
            sdre::TuneSpec s = sdre::goals_from_physics(own);
            s.voltage_V      = 1.0 / std::sqrt(own.nosc.T[0]);
            s.d_axis_error_A = 1.0 / std::sqrt(own.nosc.Q[2]);
            return s;
        }();
        const sdre::Point x = sdre::point_of(own);
        ASSERT_EQ(x.size(), count) << name;
        const sdre::Drive same = sdre::with_weights(own, spec, x);
        EXPECT_EQ(sdre::drive_digest(same), sdre::drive_digest(own)) << name;
        for (std::size_t i = 0; i < count; i++) {
            sdre::Point moved = x;
            moved[i] += 1.0;
            sdre::Drive other  = sdre::with_weights(own, spec, moved);
            sdre::Drive before = own;
            const auto  a      = sdre::searched_weights(before);
            const auto  b      = sdre::searched_weights(other);
            for (std::size_t k = 0; k < count; k++) {
                for (std::size_t v = 0; v < a[k].values.size(); v++) {
                    const double factor = *b[k].values[v] / *a[k].values[v];
                    EXPECT_NEAR(factor, k == i ? 10.0 : 1.0, 0.06) << name << i << k;
                }
            }
            for (std::size_t v = 0; v < b[i].values.size(); v++) {
                *b[i].values[v] = *a[i].values[v];
            }
            EXPECT_EQ(sdre::drive_digest(other), sdre::drive_digest(own)) << name << i;
        }
    }
}

/// The oracle is the loop of the whole design, with the plant's shaft.
TEST(TuneLaws, CasesOfAShaftHaveItsResonance)
{
    const sdre::Drive  drive = shipped("ipmsm_390w_shaft");
    sdre::TuneSpec     spec  = sdre::goals_from_physics(drive);
    const sdre::Design d     = sdre::design_drive(drive);
    const sdre::Score  s     = sdre::score(drive, spec);
    ASSERT_EQ(spec.cases.size(), 7U);
    EXPECT_NEAR(spec.cases[5].resonance, 0.95, 1e-12);
    EXPECT_NEAR(spec.cases[6].resonance, 1.05, 1e-12);

    const double         load_Nm = spec.load_before_Nm + 0.5 * spec.load_step_Nm;
    const double         w       = spec.speed_e_radps;
    sdre::OperatingPoint at{w, 0.0, 0.0};
    for (double iq = 0.0; at.iq_A == 0.0; iq += 1e-4) {
        const sdre::OperatingPoint p{w, iq, sdre::mtpa_id_A(d.l, iq)};
        const double               holds = d.l[2] * w + d.l[3] * load_Nm;
        at                               = sdre::TrueMotor(d.l).acceleration(p) >= holds ? p : at;
    }
    for (const std::size_t i : {0U, 5U, 6U}) {
        sdre::Shaft shaft = sdre::believed_shaft(drive);
        shaft.resonance_Hz *= spec.cases[i].resonance;
        const sdre::LoopGains   gains{d.nosc.gain[0], d.nodo.gain[0]};
        const auto              loop = sdre::sampled_shaft_model(d, d.l, shaft, at, gains);
        const sdre::CaseResult &c    = s.cases[i];
        EXPECT_NEAR(c.dip_e_radps, sdre::load_step(loop, spec).dip_e_radps, 1e-3) << i;
        sdre::TuneSpec with_noise = spec;
        with_noise.band_e_radps -= c.ripple_e_radps;
        EXPECT_EQ(c.settling_time_s, sdre::load_step(loop, with_noise).settling_time_s) << i;
    }
    EXPECT_NE(s.cases[0].dip_e_radps, s.cases[5].dip_e_radps);
    spec.cases.front().resonance = 1.5; // far from what is believed
    EXPECT_GT(ratio_of(sdre::score(drive, spec), spec, "settling time"),
              1.3 * ratio_of(s, spec, "settling time"));
}

/// The board settles after 22.4, 9.0 and 9.4 ms at the worst resonance (docs/theory/simulation.md), within a band of 0.5 rad/s. The linear
/// model takes no less, as three deviations of the noise are not in its band, and at most half as much again.
TEST(TuneLaws, ShaftSettlesAsOnTheBoard)
{
    const double board_ms[] = {22.4, 9.0, 9.4};
    for (std::size_t i = 0; i < std::size(board_ms); i++) {
        const sdre::Drive drive = support::shaft_drive(support::shaft_weights[i]);
        sdre::TuneSpec    spec  = sdre::goals_from_physics(drive);
        spec.band_e_radps       = 0.5;
        spec.speed_e_radps      = 300.0;
        const sdre::Score s     = sdre::score(drive, spec);
        double            worst = 0.0;
        for (const std::size_t k : {0U, 5U, 6U}) {
            worst = std::max(worst, 1e3 * s.cases[k].settling_time_s);
        }
        EXPECT_GE(worst, 0.95 * board_ms[i]) << drive.mechanics.resonance_Hz;
        EXPECT_LE(worst, 1.45 * board_ms[i]) << drive.mechanics.resonance_Hz;
    }
}

/// The oracle is the loop of the whole design with the motor of the map, at a saturated point. Constant inductances are another motor.
TEST(TuneLaws, CasesOfIronHaveTheMap)
{
    const sdre::Drive    drive = shipped("ipmsm_390w_iron");
    const sdre::TuneSpec spec  = sdre::goals_from_physics(drive);
    const sdre::Design   d     = sdre::design_drive(drive);
    const auto           iron  = sdre::true_motor(drive, drive.motor);
    const double         w     = spec.speed_e_radps;
    const double holds = d.l[2] * w + d.l[3] * (spec.load_before_Nm + 0.5 * spec.load_step_Nm);
    sdre::OperatingPoint at{w, 0.0, 0.0};
    for (double iq = 0.0; at.iq_A == 0.0; iq += 1e-4) {
        const sdre::OperatingPoint p{w, iq, sdre::mtpa_id_A(d.l, iq)};
        at = iron.acceleration(p) >= holds ? p : at;
    }
    const sdre::LoopGains gains{d.nosc.gain[0], d.nodo.gain[0]};
    const auto step  = sdre::load_step(sdre::sampled_iron_model(d, iron, at, gains), spec);
    const auto s     = sdre::score(drive, spec);
    const auto plain = sdre::sampled_model(d.l, d.l, gains, at, sdre::control_period_s(drive));
    EXPECT_NEAR(s.cases[0].dip_e_radps, step.dip_e_radps, 1e-3);
    EXPECT_EQ(s.cases[0].settling_time_s, step.settling_time_s);
    EXPECT_GT(std::abs(step.dip_e_radps - sdre::load_step(plain, spec).dip_e_radps), 0.03);

    // A controller that believes half the flux linkages scales its map too: with constant inductances in the map it is noc.
    sdre::Drive noc   = drive;
    noc.law           = sdre::Law::noc;
    const auto of_noc = sdre::score(noc, spec);
    for (std::size_t i = 1; i < spec.cases.size(); i++) {
        EXPECT_NEAR(s.cases[i].dip_e_radps, of_noc.cases[i].dip_e_radps,
                    0.1 * of_noc.cases[i].dip_e_radps)
            << i;
    }
}

TEST(TuneLaws, GoalsOfAShaftAllowItsSpring)
{
    const sdre::Drive drive = shipped("ipmsm_390w_shaft");
    const auto        bound = sdre::physical_bound(drive);
    const auto        rigid = sdre::physical_bound(shipped("ipmsm_390w"));
    EXPECT_NEAR(bound.shaft_s, 1.0 / (2.0 * std::acos(-1.0) * 220.0), 1e-12);
    EXPECT_NEAR(bound.reaction_s - bound.shaft_s, rigid.reaction_s, 1e-12);
    EXPECT_EQ(rigid.shaft_s, 0.0);
    const auto spec       = sdre::goals_from_physics(drive);
    const auto rigid_spec = sdre::goals_from_physics(shipped("ipmsm_390w"));
    EXPECT_NEAR(spec.band_e_radps, rigid_spec.band_e_radps, 1e-12);
    EXPECT_NEAR(spec.cases[0].settling_time_s, 2.0 * rigid_spec.cases[0].settling_time_s, 1e-12);
    EXPECT_EQ(rigid_spec.cases.size(), 5U);
}

TEST(TuneLaws, CasesOfASpecificationStay)
{
    const sdre::Drive drive = shipped("ipmsm_390w_shaft");
    const TempDir     dir;
    std::string       text = support::read_file(std::filesystem::path(SDRE_SOURCE_DIR) /
                                                "firmware/config/specs/ipmsm_390w.toml");
    const std::size_t own  = sdre::read_tune_spec(dir.write("a.toml", text)).cases.size();
    const auto        more =
        sdre::with_shaft_cases(sdre::read_tune_spec(dir.write("b.toml", text)), drive);
    EXPECT_EQ(more.cases.size(), own + 2);
    EXPECT_EQ(more.cases.back().dip_e_radps, more.cases.front().dip_e_radps);
    text += "[[case]]\nmechanical = 1\nelectrical = 1\nresonance = 0.9\ndip_e_radps = 9\n"
            "settling_time_s = 0.02\nripple_e_radps = 1\n";
    const auto same =
        sdre::with_shaft_cases(sdre::read_tune_spec(dir.write("c.toml", text)), drive);
    EXPECT_EQ(same.cases.size(), own + 1);
    EXPECT_EQ(same.cases.back().resonance, 0.9);
}

TEST(TuneLaws, OnlyAShaftHasAResonance)
{
    const TempDir dir;
    const auto    spec =
        dir.write("spec.toml", support::read_file(std::filesystem::path(SDRE_SOURCE_DIR) /
                                                  "firmware/config/specs/ipmsm_390w.toml") +
                                   "[[case]]\nmechanical = 1\nelectrical = 1\nresonance = 0.9\n"
                                   "dip_e_radps = 9\nsettling_time_s = 0.02\nripple_e_radps = 1\n");
    const auto r =
        support::run_command({SDRE_GAINS_EXE, "tune", support::shipped_drive("ipmsm_390w").string(),
                              "--spec", spec.string(), "--out", (dir / "tuned.toml").string()});
    EXPECT_EQ(r.exit_code, 1);
    EXPECT_NE(r.err.find(spec.string() + ": [[case]] resonance is not allowed: only law = "
                                         "\"noc_shaft\" has one"),
              std::string::npos)
        << r.err;
    EXPECT_FALSE(std::filesystem::exists(dir / "tuned.toml"));
}

TEST(TuneLaws, SectionsOfAShaftAreReadBack)
{
    const auto        file = support::shipped_drive("ipmsm_390w_shaft");
    const std::string text = support::read_file(file);
    sdre::TuneResult  r;
    sdre::TuneSpec    spec = sdre::goals_from_physics(shipped("ipmsm_390w_shaft"));
    r.drive                = sdre::start_weights(shipped("ipmsm_390w_shaft"), 1.3);
    spec.voltage_V         = 1.0 / std::sqrt(r.drive.nosc.T[0]);
    spec.d_axis_error_A    = 1.0 / std::sqrt(r.drive.nosc.Q[2]);
    r.cases.resize(spec.cases.size());
    const std::string once  = sdre::with_sections(text, sdre::tuned_sections(r, spec));
    const std::string twice = sdre::with_sections(once, sdre::tuned_sections(r, spec));
    EXPECT_EQ(once, twice);
    EXPECT_EQ(once.find("[shaft]"), once.rfind("[shaft]"));
    EXPECT_NE(once.find(", resonance x0.95: dip"), std::string::npos) << once;
    EXPECT_EQ(sdre::drive_digest(sdre::read_drive_text(once, file.string())),
              sdre::drive_digest(r.drive));
}

TEST(TuneLaws, SectionOfAShaftMustBeginALine)
{
    const TempDir     dir;
    const auto        file = support::shipped_drive("ipmsm_390w_shaft");
    const std::string text = support::replaced(support::read_file(file), "\n[shaft]", "\n [shaft]");
    try {
        sdre::require_rewritable("d.toml", text, sdre::read_drive_text(text, file.string()));
        FAIL();
    } catch (const sdre::InputError &e) {
        EXPECT_EQ(std::string(e.what()),
                  "d.toml: [shaft] must stand at the start of a line, so that its weights can be "
                  "replaced");
    }
}

/// The command searches, judges and names the next step; a report predicts the load step.
TEST(TuneLaws, IronIsTunedAsWellAsTheRigidDrive)
{
    const auto    file = support::shipped_drive("ipmsm_390w_iron");
    const TempDir dir;
    const auto    r = support::run_command({SDRE_GAINS_EXE, "tune", file.string(), "--out",
                                            (dir / "tuned.toml").string(), "--no-qualify"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(r.out.find("written; certified; "), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("next: sdre-sil qualify "), std::string::npos) << r.out;
    const sdre::Drive tuned =
        sdre::read_drive_text(support::read_file(dir / "tuned.toml"), file.string());
    const sdre::TuneSpec spec = sdre::goals_from_physics(tuned);
    EXPECT_TRUE(sdre::design_drive(tuned).certificate.passed());
    EXPECT_LE(sdre::score(tuned, spec).worst, rigid_worst);
    const auto report = support::run_command({SDRE_GAINS_EXE, "report", file.string()});
    EXPECT_NE(report.out.find("load step"), std::string::npos) << report.out;
}

/// A short search from the shipped weights: what tune() does from its own starts.
TEST(TuneLaws, AShortSearchImprovesAShaft)
{
    const sdre::Drive    own  = shipped("ipmsm_390w_shaft");
    const sdre::TuneSpec spec = [&own] {
        sdre::TuneSpec s = sdre::goals_from_physics(own);
        s.voltage_V      = 1.0 / std::sqrt(own.nosc.T[0]);
        s.d_axis_error_A = 1.0 / std::sqrt(own.nosc.Q[2]);
        s.cases.erase(s.cases.begin() + 1, s.cases.begin() + 5);
        return s;
    }();
    const auto value = [&](const sdre::Point &x) {
        return sdre::score(sdre::with_weights(own, spec, x), spec).value;
    };
    const sdre::Point from  = sdre::point_of(own);
    const sdre::Point found = sdre::improve(from, value);
    EXPECT_LT(value(found), 0.5 * value(from)); // the shipped weights are noisier than the goal
    EXPECT_EQ(found, sdre::improve(from, value));
}

TEST(TuneLawsAll, ShaftsAreTunedAsWellAsTheRigidDrive)
{
    for (const support::ShaftWeights &w : support::shaft_weights) {
        const sdre::Drive drive = support::shaft_drive(w);
        const auto        r     = sdre::auto_tune(drive, [](int, double) {});
        expect_as_good_as_rigid(r);
        const auto again = sdre::auto_tune(drive, [](int, double) {});
        EXPECT_EQ(sdre::tuned_sections(r.tuned, r.goals),
                  sdre::tuned_sections(again.tuned, again.goals));
    }
}

/// With a specification of its own the search has the same starts.
TEST(TuneLawsAll, ShaftWithASpecificationIsCertified)
{
    const sdre::Drive drive = shipped("ipmsm_390w_shaft");
    sdre::TuneSpec    spec  = sdre::goals_from_physics(drive);
    spec.voltage_V          = 31.6;
    spec.d_axis_error_A     = 0.35;
    for (sdre::RobustnessCase &c : spec.cases) {
        c.settling_time_s *= 1.5;
        c.dip_e_radps *= 1.3;
    }
    const auto r = sdre::tune_drive(drive, spec, [](int, double) {});
    EXPECT_TRUE(sdre::design_drive(r.drive).certificate.passed());
    EXPECT_LE(r.worst_ratio, 1.05);
}
