// SPDX-License-Identifier: MIT
#include "stm32g431/flash.hpp"

namespace iss::stm32g431 {
namespace {

constexpr std::uint32_t acr  = 0x00;
constexpr std::uint32_t keyr = 0x08;
constexpr std::uint32_t sr   = 0x10;
constexpr std::uint32_t cr   = 0x14;

constexpr std::uint32_t key_1      = 0x45670123;
constexpr std::uint32_t key_2      = 0xCDEF89AB;
constexpr std::uint32_t lock       = 1U << 31U;
constexpr std::uint32_t programs   = 1U;
constexpr std::uint32_t erases     = 1U << 1U;
constexpr std::uint32_t starts     = 1U << 16U;
constexpr std::uint32_t prog_error = 1U << 3U;
constexpr std::uint32_t seq_error  = 1U << 7U;
constexpr std::uint32_t size_error = 1U << 6U;
constexpr std::uint32_t page       = 2048;
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
        half_at_ = 0;
        core().wait(write_time);
    }
}

void Flash::erase(std::uint32_t number)
{
    core().set_octets(flash_base + number * page, std::vector<std::uint8_t>(page, 0xFFU));
    core().wait(erase_time);
}

void Flash::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == keyr) {
        keys_ = value == key_1 ? 1U : value == key_2 && keys_ == 1U ? 2U : 0U;
        at(cr) &= keys_ == 2U ? ~lock : ~0U;
    } else if (offset == sr) {
        at(sr) &= ~value;
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
