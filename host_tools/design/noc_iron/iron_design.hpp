// SPDX-License-Identifier: MIT
/// The table of a saturated motor for the firmware (EQ-IRON-1).
#pragma once

#include "drive/core_types.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

/// The table of a motor with this iron has evenly spaced nodes up to the current limit.
iron_map_t iron_table(const Motor &motor, const SaturatedMotor &iron);

/// Largest difference of the table's flux linkages from the map within the current circle, as a share of the largest flux.
double iron_table_error(const Drive &drive, const iron_map_t &table);

} // namespace sdre
