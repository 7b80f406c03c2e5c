// SPDX-License-Identifier: MIT
/// Weights of positions that go with those of the speed.
#pragma once

#include <optional>
#include <string>

#include "drive/drive_file.hpp"

namespace sdre {

/// Whether speed, currents and voltages have the weights of [nosc], so that a change of those is one of these.
bool follows_speed(const Drive &drive);

/// The drive with positions: the weights of [nosc], and of the angle as `before` in relation to the speed's. That one is halved until the
/// certificate passes, eight times at most.
Drive with_position(Drive drive, const PositionSpec &before);

/// The same from the weights of the speed alone, with the angle's in relation to the speed's as on ipmsm_390w, in the motor's own units.
/// Without a value where no angle weight is certified.
std::optional<PositionSpec> start_position(const Drive &drive);

/// [position] of a drive file.
std::string position_text(const PositionSpec &position);

} // namespace sdre
