// SPDX-License-Identifier: MIT
#include "design/robust_box.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "common/parallel.hpp"

namespace sdre {
namespace {

struct Factors {
    double R, L, flux, J;
};

constexpr double accuracy = 0.01;
constexpr double grid     = 0.1; // chosen: of the share

/// The motors at a share of the box.
using Motors = std::vector<Factors> (*)(double share);

double low(double share)
{
    return std::pow(0.5, share);
}

double high(double share)
{
    return std::pow(1.5, share);
}

double high_inertia(double share)
{
    return std::pow(3.0, share);
}

std::vector<Factors> all_corners(double s)
{
    std::vector<Factors> corners;
    for (const double R : {low(s), high(s)}) {
        for (const double L : {low(s), high(s)}) {
            for (const double flux : {low(s), high(s)}) {
                for (const double J : {low(s), high_inertia(s)}) {
                    corners.push_back({R, L, flux, J});
                }
            }
        }
    }
    return corners;
}

std::vector<Factors> one_at_a_time(double s)
{
    return {{low(s), 1.0, 1.0, 1.0},  {high(s), 1.0, 1.0, 1.0},        {1.0, low(s), 1.0, 1.0},
            {1.0, high(s), 1.0, 1.0}, {1.0, 1.0, low(s), 1.0},         {1.0, 1.0, high(s), 1.0},
            {1.0, 1.0, 1.0, low(s)},  {1.0, 1.0, 1.0, high_inertia(s)}};
}

Motor with(Motor m, const Factors &f)
{
    m.stator_resistance_Ohm *= f.R;
    m.d_axis_inductance_H *= f.L;
    m.q_axis_inductance_H *= f.L;
    m.pm_flux_Wb *= f.flux;
    m.inertia_kgm2 *= f.J;
    return m;
}

/// Radius of the worst motor, and its name.
double worst_of(const std::vector<Factors> &factors, const Motor &motor, const MotorRadius &radius,
                std::string *name = nullptr)
{
    std::vector<double> found(factors.size());
    parallel_for(found.size(), [&](std::size_t k) { found[k] = radius(with(motor, factors[k])); });
    const auto worst = std::max_element(found.begin(), found.end());
    if (name != nullptr) {
        const Factors &f = factors[static_cast<std::size_t>(worst - found.begin())];
        *name = fmt::format("R x{:.2f}, L x{:.2f}, flux x{:.2f}, J x{:.2f}", f.R, f.L, f.flux, f.J);
    }
    return *worst;
}

/// A stable share and an unstable one above it.
struct Edge {
    double stable;
    double unstable;
};

Edge bisected(Edge e, Motors motors, const Motor &motor, const MotorRadius &radius)
{
    while (e.unstable - e.stable > accuracy) {
        const double middle = 0.5 * (e.stable + e.unstable);
        (worst_of(motors(middle), motor, radius) < 1.0 ? e.stable : e.unstable) = middle;
    }
    return e;
}

/// The least unstable share of a grid below this one, if there is any.
std::optional<double> unstable_below(double share, Motors motors, const Motor &motor,
                                     const MotorRadius &radius)
{
    for (int k = 1; k * grid < share; k++) {
        if (!(worst_of(motors(k * grid), motor, radius) < 1.0)) {
            return k * grid;
        }
    }
    return {};
}

/// Stability need not fall with the share: what the bisection finds is looked at on a grid.
RobustBox largest_share(Motors motors, const Motor &motor, const MotorRadius &radius)
{
    const bool whole = worst_of(motors(1.0), motor, radius) < 1.0;
    Edge       edge  = whole ? Edge{1.0, 1.0} : bisected({0.0, 1.0}, motors, motor, radius);
    std::optional<double> below;
    while ((below = unstable_below(edge.stable, motors, motor, radius))) {
        edge = bisected({*below - grid, *below}, motors, motor, radius);
    }
    RobustBox box;
    box.share = edge.stable;
    if (edge.stable < 1.0) {
        worst_of(motors(edge.unstable), motor, radius, &box.corner);
    }
    return box;
}

} // namespace

RobustBox robust_box(const Motor &motor, const MotorRadius &radius)
{
    return largest_share(all_corners, motor, radius);
}

RobustBox robust_alone(const Motor &motor, const MotorRadius &radius)
{
    return largest_share(one_at_a_time, motor, radius);
}

} // namespace sdre
