// SPDX-License-Identifier: MIT
/// The part of the firmware's constants that no law changes.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// What the file says, or up to the trip; without anything that takes energy back, up to where the EMF reaches the dc link's
/// trip level.
double largest_command_e_radps(const Drive &drive);

/// Motor, inverter, limits of the fault detection, in single precision; law and its constants are left out.
drive_config_t common_config(const Design &design);

} // namespace sdre
