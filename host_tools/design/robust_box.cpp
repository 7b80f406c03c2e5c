// SPDX-License-Identifier: MIT
#include "design/robust_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/parallel.hpp"

namespace sdre {
namespace {

struct Factors {
    double R, L, flux, J;
};

constexpr std::size_t corners  = 16;
constexpr double      accuracy = 0.01;

Factors factors_of(std::size_t corner, double share)
{
    const auto end = [&](std::size_t bit, double low, double high) {
        return std::pow((corner >> bit & 1U) == 0U ? low : high, share);
    };
    return {end(0, 0.5, 1.5), end(1, 0.5, 1.5), end(2, 0.5, 1.5), end(3, 0.5, 3.0)};
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

} // namespace

double worst_corner(const Motor &motor, const MotorRadius &radius, double share,
                    std::string *corner)
{
    std::array<double, corners> found{};
    parallel_for(corners, [&](std::size_t k) {
        found[k] = radius(reduced_parameters(with(motor, factors_of(k, share))));
    });
    const auto worst = std::max_element(found.begin(), found.end());
    if (corner != nullptr) {
        const Factors f = factors_of(static_cast<std::size_t>(worst - found.begin()), share);
        *corner =
            fmt::format("R x{:.2f}, L x{:.2f}, flux x{:.2f}, J x{:.2f}", f.R, f.L, f.flux, f.J);
    }
    return *worst;
}

RobustBox robust_box(const Motor &motor, const MotorRadius &radius)
{
    if (worst_corner(motor, radius, 1.0) < 1.0) {
        return {1.0, ""};
    }
    double stable   = 0.0;
    double unstable = 1.0;
    while (unstable - stable > accuracy) {
        const double middle                                             = 0.5 * (stable + unstable);
        (worst_corner(motor, radius, middle) < 1.0 ? stable : unstable) = middle;
    }
    RobustBox box;
    box.share = stable;
    worst_corner(motor, radius, unstable, &box.corner);
    return box;
}

} // namespace sdre
