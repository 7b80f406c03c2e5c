// SPDX-License-Identifier: MIT
/// The result of a drive's commissioning. `sdre-drive commission` reads it over Modbus and writes
/// it as TOML.
#pragma once

#include <filesystem>

extern "C" {
#include "commission_types.h"
}

#include "facts/found_map.hpp"

namespace sdre {

struct Found {
    commission_result_t values{};
    FoundMap            map; ///< not measured by a drive that has no such registers
};

/// InputError in one line on anything missing, unknown or out of range. Values that a drive file
/// does not accept stay zero.
Found read_found_file(const std::filesystem::path &file);

} // namespace sdre
