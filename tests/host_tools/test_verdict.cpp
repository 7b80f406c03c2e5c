// SPDX-License-Identifier: MIT
/// The verdict sees a loop that is bad at one place only, whatever place that is.
#include "design/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "design/design.hpp"
#include "design/robust_box.hpp"
#include "shipped_drive.hpp"

namespace {

using sdre::BrokenLoop;
using sdre::LoopFamily;
using sdre::Motor;
using sdre::OperatingPoint;
using sdre::Verdict;

constexpr double ts_s = 2e-4;

const sdre::Design &shipped()
{
    static const sdre::Design design =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w")));
    return design;
}

/// One pole in a loop of an integrator's kind: x+ = pole x + gain r, u = -x. Its S is 1 - gain / (z - pole).
BrokenLoop one_pole(double pole, double gain = 0.1)
{
    return {Eigen::MatrixXd::Constant(1, 1, pole), Eigen::VectorXd::Constant(1, gain),
            Eigen::RowVectorXd::Constant(1, -1.0), ts_s};
}

constexpr double good = 0.9;
constexpr double bad  = 1.01;

/// A healthy family of two channels, with the points of the shipped drive.
LoopFamily healthy()
{
    LoopFamily f;
    f.channels   = {"q axis", "d axis"};
    f.points     = sdre::verdict_points(shipped());
    f.box_points = sdre::verdict_box_points(shipped());
    f.loops      = [](const Motor &, const OperatingPoint &) {
        return std::vector<BrokenLoop>{one_pole(good), one_pole(good)};
    };
    return f;
}

/// Unstable wherever `where` says so.
template <typename Where> LoopFamily unstable_if(Where where)
{
    LoopFamily f = healthy();
    f.loops      = [where](const Motor &m, const OperatingPoint &at) {
        const double pole = where(m, at) ? bad : good;
        return std::vector<BrokenLoop>{one_pole(pole), one_pole(pole)};
    };
    return f;
}

std::vector<std::string> failures_of(const LoopFamily &f)
{
    std::vector<std::string> failures;
    sdre::judge(sdre::examine(f, shipped().drive), ts_s, failures);
    return failures;
}

void expect_one(const LoopFamily &f, const std::string &piece)
{
    const auto failures = failures_of(f);
    ASSERT_FALSE(failures.empty()) << piece;
    EXPECT_NE(failures[0].find(piece), std::string::npos) << failures[0];
}

} // namespace

TEST(Verdict, HealthyLoopPasses)
{
    EXPECT_TRUE(failures_of(healthy()).empty());
    const Verdict v = sdre::examine(healthy(), shipped().drive);
    EXPECT_DOUBLE_EQ(v.spectral_radius, good);
    EXPECT_EQ(v.box->share, 1.0);
    EXPECT_EQ(v.alone->share, 1.0);
    for (const sdre::Channel &c : v.channels) { // |1 - 0.1 / (z - 0.9)|: largest at z = -1
        EXPECT_NEAR(c.worst.peak, 1.0 + 0.1 / 1.9, 1e-6);
        EXPECT_NEAR(c.worst.peak_Hz, 2500.0, 1.0);
    }
}

TEST(Verdict, EveryPlaceIsLookedAt)
{
    const double rated = shipped().drive.motor.rated_speed_e_radps;
    const double top   = static_cast<double>(shipped().config.speed_max_e_radps);
    const auto   at = [](const auto &where) { expect_one(unstable_if(where), "does not settle"); };
    at([](const Motor &, const OperatingPoint &p) {
        return p.omega_e_radps == 0.0 && p.iq_A == 0.0;
    });
    at([=](const Motor &, const OperatingPoint &p) { return p.omega_e_radps > 1.01 * rated; });
    at([=](const Motor &, const OperatingPoint &p) {
        return std::abs(p.omega_e_radps - rated) < 1.0;
    });
    at([](const Motor &, const OperatingPoint &p) { return p.iq_A > 3.0; });
    at([](const Motor &, const OperatingPoint &p) { return p.iq_A < -3.0; });
    at([=](const Motor &, const OperatingPoint &p) {
        return p.omega_e_radps >= top && p.iq_A < 0.0;
    });
    at([](const Motor &, const OperatingPoint &p) {
        return p.omega_e_radps == 0.0 && p.iq_A > 3.0;
    });
}

TEST(Verdict, SlowModeIsNoStability)
{
    LoopFamily f = healthy();
    f.loops      = [](const Motor &, const OperatingPoint &) {
        const double pole = std::exp(-ts_s / (1.5 * sdre::slowest_mode_s));
        return std::vector<BrokenLoop>{one_pole(pole, 1e-9), one_pole(pole, 1e-9)};
    };
    expect_one(f, "does not settle");
}

/// Stable, but close to the limit at one channel of one point: x+ = -0.9 x + 0.4 r has |S| = 5 at half the sampling rate.
TEST(Verdict, EveryChannelHasItsMargin)
{
    for (const std::size_t channel : {std::size_t{0}, std::size_t{1}}) {
        LoopFamily f = healthy();
        f.loops      = [channel](const Motor &, const OperatingPoint &p) {
            std::vector<BrokenLoop> loops{one_pole(good), one_pole(good)};
            if (p.iq_A < 0.0) {
                loops[channel] = one_pole(-good, 0.4);
            }
            return loops;
        };
        expect_one(f, f.channels[channel] + ": sensitivity peak 5");
    }
}

/// More loops than channels: the law runs in two ways, and the second is the bad one.
TEST(Verdict, EveryWayToRunIsJudged)
{
    LoopFamily f = healthy();
    f.loops      = [](const Motor &, const OperatingPoint &) {
        return std::vector<BrokenLoop>{one_pole(good), one_pole(good), one_pole(good),
                                       one_pole(-good, 0.4)};
    };
    expect_one(f, "d axis: sensitivity peak 5");
    f.loops = [](const Motor &m, const OperatingPoint &) {
        const double pole = m.inertia_kgm2 < 0.8 * shipped().drive.motor.inertia_kgm2 ? bad : good;
        return std::vector<BrokenLoop>{one_pole(good), one_pole(good), one_pole(pole),
                                       one_pole(pole)};
    };
    expect_one(f, "unstable with a motor of");
}

TEST(Verdict, OtherMotorsAreAskedFor)
{
    const Motor     &own   = shipped().drive.motor;
    const LoopFamily light = unstable_if([&](const Motor &m, const OperatingPoint &) {
        return m.inertia_kgm2 < 0.55 * own.inertia_kgm2;
    });
    expect_one(light, "J x0.5"); // the box is wide enough, the end of the inertia alone is not
    EXPECT_EQ(failures_of(light).size(), 1U);
    LoopFamily paper = light;
    paper.box_points.clear();
    EXPECT_TRUE(failures_of(paper).empty());
    const LoopFamily strong = unstable_if([&](const Motor &m, const OperatingPoint &) {
        return m.pm_flux_Wb > 1.1 * own.pm_flux_Wb && m.inertia_kgm2 < 0.9 * own.inertia_kgm2;
    });
    expect_one(strong, "of the box of parameters");
    EXPECT_EQ(failures_of(strong).size(), 1U); // alone each is fine
}

/// With harmonics at every quarter of the rated speed, without at the rated one.
TEST(Verdict, OtherMotorsAreAskedForAtSpeeds)
{
    const Motor       &own   = shipped().drive.motor;
    const double       rated = own.rated_speed_e_radps;
    const sdre::Design harmonics =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w_noc_h")));
    const auto high_L = [&](double speed) {
        return unstable_if([&own, speed](const Motor &m, const OperatingPoint &p) {
            return m.q_axis_inductance_H > 1.4 * own.q_axis_inductance_H &&
                   std::abs(p.omega_e_radps - speed) < 1.0;
        });
    };
    expect_one(high_L(rated), "L x1.4");
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        LoopFamily f = high_L(share * rated);
        f.box_points = sdre::verdict_box_points(harmonics);
        expect_one(f, "L x1.4");
    }
}

TEST(Verdict, TripsThatAHealthyDriveReachesAreRefused)
{
    Verdict v = sdre::examine(healthy(), shipped().drive);
    v.trips   = {{"disturbance", 10.0, 9.9}};
    std::vector<std::string> failures;
    sdre::judge(v, ts_s, failures);
    EXPECT_TRUE(failures.empty());
    v.trips = {{"disturbance", 10.0, 10.1}};
    sdre::judge(v, ts_s, failures);
    ASSERT_EQ(failures.size(), 1U);
    EXPECT_NE(failures[0].find("disturbance: a healthy drive reaches 10.1, its trip is at 10"),
              std::string::npos)
        << failures[0];
}

/// Not a number is not below a limit. It stands in a pole or an input, at the first, a middle or the last point.
TEST(Verdict, NotANumberIsRefused)
{
    const std::vector<OperatingPoint> points = sdre::verdict_points(shipped());
    for (const double no_number : {std::nan(""), HUGE_VAL}) {
        for (const std::size_t at : {std::size_t{0}, points.size() / 2, points.size() - 1}) {
            for (const std::size_t channel : {std::size_t{0}, std::size_t{1}}) {
                const auto is_there = [&points, at](const OperatingPoint &p) {
                    return p.omega_e_radps == points[at].omega_e_radps && p.iq_A == points[at].iq_A;
                };
                LoopFamily f = healthy();
                f.loops      = [&](const Motor &, const OperatingPoint &p) {
                    std::vector<BrokenLoop> loops{one_pole(good), one_pole(good)};
                    loops[channel] = is_there(p) ? one_pole(no_number) : loops[channel];
                    return loops;
                };
                expect_one(f, "does not settle");
                f.loops = [&](const Motor &, const OperatingPoint &p) {
                    std::vector<BrokenLoop> loops{one_pole(good), one_pole(good)};
                    loops[channel] = is_there(p) ? one_pole(good, no_number) : loops[channel];
                    return loops;
                };
                expect_one(f, f.channels[channel] + ": sensitivity peak inf");
            }
        }
    }
}

/// The same with one motor of the box only.
TEST(Verdict, NotANumberOfAnotherMotorIsRefused)
{
    const Motor &own = shipped().drive.motor;
    LoopFamily   f   = healthy();
    f.loops          = [&own](const Motor &m, const OperatingPoint &) {
        const double pole = m.inertia_kgm2 < 0.55 * own.inertia_kgm2 ? std::nan("") : good;
        return std::vector<BrokenLoop>{one_pole(pole), one_pole(pole)};
    };
    expect_one(f, "J x0.5");
}

/// A verdict with a figure that is not a number is refused, and a search sees no way below the limit.
TEST(Verdict, FiguresThatAreNoNumbersAreRefused)
{
    const double  nan  = std::nan("");
    const Verdict fine = sdre::examine(healthy(), shipped().drive);
    const auto    bad  = [&fine](const auto &change) {
        Verdict                  v = fine;
        std::vector<std::string> failures;
        change(v);
        sdre::judge(v, ts_s, failures);
        ASSERT_EQ(failures.size(), 1U);
        EXPECT_EQ(failures[0].find("nan"), std::string::npos) << failures[0];
        EXPECT_FALSE(sdre::excess(v, ts_s) <= 1.0);
    };
    EXPECT_LE(sdre::excess(fine, ts_s), 1.0);
    bad([nan](Verdict &v) { v.spectral_radius = nan; });
    bad([nan](Verdict &v) { v.channels[0].worst.peak = nan; });
    bad([nan](Verdict &v) { v.channels[1].worst.peak = nan; });
    bad([nan](Verdict &v) { v.box->share = nan; });
    bad([nan](Verdict &v) { v.alone->share = nan; });
    bad([nan](Verdict &v) { v.trips = {{"disturbance", 10.0, nan}, {"other", 10.0, 1.0}}; });
}

/// 1 is the allowed radius, whatever else is far from its limit.
TEST(Verdict, ExcessIsOneAtTheAllowedRadius)
{
    Verdict v         = sdre::examine(healthy(), shipped().drive);
    v.spectral_radius = std::exp(-ts_s / sdre::slowest_mode_s);
    EXPECT_NEAR(sdre::excess(v, ts_s), 1.0, 1e-9);
}

/// The slow point is without load, as the loop is judged there for its encoder.
TEST(Verdict, SlowPointHasNoTorque)
{
    const std::vector<OperatingPoint> points = sdre::verdict_box_points(shipped());
    EXPECT_EQ(points.at(0).iq_A, 0.0);
    EXPECT_GT(points.at(1).iq_A, 0.0);
}

/// Six times the sensor noise of the weights plus the step of the full torque stays far from the
/// trip. A drive with a noisy sensor that trusts it is refused.
TEST(Verdict, NoiseBelongsBelowTheTrip)
{
    const Verdict &v = *shipped().certificate.loop;
    ASSERT_EQ(v.trips.size(), 1U);
    const double step = 0.5 * v.trips[0].limit; // the trip is at twice the torque
    EXPECT_GT(v.trips[0].healthy, step);
    EXPECT_LT(v.trips[0].healthy, 1.2 * step);

    sdre::Drive noisy = shipped().drive;
    noisy.nodo.T[2] *= 1e6; // 25 mrad, 20 counts
    noisy.nodo.Q[0] *= 1e6;
    const sdre::Certificate c    = sdre::design_drive(noisy).certificate;
    bool                    said = false;
    for (const std::string &failure : c.failures) {
        said = said || failure.find("disturbance of the speed") == 0;
    }
    EXPECT_TRUE(said);
}

namespace {

/// The pole of each loop as the point and the motor say; its gain as large as keeps |S| at 1 + gain / (1 - |pole|).
LoopFamily poles_at(std::vector<OperatingPoint> points,
                    std::function<std::vector<double>(const Motor &, const OperatingPoint &)> poles)
{
    LoopFamily f;
    f.channels = {"q axis", "d axis"};
    f.points   = std::move(points);
    f.loops    = [poles](const Motor &m, const OperatingPoint &at) {
        std::vector<BrokenLoop> loops;
        for (const double pole : poles(m, at)) {
            loops.push_back(one_pole(pole, 0.01));
        }
        return loops;
    };
    return f;
}

} // namespace

/// Peak and radius are kept apart: the largest of each, of all loops and points, whatever the order.
TEST(Verdict, KeepsTheLargestPeakAndTheLargestRadiusOfEachChannel)
{
    const std::vector<double> radius{0.2, 0.5, 0.7, 0.3}; // of z = pole, |S| peaks at z = -1
    for (std::size_t turn = 0; turn < radius.size(); turn++) {
        std::vector<OperatingPoint> points;
        for (std::size_t k = 0; k < radius.size(); k++) {
            points.push_back({10.0 * static_cast<double>((k + turn) % radius.size()), 0.0, 0.0});
        }
        // A positive pole has the larger radius, a negative one the larger peak at z = -1.
        const auto poles = [&](const Motor &, const OperatingPoint &at) {
            const double r = radius[static_cast<std::size_t>(at.omega_e_radps / 10.0)];
            return std::vector<double>{r, 0.9 * r, -0.5 * r, -0.4 * r};
        };
        const Verdict v = sdre::examine(poles_at(points, poles), shipped().drive);
        EXPECT_NEAR(v.spectral_radius, 0.7, 1e-12);
        EXPECT_EQ(v.radius_at.omega_e_radps, 20.0);
        EXPECT_NEAR(v.channels[0].worst.spectral_radius, 0.7, 1e-12);
        EXPECT_NEAR(v.channels[1].worst.spectral_radius, 0.63, 1e-12);
        EXPECT_NEAR(v.channels[0].worst.peak, 1.0 + 0.01 / (1.0 - 0.35), 1e-9);
        EXPECT_NEAR(v.channels[1].worst.peak, 1.0 + 0.01 / (1.0 - 0.28), 1e-9);
        EXPECT_EQ(v.channels[0].at.omega_e_radps, 20.0);
        EXPECT_EQ(v.channels[1].at.omega_e_radps, 20.0);
    }
}

/// The plane is swept roughly, and its worst points are judged as all others: one for the radius, one for each channel.
TEST(Verdict, WorstPointsOfThePlaneAreJudged)
{
    for (const double scale : {1.0, 0.05}) { // 0.05: every radius is small
        for (int worst = 0; worst < 7; worst++) {
            for (int place = 0; place < 4;
                 place++) { // loops: q and d axis of one mode, then of the other
                const auto poles = [&](const Motor &, const OperatingPoint &at) {
                    std::vector<double> p(4, 0.1 * scale);
                    if (at.omega_e_radps == 100.0 + worst) {
                        p[static_cast<std::size_t>(place)] = -0.9 * scale;
                    }
                    return p;
                };
                LoopFamily f = poles_at({{0.0, 0.0, 0.0}}, poles);
                for (int k = 0; k < 7; k++) {
                    f.plane.push_back({100.0 + k, 1.0, 0.0});
                }
                const Verdict v = sdre::examine(f, shipped().drive);
                EXPECT_NEAR(v.spectral_radius, 0.9 * scale, 1e-12) << worst << place;
                EXPECT_EQ(v.radius_at.omega_e_radps, 100.0 + worst);
                const sdre::Channel &bad = v.channels[static_cast<std::size_t>(place % 2)];
                EXPECT_NEAR(bad.worst.peak, 1.0 + 0.01 / (1.0 - 0.9 * scale), 1e-9);
                EXPECT_EQ(bad.at.omega_e_radps, 100.0 + worst);
            }
        }
    }
}

/// One point of the plane has the radius, others have the peaks of the channels: all three are judged.
TEST(Verdict, PlaneHasAWorstPointForEachFigure)
{
    // x+ = pole x + gain r: |S| - 1 is gain / (1 - |pole|), so the radius does not choose the peaks.
    LoopFamily f;
    f.channels = {"q axis", "d axis"};
    f.points   = {{0.0, 0.0, 0.0}};
    f.loops    = [](const Motor &, const OperatingPoint &at) {
        const double q = at.omega_e_radps == 2.0 ? 0.9 : 0.01;
        const double d = at.omega_e_radps == 3.0 ? 0.8 : 0.01;
        const double r = at.omega_e_radps == 4.0 ? 0.95 : 0.1;
        return std::vector<BrokenLoop>{one_pole(-r, q), one_pole(-r, d)};
    };
    f.plane         = {{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {4.0, 0.0, 0.0}};
    const Verdict v = sdre::examine(f, shipped().drive);
    EXPECT_NEAR(v.spectral_radius, 0.95, 1e-12);
    EXPECT_EQ(v.radius_at.omega_e_radps, 4.0);
    EXPECT_NEAR(v.channels[0].worst.peak, 2.0, 1e-9);
    EXPECT_EQ(v.channels[0].at.omega_e_radps, 2.0);
    EXPECT_NEAR(v.channels[1].worst.peak, 1.0 + 0.8 / 0.9, 1e-9);
    EXPECT_EQ(v.channels[1].at.omega_e_radps, 3.0);
}

/// A search minimises this. Each part is the largest once, and its value is known by hand.
TEST(Verdict, ExcessIsTheLargestOfWhatIsFoundOverWhatIsAllowed)
{
    const auto excess = [](const auto &change) {
        Verdict v;
        v.spectral_radius        = std::exp(-ts_s / 1e-3); // a time constant of a millisecond
        v.channels               = {{"q axis", {}, {}}, {"d axis", {}, {}}};
        v.channels[0].worst.peak = v.channels[1].worst.peak = 1.0;
        v.box = v.alone = sdre::RobustBox{1.0, ""};
        v.trips         = {{"disturbance", 10.0, 1.0}, {"other", 4.0, 1.0}};
        change(v);
        return sdre::excess(v, ts_s);
    };
    EXPECT_NEAR(excess([](Verdict &) {}), 1.0, 1e-12); // one motor at a time: the whole range
    for (const double wide : {1.3, 2.0, 7.0}) {
        const auto mode = [&](Verdict &v) {
            v.spectral_radius = std::exp(-ts_s / (wide * sdre::slowest_mode_s));
        };
        EXPECT_NEAR(excess(mode), wide, 1e-6 * wide);
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
            const auto peak = [&](Verdict &v) { v.channels[k].worst.peak = 3.0 * wide; };
            EXPECT_NEAR(excess(peak), wide, 1e-12);
            const auto trip = [&](Verdict &v) { v.trips[k].healthy = wide * v.trips[k].limit; };
            EXPECT_NEAR(excess(trip), wide, 1e-12);
        }
        EXPECT_NEAR(excess([&](Verdict &v) { v.box->share = 0.4 / wide; }), wide, 1e-12);
        EXPECT_NEAR(excess([&](Verdict &v) { v.alone->share = 1.0 / wide; }), wide, 1e-12);
    }
    EXPECT_NEAR(excess([](Verdict &v) { v.box->share = 0.0; }), 400.0, 1e-9);
    EXPECT_NEAR(excess([](Verdict &v) { v.alone->share = 0.0; }), 1000.0, 1e-9);
    EXPECT_NEAR(excess([](Verdict &v) { v.spectral_radius = 1.0; }), 1000.0, 1e-9);
    EXPECT_NEAR(excess([](Verdict &v) { v.spectral_radius = 1.05; }), 1000.0, 1e-9);
    EXPECT_LT(excess([](Verdict &v) { v.box = v.alone = std::nullopt; }), 0.34); // the peaks' third
}

/// A figure at its limit passes. The next number beyond it does not.
TEST(Verdict, LimitsThemselvesAreAllowed)
{
    const auto failures = [](const auto &change) {
        Verdict v;
        v.spectral_radius        = std::exp(-ts_s / 1e-3);
        v.channels               = {{"q axis", {}, {}}, {"d axis", {}, {}}};
        v.channels[0].worst.peak = v.channels[1].worst.peak = 1.5;
        v.box = v.alone = sdre::RobustBox{1.0, ""};
        v.trips         = {{"disturbance", 10.0, 1.0}};
        change(v);
        std::vector<std::string> lines;
        sdre::judge(v, ts_s, lines);
        return lines.size();
    };
    const auto up   = [](double x) { return std::nextafter(x, HUGE_VAL); };
    const auto down = [](double x) { return std::nextafter(x, -HUGE_VAL); };
    for (const double most_s : {2.0, 100.0}) {
        const auto lines_of = [&](double radius) {
            return failures([&](Verdict &v) {
                v.slowest_mode_s  = most_s;
                v.spectral_radius = radius;
            });
        };
        for (const double share : {1e-3, 0.1, 0.5, 0.99}) {
            EXPECT_EQ(lines_of(std::exp(-ts_s / (share * most_s))), 0U) << share;
        }
        const double slowest = std::exp(-ts_s / most_s);
        EXPECT_EQ(lines_of(slowest), 0U);
        EXPECT_EQ(lines_of(up(slowest)), 1U);
    }
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        EXPECT_EQ(failures([&](Verdict &v) { v.channels[k].worst.peak = 3.0; }), 0U);
        EXPECT_EQ(failures([&](Verdict &v) { v.channels[k].worst.peak = up(3.0); }), 1U);
    }
    EXPECT_EQ(failures([](Verdict &v) { v.box->share = 0.4; }), 0U);
    EXPECT_EQ(failures([&](Verdict &v) { v.box->share = down(0.4); }), 1U);
    EXPECT_EQ(failures([](Verdict &v) { v.alone->share = 1.0; }), 0U);
    EXPECT_EQ(failures([&](Verdict &v) { v.alone->share = down(1.0); }), 1U);
    EXPECT_EQ(failures([](Verdict &v) { v.trips[0].healthy = 10.0; }), 0U);
    EXPECT_EQ(failures([&](Verdict &v) { v.trips[0].healthy = up(10.0); }), 1U);
}

/// Unstable with some motors inside the box, and stable again with those farther away: the box ends before the first of them.
TEST(Verdict, BoxHasNoUnstableMotorInside)
{
    const Motor nominal = shipped().drive.motor;
    const auto  radius  = [&](double from, double to) {
        return [&nominal, from, to](const Motor &m) {
            const double J = m.inertia_kgm2 / nominal.inertia_kgm2;
            return J > from && J < to ? 1.1 : 0.9;
        };
    };
    const double low = std::pow(0.5, 0.27); // of the share 0.27; 0.83 to 0.77: 0.27 .. 0.38
    for (const auto &box : {sdre::robust_box(nominal, radius(0.77, low)),
                            sdre::robust_alone(nominal, radius(0.77, low))}) {
        EXPECT_LE(box.share, 0.27);
        EXPECT_GT(box.share, 0.25);
        EXPECT_NE(box.corner.find("J x0.8"), std::string::npos) << box.corner;
    }
    // Two of them: the inner one counts, also when bisection finds the outer one.
    const auto two = [&](const Motor &m) {
        return std::max(radius(0.77, low)(m), radius(0.0, std::pow(0.5, 0.8))(m));
    };
    EXPECT_NEAR(sdre::robust_box(nominal, two).share, 0.26, 0.01);
    EXPECT_EQ(sdre::robust_box(nominal, radius(2.0, 1.0)).share, 1.0);
    EXPECT_EQ(sdre::robust_box(nominal, radius(2.0, 1.0)).corner, "");
}
