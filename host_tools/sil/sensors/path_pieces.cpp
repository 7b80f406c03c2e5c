// SPDX-License-Identifier: MIT
#include "sil/sensors/path_pieces.hpp"

#include <algorithm>
#include <array>

namespace sdre {
namespace {

/// Where the shaft turns around inside a step: at most two places, in order.
std::vector<double> turns_of(const Slope &f)
{
    std::vector<double> found;
    const double        root2 = f.b * f.b - 4.0 * f.a * f.c;
    if (root2 <= 0.0) {
        return found;
    }
    // Without cancellation: one root by the sum, the other from their product.
    const double q = -0.5 * (f.b + std::copysign(std::sqrt(root2), f.b));
    for (const std::array<double, 2> &part : {std::array{q, f.a}, std::array{f.c, q}}) {
        const double s = part[0] / part[1];
        if (s > 0.0 && s < 1.0) {
            found.push_back(s);
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace

std::vector<PathPiece> pieces_of(const ShaftPath &path)
{
    std::vector<PathPiece> pieces;
    const auto            &points = path.points();
    // One for each step, and as a rule at most one place where it turns around.
    pieces.reserve(points.size() + 1);
    for (std::size_t n = 1; n < points.size(); n++) {
        double from = 0.0;
        for (const double turn : turns_of(slope_of(points[n - 1], points[n]))) {
            pieces.push_back({points[n - 1], points[n], from, turn});
            from = turn;
        }
        pieces.push_back({points[n - 1], points[n], from, 1.0});
    }
    return pieces;
}

} // namespace sdre
