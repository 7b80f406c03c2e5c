// SPDX-License-Identifier: MIT
/// What `sdre-gains report` prints.
#pragma once

#include <string>

#include "design/design.hpp"

namespace sdre {

/// One JSON object; keys in docs/architecture.md.
std::string report_json(const Design &design);

/// The same for a person.
std::string report_text(const Design &design);

} // namespace sdre
