// SPDX-License-Identifier: MIT
/// A program for a 32-bit little-endian ARM, as it is flashed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace iss {

struct ElfSegment {
    std::uint32_t             address; ///< where it is loaded, LMA
    std::vector<std::uint8_t> octets;
};

struct ElfImage {
    std::vector<ElfSegment>              segments;
    std::map<std::string, std::uint32_t> symbols;
    std::map<std::string, std::uint32_t> sizes; ///< of the symbols that have one, in octets
};

/// std::runtime_error in one line when it is none.
ElfImage read_elf(const std::filesystem::path &file);

} // namespace iss
