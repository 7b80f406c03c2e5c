// SPDX-License-Identifier: MIT
/// The firmware's constants, derived from a design.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// Chosen: the flux-weakening range of the shipped motors ends below twice the rated speed.
constexpr double trip_speed_ratio = 3.0;

/// Rounds to single precision and adds the limits of the reference path and of the fault detection.
drive_config_t firmware_config(const Design &design);

/// Appends a failure for every constant that the firmware would refuse (not finite in single precision,
/// outside its documented range).
void add_firmware_failures(const drive_config_t &config, Certificate &certificate);

} // namespace sdre
