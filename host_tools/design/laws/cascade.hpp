// SPDX-License-Identifier: MIT
/// Common part of the designs of the laws around current loops.
#pragma once

#include "design/laws/laws.hpp"

namespace sdre {

/// Current loops where a search of rivals starts, as shares of the sampling rate.
constexpr double start_bandwidth = 0.05;
constexpr double start_1ps       = 2.0 * 3.14159265358979 * start_bandwidth;

/// Checks the loops with the constants that the configuration has by now.
void certify_cascade(Design &design);

/// Method, then a line for each loop.
std::string cascade_summary(const Design &design, const std::string &method);

/// ".gains = {..},\n", a block for each way to measure the speed.
Layout gains_layout(const drive_config_t &config);

} // namespace sdre
