// SPDX-License-Identifier: MIT
#include "stm32g431/serial.hpp"

#include <algorithm>

namespace iss::stm32g431 {
namespace {

constexpr std::uint32_t cr1 = 0x00;
constexpr std::uint32_t brr = 0x0C;
constexpr std::uint32_t isr = 0x1C;
constexpr std::uint32_t icr = 0x20;
constexpr std::uint32_t rdr = 0x24;
constexpr std::uint32_t tdr = 0x28;

constexpr std::uint32_t enable   = 1U;
constexpr std::uint32_t not_full = 1U << 7U; // TXE: of the FIFO
constexpr std::uint32_t has      = 1U << 5U; // RXNE
constexpr std::uint32_t overrun  = 1U << 3U;
constexpr std::uint32_t wants    = 1U << 5U; // RXNEIE
constexpr std::size_t   fifo     = 8;
constexpr std::uint64_t bits     = 11;

} // namespace

Serial::Serial(Core &core) : Registers(core, "USART2", 0x400) {}

void Serial::reset()
{
    Registers::reset();
    received_.clear();
    leaving_.clear();
    comes_  = coming_.empty() ? UINT64_MAX : core().cycles();
    leaves_ = UINT64_MAX;
    lost_   = false;
}

std::uint64_t Serial::octet_cycles() const
{
    return bits * std::max<std::uint64_t>(at(brr), 16U);
}

bool Serial::on() const
{
    return (at(cr1) & enable) != 0U;
}

void Serial::send(std::uint8_t octet)
{
    coming_.push_back(octet);
    if (comes_ == UINT64_MAX) {
        comes_ = core().cycles() + octet_cycles();
    }
}

int Serial::take()
{
    if (sent_.empty()) {
        return -1;
    }
    const int octet = sent_.front();
    sent_.pop_front();
    return octet;
}

std::uint64_t Serial::due() const
{
    return std::min(comes_, leaves_);
}

void Serial::step()
{
    const std::uint64_t now = core().cycles();
    if (comes_ <= now) {
        if (on() && received_.size() < fifo) {
            received_.push_back(coming_.front());
        } else {
            lost_ = lost_ || on();
        }
        coming_.pop_front();
        comes_ = coming_.empty() ? UINT64_MAX : comes_ + octet_cycles();
    }
    if (leaves_ <= now) {
        sent_.push_back(leaving_.front());
        leaving_.pop_front();
        leaves_ = leaving_.empty() ? UINT64_MAX : leaves_ + octet_cycles();
    }
}

bool Serial::interrupts() const
{
    return on() && (at(cr1) & wants) != 0U && (!received_.empty() || lost_);
}

std::uint32_t Serial::on_read(std::uint32_t offset)
{
    if (offset == isr) {
        return (received_.empty() ? 0U : has) | (leaving_.size() < fifo ? not_full : 0U) |
               (lost_ ? overrun : 0U);
    }
    if (offset == rdr && !received_.empty()) {
        const std::uint8_t octet = received_.front();
        received_.pop_front();
        core().stop();
        return octet;
    }
    return at(offset);
}

void Serial::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == icr) {
        lost_ = lost_ && (value & overrun) == 0U;
        core().stop();
    } else if (offset == tdr) {
        if (leaving_.size() >= fifo) {
            find("an octet is written to a full FIFO");
            return;
        }
        leaving_.push_back(static_cast<std::uint8_t>(value));
        if (leaves_ == UINT64_MAX) {
            leaves_ = core().cycles() + octet_cycles();
        }
        core().stop();
    } else {
        at(offset) = value;
        core().stop();
    }
}

} // namespace iss::stm32g431
