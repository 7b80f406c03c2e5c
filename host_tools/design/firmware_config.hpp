// SPDX-License-Identifier: MIT
/// The part of the firmware's constants that no law changes.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// Chosen: the flux-weakening range of the shipped motors ends below twice the rated speed.
constexpr double trip_speed_ratio = 3.0;

/// Motor, inverter, limits of the fault detection, in single precision; law and its constants are left out.
drive_config_t common_config(const Design &design);

} // namespace sdre
