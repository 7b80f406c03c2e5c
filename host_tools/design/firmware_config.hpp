// SPDX-License-Identifier: MIT
/// The part of the firmware's constants that no law changes.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// Motor, inverter, limits of the fault detection, in single precision; law and its constants are left out.
drive_config_t common_config(const Design &design);

} // namespace sdre
