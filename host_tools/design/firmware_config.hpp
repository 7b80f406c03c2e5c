// SPDX-License-Identifier: MIT
/// The part of the firmware's constants that no law changes.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// Largest command [rad/s electrical]: that of the drive file, else the trip speed. Without a sink
/// for returned energy, it is at most the speed at which the EMF reaches the dc link's trip level.
double largest_command_e_radps(const Drive &drive);

/// Motor, inverter, limits of the fault detection, in single precision; law and its constants are left out.
drive_config_t common_config(const Design &design);

} // namespace sdre
