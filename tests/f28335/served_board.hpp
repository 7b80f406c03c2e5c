// SPDX-License-Identifier: MIT
/// The board of the tests in tests/served: the virtual F28335 with the shipped drive.
#pragma once

#include "drive/drive_file.hpp"
#include "ipmsm_390w/served_motor.hpp"
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
constexpr double restart_s = 2.2; ///< erasure 2 s; it answers before its zeros are measured
constexpr double erasing_s = 1.0; ///< within an erasure that a request has begun

/// Passes of the background that a test can ask for.
constexpr double passes_s[]{25e-6, 0.35e-3, 0.7e-3};
inline void      set_pass(ServedBoard &served, double pass_s)
{
    served.set_pass(pass_s);
}

/// A word of a stored content.
inline void flip_stored_bit(ServedBoard & /*served*/, std::uint16_t slot, std::size_t word)
{
    const_cast<std::uint16_t *>(f28335_board_store(slot))[STORE_HEAD_WORDS + word] ^= 0x10U;
}

} // namespace sdre
