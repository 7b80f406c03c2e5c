// SPDX-License-Identifier: MIT
/// The board of the tests in tests/served: the virtual F28335 with the shipped drive.
#pragma once

#include "drive/drive_file.hpp"
#include "sil/served/served_f28335.hpp"

extern "C" {
#include "store.h"

const std::uint16_t *f28335_board_store(std::uint16_t slot);
}

namespace sdre {

using ServedBoard = ServedF28335;

inline Drive shipped_drive()
{
    return read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
}

constexpr double erased_s  = 2.1; ///< a slot of the store: 2 s
constexpr double erasing_s = 1.0; ///< within an erasure that a request has begun
/// Largest speeds of images that are loaded: not those of the shipped drive.
constexpr double first_image_e_radps  = 300.0;
constexpr double second_image_e_radps = 400.0;
constexpr double speed_band_rpm       = 3.0;
constexpr double sine_band_e_radps    = 0.3;
constexpr double coasting_s      = 1.5; ///< from 600 r/min it still turns; a quick stop has ended
constexpr double to_rest_s       = 8.5;
constexpr int    counts_per_turn = 10000; ///< four times the lines

/// A word of a stored content.
inline void flip_stored_bit(ServedBoard & /*served*/, std::uint16_t slot, std::size_t word)
{
    const_cast<std::uint16_t *>(f28335_board_store(slot))[STORE_HEAD_WORDS + word] ^= 0x10U;
}

} // namespace sdre
