// SPDX-License-Identifier: MIT
/// The result of a drive's commissioning. `sdre-drive commission` reads it over Modbus and writes
/// it as TOML.
#pragma once

#include <filesystem>

extern "C" {
#include "commission_types.h"
}

namespace sdre {

/// InputError in one line on anything missing, unknown or out of range. Values that a drive file
/// does not accept stay zero.
commission_result_t read_found_file(const std::filesystem::path &file);

} // namespace sdre
