// SPDX-License-Identifier: MIT
#include "tune/position_weights.hpp"

#include "common/errors.hpp"
#include "design/design.hpp"
#include "tune/objective.hpp"

namespace sdre {
namespace {

constexpr int most_halvings = 8; // chosen: the angle is held with a sixteenth of the stiffness

bool is_certified(const Drive &drive)
{
    try {
        return design_drive(drive).certificate.passed();
    } catch (const DesignError &) {
        return false;
    }
}

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
