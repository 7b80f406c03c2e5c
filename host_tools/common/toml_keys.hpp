// SPDX-License-Identifier: MIT
/// Values of a TOML table that stand at the end of a path of keys.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

namespace sdre {

/// Keys from the top of the file, a number where a key holds an array of tables.
using KeyPath = std::vector<std::string>;

/// The table that holds the path's last key; tables that are missing are made, entries of arrays are not. InputError,
/// which begins with `source`, when the path leads nowhere.
toml::table &table_of(toml::table &root, const KeyPath &path, const std::string &source);

} // namespace sdre
