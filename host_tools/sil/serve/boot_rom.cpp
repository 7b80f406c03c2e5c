// SPDX-License-Identifier: MIT
#include "sil/serve/boot_rom.hpp"

#include <array>

#include <fmt/format.h>

namespace sdre {
namespace {

constexpr std::uint8_t  autobaud       = 0x41;
constexpr std::uint16_t key            = 0x08AA;
constexpr std::size_t   reserved_words = 8;
constexpr std::size_t   entry_at       = 1 + reserved_words; // words before the entry
constexpr std::size_t   block_head     = 3;                  // length, address

struct Range {
    std::uint32_t first;
    std::uint32_t end;
};
// M0 and M1 but the ROM's own stack, L0 to L7.
constexpr std::array<Range, 3> ram{{{0x0000, 0x0002}, {0x0050, 0x0800}, {0x8000, 0x10000}}};

bool is_ram(std::uint32_t address)
{
    for (const Range &r : ram) {
        if (address >= r.first && address < r.end) {
            return true;
        }
    }
    return false;
}

} // namespace

std::optional<std::uint8_t> BootRom::answer(std::uint8_t octet)
{
    if (over_ || (!locked_ && octet != autobaud)) {
        return std::nullopt;
    }
    if (!locked_) {
        locked_ = true;
        return octet;
    }
    if (!low_) {
        low_ = octet;
        return octet;
    }
    const auto word = static_cast<std::uint16_t>(*low_ | (octet << 8U));
    low_.reset();
    take_word(word);
    return octet;
}

void BootRom::take_word(std::uint16_t word)
{
    const std::size_t n = words_++;
    if (n == 0) {
        over_ = word != key;
    } else if (n == entry_at) {
        entry_ = static_cast<std::uint32_t>(word) << 16U;
    } else if (n == entry_at + 1) {
        entry_ |= word;
    } else if (n > entry_at + 1) {
        take_block_word(word);
    }
}

void BootRom::take_block_word(std::uint16_t word)
{
    if (head_ == block_head) {
        store(word);
        return;
    }
    head_++;
    if (head_ == 1) {
        left_   = word;
        over_   = word == 0;
        loaded_ = over_;
    } else if (head_ == 2) {
        at_ = static_cast<std::uint32_t>(word) << 16U;
    } else {
        at_ |= word;
    }
}

void BootRom::store(std::uint16_t word)
{
    if (is_ram(at_)) {
        memory_[at_] = word;
    } else {
        lost_++;
    }
    at_++;
    left_--;
    head_ = left_ == 0 ? 0 : head_;
}

std::string BootRom::said() const
{
    if (!loaded()) {
        return "boot ROM: another key than 08AAh; it starts the flash";
    }
    std::string s = fmt::format("boot ROM: {} words in RAM, entry {:06X}h", memory_.size(), entry_);
    if (lost_ > 0) {
        s += fmt::format("; {} words were for addresses that are no RAM", lost_);
    }
    if (memory_.count(entry_) == 0) {
        s += "; nothing was loaded at the entry";
    }
    return s;
}

} // namespace sdre
