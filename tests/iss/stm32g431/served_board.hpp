// SPDX-License-Identifier: MIT
/// The board of the tests in tests/served: an image of the B-G431B-ESC1 on its simulator.
#pragma once

#include "drive/drive_file.hpp"
#include "served_motor.hpp"
#include "stm32g431/served_image.hpp"

namespace sdre {

inline Drive shipped_drive()
{
    return read_drive_file(ISS_DRIVE);
}

/// At the first start the shaft is held past the index, until the drive is ready: no alignment is needed.
class ServedBoard : public iss::stm32g431::ServedImage {
public:
    ServedBoard(const Drive &drive, std::uint64_t seed)
        : ServedImage(drive, drive, seed, program(), held_s)
    {
    }

    static const iss::stm32g431::Program &program()
    {
        static const iss::stm32g431::Program p{iss::read_elf(ISS_IMAGE), iss::read_elf(ISS_LAYOUT)};
        return p;
    }

private:
    static constexpr double held_s = 0.31; // boot 50 ms, offsets of the sensors 256 ms
};

constexpr double erased_s  = 0.1;  ///< a slot of the store: two pages of 22 ms
constexpr double restart_s = 0.2;  ///< erasure and boot, and room
constexpr double erasing_s = 0.03; ///< within an erasure that a request has begun

/// A pass of the background takes the instructions that it has.
constexpr double passes_s[]{0.0};
inline void      set_pass(ServedBoard      &/*served*/, double /*pass_s*/) {}

/// A word of a stored content: the flash's code does not know.
inline void flip_stored_bit(ServedBoard &served, std::uint16_t slot, std::size_t word)
{
    constexpr std::uint32_t slot_octets = 4096; // board_limits.h, as the next
    constexpr std::uint32_t head_octets = 32;
    const std::uint32_t     at          = ServedBoard::program().image.symbols.at("image_store") +
                             slot * slot_octets + head_octets +
                             2U * static_cast<std::uint32_t>(word);
    iss::Core &core = served.image().chip.core();
    core.set_word(at & ~3U, core.word(at & ~3U) ^ ((at & 2U) != 0U ? 0x100000U : 0x10U));
}

} // namespace sdre
