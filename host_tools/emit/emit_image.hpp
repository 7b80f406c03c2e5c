// SPDX-License-Identifier: MIT
/// A drive's constants as the words that the firmware's store takes (firmware/store/drive_image.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "design/design.hpp"

namespace sdre {

/// InputError when the board cannot have the drive.
std::vector<std::uint16_t> image_words(const Design &design);

/// The words of a file of `sdre-drive disc-map learn`, to follow those of an image (firmware/app/angle/app_disc.h).
/// InputError when it is none, or one for another encoder.
std::vector<std::uint16_t> read_disc_map(const std::filesystem::path &file, const Drive &drive);

/// A line for each number of the image: its first word, its name, its value.
std::string image_list(const Design &design);

/// The words as octets, the high one of each first: what `sdre-drive load` takes.
std::string image_octets(const std::vector<std::uint16_t> &words);

/// The same as Intel HEX for a programming tool, in the first slot of the store with its head, as the writing of number 1.
/// Addresses count words of 16 bits. InputError for a processor with another store.
std::string image_hex(const std::vector<std::uint16_t> &words, const Processor &processor);

} // namespace sdre
