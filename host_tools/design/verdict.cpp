// SPDX-License-Identifier: MIT
#include "design/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/parallel.hpp"
#include "design/design.hpp"
#include "design/sampled_model.hpp"

namespace sdre {
namespace {

// Chosen: eight counts in a period, where the observers of all laws use edges as they are. Below,
// an encoder has less information than any linear model assumes. A coarse encoder has that many beyond every command only.
constexpr double counts_that_tell = 8.0;

/// The larger one; NaN is larger than any number.
double worse(double a, double b)
{
    return a <= b || std::isnan(b) ? b : a;
}

/// Results at one point.
struct Found {
    double                 spectral_radius = 0.0;
    std::vector<LoopCheck> channels;
};

Found examine_point(const LoopFamily &family, const Drive &drive, const OperatingPoint &at)
{
    const std::vector<BrokenLoop> loops = family.loops(drive.motor, at);
    Found                         found;
    found.channels.resize(family.channels.size());
    for (std::size_t i = 0; i < loops.size(); i++) {
        LoopCheck  now        = check_loop(loops[i], disturbance_frequencies(drive));
        LoopCheck &kept       = found.channels[i % family.channels.size()];
        found.spectral_radius = std::max(found.spectral_radius, now.spectral_radius);
        const double radius   = std::max(kept.spectral_radius, now.spectral_radius);
        if (now.peak > kept.peak) {
            kept = std::move(now);
        }
        kept.spectral_radius = radius;
    }
    return found;
}

bool is_same(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
    return a.rows() == b.rows() && a == b;
}

double largest_radius(const std::vector<BrokenLoop> &loops)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < loops.size(); i++) {
        if (i == 0 || !is_same(loops[i].A, loops[i - 1].A)) { // most are one loop, opened elsewhere
            worst = std::max(worst, spectral_radius(loops[i]));
        }
    }
    return worst;
}

double radius_of(const LoopFamily &family, const Motor &motor)
{
    const auto &loops_at = family.loops_of_others ? family.loops_of_others : family.loops;
    double      worst    = 0.0;
    for (const OperatingPoint &at : family.box_points) {
        worst = std::max(worst, largest_radius(loops_at(motor, at)));
    }
    return worst;
}

void keep_worst(Verdict &v, const Found &found, const OperatingPoint &at)
{
    if (found.spectral_radius > v.spectral_radius) {
        v.spectral_radius = found.spectral_radius;
        v.radius_at       = at;
    }
    for (std::size_t c = 0; c < v.channels.size(); c++) {
        Channel     &kept = v.channels[c];
        const double radius =
            std::max(kept.worst.spectral_radius, found.channels[c].spectral_radius);
        if (found.channels[c].peak > kept.worst.peak) {
            kept.worst = found.channels[c];
            kept.at    = at;
        }
        kept.worst.spectral_radius = radius;
    }
}

/// Points of the plane with the largest spectral radius and the largest rough peak of each channel.
std::vector<OperatingPoint> worst_of_plane(const LoopFamily &family, const Drive &drive)
{
    if (family.plane.empty()) {
        return {};
    }
    const std::size_t                n = family.channels.size();
    std::vector<std::vector<double>> found(family.plane.size(), std::vector<double>(n + 1, 0.0));
    parallel_for(found.size(), [&](std::size_t i) {
        const std::vector<BrokenLoop> loops = family.loops(drive.motor, family.plane[i]);
        found[i][n]                         = largest_radius(loops);
        for (std::size_t k = 0; k < loops.size(); k++) {
            found[i][k % n] = std::max(found[i][k % n], rough_peak(loops[k]));
        }
    });
    std::vector<OperatingPoint> worst;
    for (std::size_t k = 0; k <= n; k++) {
        std::size_t most = 0;
        for (std::size_t i = 1; i < found.size(); i++) {
            most = found[i][k] > found[most][k] ? i : most;
        }
        worst.push_back(family.plane[most]);
    }
    return worst;
}

std::string point_name(const OperatingPoint &at)
{
    return fmt::format("{:.0f} rad/s, iq {:.2f} A, id {:.2f} A", at.omega_e_radps, at.iq_A,
                       at.id_A);
}

} // namespace

OperatingPoint held_point(const Design &d, double speed_e_radps, double iq_A)
{
    const Motor &m    = d.drive.motor;
    const double most = d.drive.inverter.dc_link_V / std::sqrt(3.0) /
                        std::max(std::abs(speed_e_radps), 1e-9); // flux linkage
    for (double share = 1.0; share > 0.0; share -= 0.02) {
        const double iq      = share * iq_A;
        const double id_mtpa = mtpa_id_A(d.l, iq);
        const double q_Wb    = m.q_axis_inductance_H * iq;
        const double d_Wb    = std::sqrt(std::max(most * most - q_Wb * q_Wb, 0.0));
        const double id_A    = std::min(id_mtpa, (d_Wb - m.pm_flux_Wb) / m.d_axis_inductance_H);
        const bool   held =
            std::abs(q_Wb) <= most && m.pm_flux_Wb + m.d_axis_inductance_H * id_A >= -d_Wb;
        if (held && std::hypot(iq, id_A) <= 1.001 * m.max_current_A) {
            return {speed_e_radps, iq, id_A};
        }
    }
    return {speed_e_radps, 0.0,
            std::clamp((most - m.pm_flux_Wb) / m.d_axis_inductance_H, -m.max_current_A, d.l[0])};
}

std::vector<OperatingPoint> verdict_points(const Design &d)
{
    const double                rated = d.drive.motor.rated_speed_e_radps;
    const double                top   = static_cast<double>(d.config.speed_max_e_radps);
    const double                most  = d.drive.motor.max_current_A;
    std::vector<OperatingPoint> points;
    for (const double speed : {0.0, rated, top}) {
        for (const double iq : {0.0, most, -most}) {
            points.push_back(held_point(d, speed, iq));
        }
    }
    return points;
}

std::vector<OperatingPoint> verdict_box_points(const Design &d)
{
    const double iq = d.drive.motor.max_current_A;
    const double slow =
        std::min(counts_that_tell * count_e_rad(d.drive) / control_period_s(d.drive),
                 static_cast<double>(d.config.speed_max_e_radps));
    std::vector<OperatingPoint> points{{slow, 0.0, mtpa_id_A(d.l, 0.0)}};
    const double                rated = d.drive.motor.rated_speed_e_radps;
    points.push_back(held_point(d, rated, iq));
    if (d.harmonics) { // their frequencies are multiples of the speed: each passes the crossover somewhere
        for (const double share : {0.25, 0.5, 0.75}) {
            points.push_back(held_point(d, share * rated, iq));
        }
    }
    return points;
}

std::vector<BrokenLoop> broken_at_voltages(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B,
                                           const Eigen::MatrixXd &C, double ts_s)
{
    return {{A, B.col(0), C.row(0), ts_s}, {A, B.col(1), C.row(1), ts_s}};
}

Verdict examine(const LoopFamily &family, const Drive &drive)
{
    std::vector<OperatingPoint> points = worst_of_plane(family, drive);
    points.insert(points.begin(), family.points.begin(), family.points.end());
    Verdict v;
    for (const std::string &name : family.channels) {
        v.channels.push_back({name, {}, {}});
    }
    std::vector<Found> found(points.size());
    parallel_for(found.size(),
                 [&](std::size_t i) { found[i] = examine_point(family, drive, points[i]); });
    for (std::size_t i = 0; i < found.size(); i++) {
        keep_worst(v, found[i], points[i]);
    }
    if (!family.box_points.empty()) {
        const auto radius = [&](const Motor &motor) { return radius_of(family, motor); };
        v.box             = robust_box(drive.motor, radius);
        v.alone           = robust_alone(drive.motor, radius);
    }
    return v;
}

double excess(const Verdict &v, double ts_s)
{
    // A spectral radius counts by its distance to 1, relative to the allowed one. An unstable loop
    // counts as far off.
    const double room  = -std::log(std::min(v.spectral_radius, 1.0)) * v.slowest_mode_s / ts_s;
    double       worst = 1.0 / std::max(room, 1e-3);
    for (const Channel &c : v.channels) {
        worst = worse(worst, c.worst.peak / peak_sensitivity_limit);
    }
    worst = v.box ? worse(worst, box_share_limit / std::max(v.box->share, 1e-3)) : worst;
    worst = v.alone ? worse(worst, alone_share_limit / std::max(v.alone->share, 1e-3)) : worst;
    for (const TripMargin &t : v.trips) {
        worst = worse(worst, t.healthy / t.limit);
    }
    worst = v.shaft ? worse(worst, shaft_excess(*v.shaft)) : worst;
    return worst;
}

namespace {

/// A figure of a loop that has none is no number.
std::string known(const char *format, double value)
{
    return std::isnan(value) ? "unknown" : fmt::format(fmt::runtime(format), value);
}

} // namespace

void judge(const Verdict &v, double ts_s, std::vector<std::string> &failures)
{
    const double largest = std::exp(-ts_s / v.slowest_mode_s);
    if (!(v.spectral_radius <= largest)) {
        failures.push_back(
            fmt::format("the loop does not settle at {}: spectral radius {}, at most "
                        "{:.6f} is allowed",
                        point_name(v.radius_at), known("{:.6f}", v.spectral_radius), largest));
    }
    for (const Channel &c : v.channels) {
        if (!(c.worst.peak <= peak_sensitivity_limit)) {
            failures.push_back(fmt::format("{}: sensitivity peak {} at {:.0f} Hz ({}) exceeds {:g}",
                                           c.name, known("{:.3g}", c.worst.peak), c.worst.peak_Hz,
                                           point_name(c.at), peak_sensitivity_limit));
        }
    }
    if (v.box && !(v.box->share >= box_share_limit)) {
        failures.push_back(fmt::format(
            "unstable with a motor of {}: {} of the box of parameters, {:g} is required",
            v.box->corner, known("{:.2f}", v.box->share), box_share_limit));
    }
    if (v.alone && !(v.alone->share >= alone_share_limit)) {
        failures.push_back(fmt::format("unstable with a motor of {}, everything else as believed",
                                       v.alone->corner));
    }
    for (const TripMargin &t : v.trips) {
        if (std::isnan(t.healthy)) {
            failures.push_back(fmt::format("{}: a healthy drive has no bound, as the loop does not "
                                           "settle; its trip is at {:.3g}",
                                           t.name, t.limit));
        } else if (!(t.healthy <= t.limit)) {
            failures.push_back(
                fmt::format("{}: a healthy drive reaches {:.3g}, its trip is at {:.3g}", t.name,
                            t.healthy, t.limit));
        }
    }
}

} // namespace sdre
