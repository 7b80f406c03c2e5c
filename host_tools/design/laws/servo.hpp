// SPDX-License-Identifier: MIT
/// Common part of the designs of paper B's laws.
#pragma once

#include "design/laws/laws.hpp"

namespace sdre {

/// The PI that keeps id at zero.
pid_law_config_t d_axis_constants(const Drive &drive);

/// Checks the loops with the constants that the configuration has by now.
void certify_servo(Design &design);

/// Method, then a line for each loop.
std::string servo_summary(const Design &design, const std::string &method);

} // namespace sdre
