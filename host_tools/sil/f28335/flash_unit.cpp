// SPDX-License-Identifier: MIT
#include "sil/f28335/flash_unit.hpp"

#include <algorithm>
#include <iterator>

#include "sil/f28335/device.hpp"

#include "Flash2833x_API_Library.h"

namespace {

constexpr int    sectors      = 4;
constexpr int    sector_words = 0x8000;
constexpr Uint16 masks[sectors]{SECTORH, SECTORG, SECTORF, SECTORE};
constexpr double erase_s      = 2.0;   // data sheet, typical, a sector of 32 K words
constexpr double program_s    = 50e-6; // the same, a word
constexpr double scale_150MHz = 1048576.0 * 200.0 / 6.667;

} // namespace

extern "C" {

Uint16 board_store_memory[sectors][sector_words];
Uint32 Flash_CPUScaleFactor     = 0;
void (*Flash_CallbackPtr)(void) = nullptr;

/// All words to zero first, then all to one: a cut leaves zeros.
Uint16 Flash_Erase(Uint16 SectorMask, FLASH_ST *)
{
    const auto *const sector = std::find(std::begin(masks), std::end(masks), SectorMask);
    if (sector == std::end(masks)) {
        return STATUS_FAIL_NO_SECTOR_SPECIFIED;
    }
    Uint16 *const words = board_store_memory[sector - std::begin(masks)];
    std::fill_n(words, sector_words, Uint16{0});
    sdre::f28335::Device::current().change_flash(erase_s, Flash_CPUScaleFactor, scale_150MHz);
    std::fill_n(words, sector_words, Uint16{0xFFFF});
    return STATUS_SUCCESS;
}

Uint16 Flash_Program(Uint16 *FlashAddr, Uint16 *BufAddr, Uint32 Length, FLASH_ST *)
{
    for (Uint32 n = 0; n < Length; n++) {
        if ((FlashAddr[n] & BufAddr[n]) != BufAddr[n]) {
            return STATUS_FAIL_ZERO_BIT_ERROR;
        }
        sdre::f28335::Device::current().change_flash(program_s, Flash_CPUScaleFactor, scale_150MHz);
        FlashAddr[n] = BufAddr[n];
    }
    return STATUS_SUCCESS;
}
}

namespace sdre::f28335 {
namespace {

[[maybe_unused]] const bool from_the_factory = (erase_flash(), true);

} // namespace

void erase_flash()
{
    std::fill_n(&board_store_memory[0][0], sectors * sector_words, Uint16{0xFFFF});
}

} // namespace sdre::f28335
