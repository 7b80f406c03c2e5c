// SPDX-License-Identifier: MIT
/// The matrices of EQ-CERT-3 for whoever wants to show more of the sampled loop than its verdict does.
#pragma once

#include <string>

#include "design/design.hpp"

namespace sdre {

/// One JSON object with the parts of the controller at every point of speed and current. It also
/// has the whole loop with the nominal motor. Keys: docs/files.md. InputError for any law but noc
/// with an observer in its encoder form.
std::string loops_json(const Design &design);

} // namespace sdre
