// SPDX-License-Identifier: MIT
/// What a drive's commissioning found, as `sdre-drive commission` reads it over Modbus and writes it: a file of TOML.
#pragma once

#include <filesystem>

extern "C" {
#include "commission_types.h"
}

namespace sdre {

/// InputError in one line on anything missing, unknown or out of range. What a drive file does not take stays zero.
commission_result_t read_found_file(const std::filesystem::path &file);

} // namespace sdre
