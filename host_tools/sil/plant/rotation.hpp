// SPDX-License-Identifier: MIT
/// Rotations between the stator's and the rotor's frame.
#pragma once

#include <cmath>

#include "sil/plant/vectors.hpp"

namespace sdre {

/// Cosine and sine of an angle.
struct Rotation {
    double cos = 1.0;
    double sin = 0.0;
};

inline Rotation rotation_by(double angle_rad)
{
    return {std::cos(angle_rad), std::sin(angle_rad)};
}

constexpr double series_bound_rad = 0.1;

/// Taylor to the 7th power. Its error at the bound is 0.1^8 / 8! = 2.5e-13.
inline Rotation series_rotation(double x)
{
    constexpr double c2 = 1.0 / 2.0;
    constexpr double c3 = 1.0 / 6.0;
    constexpr double c4 = 1.0 / 24.0;
    constexpr double c5 = 1.0 / 120.0;
    constexpr double c6 = 1.0 / 720.0;
    constexpr double c7 = 1.0 / 5040.0;
    const double     y  = x * x;
    return {1.0 - y * (c2 - y * (c4 - y * c6)), x * (1.0 - y * (c3 - y * (c5 - y * c7)))};
}

/// Beyond the bound of the series the library is asked.
inline Rotation small_rotation(double x)
{
    return std::abs(x) > series_bound_rad ? rotation_by(x) : series_rotation(x);
}

/// One rotation after another. One Newton step of 1/sqrt keeps the length at one over many of them.
inline Rotation turned(Rotation from, Rotation by)
{
    const double c      = from.cos * by.cos - from.sin * by.sin;
    const double s      = from.sin * by.cos + from.cos * by.sin;
    const double length = 1.5 - 0.5 * (c * c + s * s);
    return {length * c, length * s};
}

/// A vector seen from a frame that is turned by r.
inline RotorVector seen_from(Rotation r, double x, double y)
{
    return {r.cos * x + r.sin * y, r.cos * y - r.sin * x};
}

inline RotorVector to_rotor(StatorVector v, Rotation r)
{
    return seen_from(r, v.alpha, v.beta);
}

inline StatorVector to_stator(RotorVector v, Rotation r)
{
    return {r.cos * v.d - r.sin * v.q, r.sin * v.d + r.cos * v.q};
}

/// Amplitude-invariant rotation by the electrical angle.
inline RotorVector to_rotor(StatorVector v, double theta_e_rad)
{
    return to_rotor(v, rotation_by(theta_e_rad));
}

inline StatorVector to_stator(RotorVector v, double theta_e_rad)
{
    return to_stator(v, rotation_by(theta_e_rad));
}

} // namespace sdre
