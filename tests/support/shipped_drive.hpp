// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace support {

inline std::filesystem::path shipped_drive(const std::string &name)
{
    return std::filesystem::path(SDRE_SOURCE_DIR) / "firmware/config/drives" / (name + ".toml");
}

} // namespace support
