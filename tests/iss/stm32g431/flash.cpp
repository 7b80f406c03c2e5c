// SPDX-License-Identifier: MIT
#include "stm32g431/flash.hpp"

#include <algorithm>

namespace iss::stm32g431 {
namespace {

constexpr std::uint32_t acr  = 0x00;
constexpr std::uint32_t keyr = 0x08;
constexpr std::uint32_t sr   = 0x10;
constexpr std::uint32_t cr   = 0x14;
constexpr std::uint32_t eccr = 0x18;

constexpr std::uint32_t key_1      = 0x45670123;
constexpr std::uint32_t key_2      = 0xCDEF89AB;
constexpr std::uint32_t lock       = 1U << 31U;
constexpr std::uint32_t programs   = 1U;
constexpr std::uint32_t erases     = 1U << 1U;
constexpr std::uint32_t starts     = 1U << 16U;
constexpr std::uint32_t prog_error = 1U << 3U;
constexpr std::uint32_t seq_error  = 1U << 7U;
constexpr std::uint32_t size_error = 1U << 6U;
constexpr std::uint32_t beyond     = 1U << 31U; // ECCD
constexpr std::uint32_t page       = 2048;
constexpr std::uint32_t grain      = 8;
constexpr std::uint64_t erase_time = 3'740'000; // 22 ms
constexpr std::uint64_t write_time = 14'000;    // 82 us: the processor waits

} // namespace

Flash::Flash(Core &core) : Registers(core, "FLASH", 0x400) {}

void Flash::reset()
{
    Registers::reset();
    at(acr)  = 0x600;
    at(cr)   = lock;
    keys_    = 0;
    half_at_ = 0;
}

void Flash::fail(std::uint32_t error, const char *why)
{
    at(sr) |= error;
    find(why);
}

void Flash::before_write(std::uint32_t address, unsigned octets, std::uint32_t value)
{
    (void)value;
    if ((at(cr) & lock) != 0U || (at(cr) & programs) == 0U) {
        fail(seq_error, "a word is written without unlock");
    } else if (octets != 4) {
        fail(size_error, "written by other than 32 bits");
    } else if (core().word(address) != 0xFFFFFFFFU) {
        fail(prog_error, "64 bits are written twice");
    } else if (half_at_ == 0U) {
        half_at_ = address;
        if ((address & 7U) != 0U) {
            fail(seq_error, "64 bits are written from their middle");
        }
    } else {
        if (address != half_at_ + 4U) {
            fail(seq_error, "half of 64 bits is written");
        }
        writes_++;
        begin(half_at_, std::vector<std::uint8_t>(grain, 0xFFU), write_time);
        half_at_ = 0;
    }
}

void Flash::before_read(std::uint32_t address)
{
    const std::uint32_t at_grain = address & ~(grain - 1U);
    if (torn_.count(at_grain) != 0U) {
        torn_reads_++;
        at(eccr) = beyond | (at_grain - flash_base);
        core().exceptions().pend(exception_nmi);
        core().stop();
    }
}

void Flash::begin(std::uint32_t address, const std::vector<std::uint8_t> &before,
                  std::uint64_t cycles)
{
    work_at_ = address;
    before_  = before;
    ends_    = core().cycles() + cycles;
    core().wait(cycles);
}

void Flash::erase(std::uint32_t number)
{
    const std::uint32_t       first = flash_base + number * page;
    std::vector<std::uint8_t> before(page);
    core().read_octets(first, before.data(), page);
    core().set_octets(first, std::vector<std::uint8_t>(page, 0xFFU));
    torn_.erase(torn_.lower_bound(first), torn_.lower_bound(first + page));
    begin(first, before, erase_time);
}

void Flash::cut_power(std::uint64_t cycle)
{
    if (half_at_ != 0U) {
        core().set_word(half_at_, 0xFFFFFFFFU);
    }
    for (std::uint32_t n = 0; cycle < ends_ && n < before_.size(); n += grain) {
        const auto from   = before_.begin() + n;
        const auto chance = random_() % 3U;
        if (chance == 0U) {
            core().set_octets(work_at_ + n, {from, from + grain});
        } else if (chance == 1U) {
            std::vector<std::uint8_t> anything(grain);
            std::generate(anything.begin(), anything.end(),
                          [this] { return static_cast<std::uint8_t>(random_()); });
            core().set_octets(work_at_ + n, anything);
            torn_.insert(work_at_ + n);
            core().watch_reads(work_at_ + n);
        }
    }
    ends_ = 0;
}

void Flash::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == keyr) {
        keys_ = value == key_1 ? 1U : value == key_2 && keys_ == 1U ? 2U : 0U;
        at(cr) &= keys_ == 2U ? ~lock : ~0U;
    } else if (offset == sr) {
        at(sr) &= ~value;
    } else if (offset == eccr) {
        at(eccr) &= ~(value & beyond);
    } else if (offset == cr) {
        if ((at(cr) & lock) != 0U) {
            find("CR written while it is locked");
            return;
        }
        at(cr) = value;
        if ((value & erases) != 0U && (value & starts) != 0U) {
            erase((value >> 3U) & 63U);
            at(cr) &= ~starts;
        }
    } else {
        at(offset) = value;
    }
}

} // namespace iss::stm32g431
