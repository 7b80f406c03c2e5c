// SPDX-License-Identifier: MIT
/// A shaft's path cut into pieces in which it turns one way.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "sil/plant/shaft_path.hpp"

namespace sdre {

/// Slope of the cubic over its length 1: c + s (b + s a).
struct Slope {
    double a;
    double b;
    double c;
};

inline Slope slope_of(const ShaftPath::Point &p, const ShaftPath::Point &q)
{
    const double h    = q.time_s - p.time_s;
    const double turn = q.theta_e_rad - p.theta_e_rad;
    const double v    = h * p.omega_e_radps;
    const double w    = h * q.omega_e_radps;
    return {3.0 * (v + w - 2.0 * turn), 2.0 * (3.0 * turn - 2.0 * v - w), v};
}

/// A part of one step of the path: the cubic between two points, over from .. to of its length 1.
struct PathPiece {
    ShaftPath::Point a;
    ShaftPath::Point b;
    double           from = 0.0;
    double           to   = 1.0;

    double theta_e_rad(double s) const
    {
        if (s == 0.0 || s == 1.0) { // to the bit, so that pieces meet
            return s == 0.0 ? a.theta_e_rad : b.theta_e_rad;
        }
        const Slope f =
            slope_of(a, b); // inline: once for all places of a piece, a sixth of a run's time
        return a.theta_e_rad + s * (f.c + s * (0.5 * f.b + s * f.a / 3.0));
    }
    double time_s(double share) const
    {
        return a.time_s + share * (b.time_s - a.time_s);
    }
};

/// The pieces of one step, in the order of time: the shaft turns around at most twice.
struct StepPieces {
    std::array<PathPiece, 3> piece;
    std::size_t              count = 0;
};

/// Between two neighbouring points of a path.
StepPieces pieces_of(const ShaftPath::Point &p, const ShaftPath::Point &q);

/// The share of the piece at which a quantity that rises or falls over it is zero; it is not at its ends alike.
template <typename Quantity> double zero_of(const PathPiece &piece, const Quantity &quantity)
{
    // Far below the resolution of any timer: of a step of at most 100 us.
    constexpr double enough = 1e-12;
    double           lo     = piece.from;
    double           hi     = piece.to;
    double           at_lo  = quantity(lo);
    double           at_hi  = quantity(hi);
    double           found  = hi;
    // Regula falsi that halves the value of an end that stays twice (Illinois). Measured: 6 values of the quantity with
    // those of the ends, 9 at most.
    int stayed = 0; // -1: lo has stayed, 1: hi
    for (int n = 0; n < 60 && at_lo != at_hi; n++) {
        const double before     = found;
        found                   = lo + (hi - lo) * at_lo / (at_lo - at_hi);
        const double at_found   = quantity(found);
        const bool   upper      = (at_found > 0.0) == (at_hi > 0.0);
        (upper ? hi : lo)       = found;
        (upper ? at_hi : at_lo) = at_found;
        if (stayed == (upper ? -1 : 1)) {
            (upper ? at_lo : at_hi) *= 0.5;
        }
        stayed = upper ? -1 : 1;
        if (at_found == 0.0 || (n > 0 && std::abs(found - before) <= enough)) {
            break;
        }
    }
    return found;
}

} // namespace sdre
