// SPDX-License-Identifier: MIT
/// The part of the report with the torques of a drive, and with what no drive beats.
#pragma once

#include <string>

#include "common/json.hpp"
#include "design/design.hpp"

namespace sdre {

/// The text and the keys are those of a design with torques.
std::string torque_text(const Design &design);
Json        torque_json(const Design &design);

} // namespace sdre
