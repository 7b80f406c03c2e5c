// SPDX-License-Identifier: MIT
/// Limit and home switches of the axis that the motor turns.
#pragma once

#include <optional>
#include <utility>

namespace sdre {

/// Places in turns of the motor from the index mark; none: the input is open, and reads as active.
struct AxisSwitches {
    std::optional<double>                    negative; ///< active at and below
    std::optional<double>                    positive; ///< active at and above
    std::optional<std::pair<double, double>> home;     ///< active from .. to
};

} // namespace sdre
