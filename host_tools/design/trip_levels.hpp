// SPDX-License-Identifier: MIT
/// The levels at which a drive opens its bridge, and the largest speed command below them.
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

/// Over-current level of a phase.
double trip_current_A(const Drive &drive);

/// Accepted dc link.
double trip_dc_link_min_V(const Drive &drive);
double trip_dc_link_max_V(const Drive &drive);

/// The power that the motor may feed back is full below `start_V` and nothing above `end_V` (EQ-CURRENT-REF-7).
struct RegenerationLimit {
    double start_V;
    double end_V;
};

/// With `regeneration = "brake_chopper"` and a chopper of the board, it begins where the chopper is on.
RegenerationLimit regeneration_limit(const Drive &drive);

/// Largest command [rad/s electrical]: that of the drive file, else the trip speed. Without a sink
/// for returned energy, it is at most the speed at which the EMF reaches the dc link's trip level.
double largest_command_e_radps(const Drive &drive);

} // namespace sdre
