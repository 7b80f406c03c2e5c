// SPDX-License-Identifier: MIT
/// The metrics of a run by name: a scenario names them for published values.
#pragma once

#include <string>
#include <vector>

namespace sdre {

/// In the order in which they are written.
const std::vector<std::string> &metric_names();

bool is_metric_name(const std::string &name);

} // namespace sdre
