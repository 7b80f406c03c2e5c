// SPDX-License-Identifier: MIT
/// Weights of positions that go with those of the speed.
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

/// The drive with positions: the weights of [nosc], and of the angle as `before` in relation to the speed's. That one is halved until the
/// certificate passes, eight times at most.
Drive with_position(Drive drive, const PositionSpec &before);

} // namespace sdre
