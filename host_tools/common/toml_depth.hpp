// SPDX-License-Identifier: MIT
/// How deep a TOML text nests, before a parser that recurses sees it.
#pragma once

#include <string>

namespace sdre {

/// Deepest nesting of tables and arrays that is read. Chosen: the deepest file here has 3.
constexpr int toml_depth_max = 32;

/// Line in which a key, its tables and arrays nest deeper than that; 0: none. Text that is not TOML may be counted
/// too deep, never too shallow.
long too_deep_line(const std::string &text);

} // namespace sdre
