// SPDX-License-Identifier: MIT
#include "sil/f28335/flash_unit.hpp"

#include <algorithm>

#include "sil/f28335/device.hpp"

namespace {

constexpr Uint16 slots      = 4;
constexpr Uint16 slot_words = 0x8000;
constexpr double erase_s    = 2.0;   // data sheet, typical, a sector of 32 K words
constexpr double program_s  = 50e-6; // the same, a word

Uint16 memory[slots][slot_words];
long   changes = 0;

static_assert(sdre::f28335::flash_word_count == static_cast<std::size_t>(slots) * slot_words);

void take(double time_s)
{
    sdre::f28335::Device::current().change_flash(time_s);
}

} // namespace

/// Replaces firmware/board/f28335/flash_store.c, which cannot write, by a writable store.
extern "C" {

const Uint16 *f28335_board_store(Uint16 slot)
{
    return (slot < slots) ? memory[slot] : nullptr;
}

/// Sets all words to zero first, then to 0xFFFF: an interrupted erasure leaves zeros.
bool f28335_board_store_erase(Uint16 slot)
{
    if (slot >= slots) {
        return false;
    }
    changes++;
    std::fill_n(memory[slot], slot_words, Uint16{0});
    take(erase_s);
    changes++;
    std::fill_n(memory[slot], slot_words, Uint16{0xFFFF});
    return true;
}

bool f28335_board_store_program(Uint16 slot, std::uint32_t offset, const Uint16 *words,
                                Uint16 count)
{
    if (slot >= slots || offset > slot_words || count > slot_words - offset) {
        return false;
    }
    Uint16 *const to = memory[slot] + offset;
    for (Uint16 n = 0; n < count; n++) {
        if ((to[n] & words[n]) != words[n]) {
            return false; // a bit is only ever cleared
        }
        take(program_s);
        to[n] = words[n];
        changes++;
    }
    return true;
}
}

namespace sdre::f28335 {
namespace {

[[maybe_unused]] const bool from_the_factory = (erase_flash(), true);

} // namespace

void erase_flash()
{
    std::fill_n(&memory[0][0], flash_word_count, Uint16{erased_word});
}

void set_flash(const FlashWords &words)
{
    std::copy_n(words.begin(), flash_word_count, &memory[0][0]);
}

FlashWords flash_words()
{
    return {&memory[0][0], &memory[0][0] + flash_word_count};
}

long flash_changes()
{
    return changes;
}

} // namespace sdre::f28335
