// SPDX-License-Identifier: MIT
#include "tune/position_weights.hpp"

#include "tune/objective.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {
namespace {

constexpr int most_halvings = 8; // chosen: the angle is held with a sixteenth of the stiffness

} // namespace

Drive with_position(Drive drive, const PositionSpec &before)
{
    const NoscSpec &c = drive.nosc;
    double          q = before.Q[0] / before.Q[1] * c.Q[0];
    for (int i = 0; i <= most_halvings; i++, q *= 0.5) {
        drive.position = {{written(q), c.Q[0], c.Q[1], c.Q[2]}, c.T};
        if (is_certified(drive)) {
            break;
        }
    }
    return drive;
}

} // namespace sdre
