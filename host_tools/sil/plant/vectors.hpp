// SPDX-License-Identifier: MIT
/// Vectors of the plant, in double precision.
#pragma once

#include <array>
#include <cmath>

namespace sdre {

struct RotorVector {
    double d = 0.0;
    double q = 0.0;
};

struct StatorVector {
    double alpha = 0.0;
    double beta  = 0.0;
};

struct PhaseVector {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
};

inline std::array<double, 3> as_array(const PhaseVector &x)
{
    return {x.a, x.b, x.c};
}

/// Amplitude-invariant.
inline StatorVector clarke(const std::array<double, 3> &x)
{
    static const double inv_sqrt3 = 1.0 / std::sqrt(3.0);
    return {(2.0 * x[0] - x[1] - x[2]) / 3.0, (x[1] - x[2]) * inv_sqrt3};
}

/// Without zero sequence.
inline PhaseVector phases_of(StatorVector x)
{
    static const double half_sqrt3 = 0.5 * std::sqrt(3.0);
    const double        half_beta  = half_sqrt3 * x.beta;
    return {x.alpha, half_beta - 0.5 * x.alpha, -half_beta - 0.5 * x.alpha};
}

} // namespace sdre
