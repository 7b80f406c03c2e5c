// SPDX-License-Identifier: MIT
/// The four flash sectors of the firmware's store. They outlive a device, until the program ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sdre::f28335 {

using FlashWords = std::vector<std::uint16_t>; ///< of all sectors, one after the other

constexpr std::size_t   flash_word_count = 4 * 0x8000;
constexpr std::uint16_t erased_word      = 0xFFFF;

/// As from the factory: every word erased_word.
void erase_flash();
/// flash_word_count words.
void       set_flash(const FlashWords &words);
FlashWords flash_words();
/// Grows with every word that is erased or programmed.
long flash_changes();

} // namespace sdre::f28335
