// SPDX-License-Identifier: MIT
#include "design/shaft_model.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/parallel.hpp"
#include "design/design.hpp"
#include "design/law_design.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/noc_shaft/shaft_loop.hpp"
#include "design/verdict.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;

constexpr double grid_ratio = 1.03;
// Chosen: a mode that doubles in 140 periods is as far off as half of the allowed margin.
constexpr double excess_per_radius = 200.0;
constexpr double two_pi            = 6.283185307179586;

struct Found {
    double         radius = 0.0;
    OperatingPoint at;
};

std::vector<OperatingPoint> points_of(const TwoMasses &masses, const Drive &drive)
{
    std::vector<OperatingPoint> points{masses.point(0.0, 0.0)};
    for (const double speed : {0.5, 1.0}) {
        for (const double share : {1.0, -1.0}) {
            points.push_back(masses.point(speed * drive.motor.rated_speed_e_radps, share));
        }
    }
    return points;
}

Found worst_with(const Design &d, const TwoMasses &masses,
                 const std::vector<OperatingPoint> &points, const Shaft &shaft)
{
    Found worst;
    for (const OperatingPoint &at : points) {
        for (const MatrixXd &Lambda : feedback_gains(d)) {
            const SampledModel loop =
                masses.loop(shaft, at, encoder_form_gains(d, at.iq_A, Lambda));
            const double radius = spectral_radius(loop.A);
            if (!(radius <= worst.radius)) {
                worst = {radius, at};
            }
        }
    }
    return worst;
}

/// Neighbours of one resonance after another; `radius` is the largest of each.
std::vector<ResonanceRange> stable_ranges(const std::vector<double> &resonances_Hz,
                                          const std::vector<double> &radius)
{
    std::vector<ResonanceRange> ranges;
    bool                        before = false;
    for (std::size_t i = 0; i < radius.size(); i++) {
        const bool stable = radius[i] < 1.0;
        if (stable && !before) {
            ranges.push_back({resonances_Hz[i], resonances_Hz[i]});
        } else if (stable) {
            ranges.back().to_Hz = resonances_Hz[i];
        }
        before = stable;
    }
    return ranges;
}

} // namespace

HeldPlant held_with_shaft(const TrueMotor &motor, const OperatingPoint &at, double ts,
                          const Shaft &shaft)
{
    const double s      = shaft.load_inertia_share;
    const double w_r    = two_pi * shaft.resonance_Hz;
    const double spring = w_r * w_r; // stiffness over the reduced inertia s (1 - s) J
    const double drag   = 2.0 * shaft.damping * w_r;

    MatrixXd A          = MatrixXd::Zero(6, 6);
    MatrixXd B          = MatrixXd::Zero(6, 3);
    A.block(0, 0, 3, 3) = motor.jacobian(at);
    A.row(0) /= 1.0 - s;
    A(0, 0) -= s * drag;
    A(0, 4)             = s * drag;
    A(0, 5)             = -s * spring;
    A(3, 0)             = 1.0;
    A(4, 0)             = (1.0 - s) * drag;
    A(4, 4)             = -(1.0 - s) * drag;
    A(4, 5)             = (1.0 - s) * spring;
    A(5, 0)             = 1.0;
    A(5, 4)             = -1.0;
    B.block(0, 0, 3, 2) = motor.input(at);
    B(4, 2)             = motor.load() / s;
    return {c2d(A, B, ts), at, ts};
}

TwoMasses::TwoMasses(const Design &d)
    : design_(d), motor_(true_motor(d.drive, d.drive.motor)), model_(d.l),
      references_(id_reference(d, current_ref_constants(d, true)))
{
}

OperatingPoint TwoMasses::point(double speed_e_radps, double share) const
{
    return loaded_point(references_, motor_, model_, speed_e_radps, share);
}

SampledModel TwoMasses::loop(const Shaft &shaft, const OperatingPoint &at,
                             const LoopGains &gains) const
{
    const MovingReference moving =
        moving_reference(references_, model_, gains.Lambda, state_at(motor_, model_, at));
    if (law_design(design_.drive).shaft_states) {
        return sampled_shaft_model(design_, motor_, shaft, at, gains, &moving);
    }
    return closed_loop(held_with_shaft(motor_, at, references_.ts_s, shaft), model_, gains,
                       &moving);
}

std::vector<Shaft> shafts_of(const Mechanics &m, double ratio)
{
    std::vector<Shaft> shafts;
    if (m.coupling == Coupling::rigid) {
        return shafts;
    }
    std::vector<double> dampings{m.least_damping};
    if (m.most_damping > m.least_damping) {
        dampings.push_back(m.most_damping);
    }
    const int points = static_cast<int>(std::ceil(std::log(m.to_Hz / m.from_Hz) / std::log(ratio)));
    for (int i = 0; i <= points; i++) {
        const double f = m.from_Hz * std::pow(m.to_Hz / m.from_Hz, double(i) / points);
        for (const double damping : dampings) {
            shafts.push_back({f, damping, m.load_inertia_share});
        }
    }
    return shafts;
}

ShaftVerdict examine_shaft(const Design &d)
{
    const std::vector<Shaft> shafts = shafts_of(d.drive.mechanics, grid_ratio);
    const TwoMasses          masses(d);
    const auto               points = points_of(masses, d.drive);
    std::vector<Found>       found(shafts.size());
    parallel_for(shafts.size(),
                 [&](std::size_t i) { found[i] = worst_with(d, masses, points, shafts[i]); });

    ShaftVerdict v;
    v.mechanics = d.drive.mechanics;
    std::vector<double> resonances_Hz;
    std::vector<double> radius;
    for (std::size_t i = 0; i < shafts.size(); i++) {
        if (resonances_Hz.empty() || shafts[i].resonance_Hz != resonances_Hz.back()) {
            resonances_Hz.push_back(shafts[i].resonance_Hz);
            radius.push_back(0.0);
        }
        radius.back() = std::max(radius.back(), found[i].radius);
        if (found[i].radius > v.radius) {
            v.radius   = found[i].radius;
            v.worst    = shafts[i];
            v.worst_at = found[i].at;
        }
    }
    v.stable = stable_ranges(resonances_Hz, radius);
    return v;
}

void certify_shaft(Design &d)
{
    if (d.drive.mechanics.coupling == Coupling::rigid) {
        return;
    }
    d.certificate.loop->shaft = examine_shaft(d);
    const ShaftVerdict &v     = *d.certificate.loop->shaft;
    if (!v.everywhere()) {
        d.certificate.failures.push_back(fmt::format("elastic shaft: {}", shaft_words(v)));
    }
}

double shaft_excess(const ShaftVerdict &v)
{
    return 1.0 + excess_per_radius * (v.radius - 1.0);
}

std::string shaft_words(const ShaftVerdict &v)
{
    const Mechanics  &m = v.mechanics;
    const std::string looked_at =
        fmt::format("{:.0f} .. {:.0f} Hz, damping ratio {:g} .. {:g}, {:g} of the inertia behind",
                    m.from_Hz, m.to_Hz, m.least_damping, m.most_damping, m.load_inertia_share);
    if (v.everywhere()) {
        return fmt::format("stable with every resonance of {}", looked_at);
    }
    std::vector<std::string> ranges;
    for (const ResonanceRange &r : v.stable) {
        ranges.push_back(fmt::format("{:.0f} .. {:.0f} Hz", r.from_Hz, r.to_Hz));
    }
    return fmt::format(
        "unstable with a resonance of {:.0f} Hz, damping ratio {:.2g}, at {:.0f} "
        "rad/s, iq {:.2f} A (spectral radius {:.4f}); stable with {} of {}",
        v.worst.resonance_Hz, v.worst.damping, v.worst_at.omega_e_radps, v.worst_at.iq_A, v.radius,
        ranges.empty() ? "none" : fmt::format("{}", fmt::join(ranges, ", ")), looked_at);
}

} // namespace sdre
