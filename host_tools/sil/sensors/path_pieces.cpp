// SPDX-License-Identifier: MIT
#include "sil/sensors/path_pieces.hpp"

#include <utility>

namespace sdre {
namespace {

/// Where the shaft turns around inside a step: at most two places, in order.
struct Turns {
    std::array<double, 2> at;
    std::size_t           count = 0;
};

Turns turns_of(const Slope &f)
{
    Turns        found;
    const double root2 = f.b * f.b - 4.0 * f.a * f.c;
    if (root2 <= 0.0) {
        return found;
    }
    // Without cancellation: one root by the sum, the other from their product.
    const double q = -0.5 * (f.b + std::copysign(std::sqrt(root2), f.b));
    for (const double s : {q / f.a, f.c / q}) {
        if (s > 0.0 && s < 1.0) {
            found.at[found.count++] = s;
        }
    }
    if (found.count == 2 && found.at[1] < found.at[0]) {
        std::swap(found.at[0], found.at[1]);
    }
    return found;
}

} // namespace

StepPieces pieces_of(const ShaftPath::Point &p, const ShaftPath::Point &q)
{
    StepPieces  pieces;
    double      from  = 0.0;
    const Turns turns = turns_of(slope_of(p, q));
    for (std::size_t n = 0; n < turns.count; n++) {
        pieces.piece[pieces.count++] = {p, q, from, turns.at[n]};
        from                         = turns.at[n];
    }
    pieces.piece[pieces.count++] = {p, q, from, 1.0};
    return pieces;
}

} // namespace sdre
