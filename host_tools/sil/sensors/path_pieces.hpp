// SPDX-License-Identifier: MIT
/// A shaft's path cut into pieces in which it turns one way.
#pragma once

#include <cmath>
#include <vector>

#include "sil/plant/shaft_path.hpp"

namespace sdre {

/// A part of one step of the path: the cubic between two points, over from .. to of its length 1.
struct PathPiece {
    ShaftPath::Point a;
    ShaftPath::Point b;
    double           from = 0.0;
    double           to   = 1.0;

    double theta_e_rad(double share) const;
    double time_s(double share) const
    {
        return a.time_s + share * (b.time_s - a.time_s);
    }
};

/// In the order of time.
std::vector<PathPiece> pieces_of(const ShaftPath &path);

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
    // Regula falsi that halves the value of an end that stays (Illinois). Measured: 3 passes where the speed hardly
    // changes.
    for (int n = 0; n < 60 && at_lo != at_hi; n++) {
        const double before     = found;
        found                   = lo + (hi - lo) * at_lo / (at_lo - at_hi);
        const double at_found   = quantity(found);
        const bool   upper      = (at_found > 0.0) == (at_hi > 0.0);
        (upper ? hi : lo)       = found;
        (upper ? at_hi : at_lo) = at_found;
        (upper ? at_lo : at_hi) *= 0.5;
        if (at_found == 0.0 || (n > 0 && std::abs(found - before) <= enough)) {
            break;
        }
    }
    return found;
}

} // namespace sdre
