// SPDX-License-Identifier: MIT
#include "stm32g431/system.hpp"

namespace iss::stm32g431 {
namespace {

// RCC
constexpr std::uint32_t cr      = 0x00;
constexpr std::uint32_t cfgr    = 0x08;
constexpr std::uint32_t cifr    = 0x1C;
constexpr std::uint32_t cicr    = 0x20;
constexpr std::uint32_t csr     = 0x94;
constexpr std::uint32_t watch   = 1U << 19U;
constexpr std::uint32_t failed  = 1U << 8U; // in CIFR and CICR
constexpr std::uint32_t hse_on  = 1U << 16U;
constexpr std::uint32_t hse_rdy = 1U << 17U;
constexpr std::uint32_t pll_on  = 1U << 24U;
constexpr std::uint32_t pll_rdy = 1U << 25U;
constexpr std::uint32_t of_pll  = 3U;
constexpr std::uint32_t forget  = 1U << 23U;

// GPIO
constexpr std::uint32_t moder = 0x00;
constexpr std::uint32_t idr   = 0x10;
constexpr std::uint32_t odr   = 0x14;
constexpr std::uint32_t bsrr  = 0x18;
constexpr std::uint32_t afrl  = 0x20;

// IWDG
constexpr std::uint32_t kr         = 0x00;
constexpr std::uint32_t pr         = 0x04;
constexpr std::uint32_t rlr        = 0x08;
constexpr std::uint32_t key_start  = 0xCCCC;
constexpr std::uint32_t key_unlock = 0x5555;
constexpr std::uint32_t key_serve  = 0xAAAA;
constexpr double        slow_Hz    = 32000.0; // nominal
constexpr double        core_Hz    = 170e6;

} // namespace

std::uint32_t Registers::read(std::uint32_t offset, unsigned octets)
{
    if (!is_clocked()) {
        find("read without its clock");
        return 0;
    }
    const std::uint32_t word = on_read(offset & ~3U);
    return octets == 4 ? word : (word >> (8U * (offset & 3U))) & ((1U << (8U * octets)) - 1U);
}

void Registers::write(std::uint32_t offset, std::uint32_t value, unsigned octets)
{
    if (!is_clocked()) {
        find("written without its clock");
    } else if (octets != 4) {
        find("written by " + std::to_string(octets) + " octets");
    } else {
        on_write(offset, value);
    }
}

bool Registers::is_clocked() const
{
    return rcc_ == nullptr || rcc_->is_on(gate_);
}

Rcc::Rcc(Core &core) : Registers(core, "RCC", 0x400) {}

void Rcc::reset()
{
    Registers::reset();
    at(cr)  = 0x500; // the internal oscillator
    at(csr) = causes_;
}

void Rcc::note_reset(std::uint32_t cause)
{
    causes_ |= cause;
}

void Rcc::lose_power()
{
    causes_ = 0;
}

void Rcc::break_crystal()
{
    broken_ = true;
}

bool Rcc::stop_crystal()
{
    const bool watched = (at(cr) & watch) != 0U;
    at(cr) &= ~(hse_rdy | pll_rdy);
    at(cifr) |= watched ? failed : 0U;
    return watched;
}

bool Rcc::is_on(ClockGate gate) const
{
    return ((at(gate.offset) >> gate.bit) & 1U) != 0U;
}

void Rcc::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == cr) {
        const bool crystal = (value & hse_on) != 0U && !broken_;
        const bool pll     = (value & pll_on) != 0U && crystal;
        at(cr) = (value & ~(hse_rdy | pll_rdy)) | (crystal ? hse_rdy : 0U) | (pll ? pll_rdy : 0U);
    } else if (offset == cfgr) {
        const bool ready = (value & 3U) != of_pll || (at(cr) & pll_rdy) != 0U;
        if (!ready) {
            find("CFGR chooses a PLL that does not run");
        }
        at(cfgr) = (value & ~0xCU) | (ready ? (value & 3U) << 2U : 0U);
    } else if (offset == cicr) {
        at(cifr) &= ~value;
    } else if (offset == csr) {
        causes_ = (value & forget) != 0U ? 0U : causes_;
        at(csr) = causes_;
    } else {
        at(offset) = value;
    }
}

Gpio::Gpio(Core &core, const std::string &name) : Registers(core, name, 0x400) {}

void Gpio::reset()
{
    Registers::reset();
    at(moder) = 0xFFFFFFFFU; // analog; the pins of the debugger are not modelled
}

void Gpio::drive(unsigned pin, bool high)
{
    outside_ = (outside_ & ~(1U << pin)) | (high ? 1U << pin : 0U);
}

bool Gpio::output(unsigned pin) const
{
    return ((at(moder) >> (2U * pin)) & 3U) == 1U && ((at(odr) >> pin) & 1U) != 0U;
}

bool Gpio::is_function(unsigned pin, unsigned function) const
{
    const std::uint32_t selected = at(afrl + 4U * (pin / 8U)) >> (4U * (pin % 8U));
    return ((at(moder) >> (2U * pin)) & 3U) == 2U && (selected & 15U) == function;
}

std::uint32_t Gpio::on_read(std::uint32_t offset)
{
    return offset == idr ? outside_ : at(offset);
}

void Gpio::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == bsrr) {
        at(odr) = (at(odr) & ~(value >> 16U)) | (value & 0xFFFFU);
    } else {
        at(offset) = value;
    }
}

void CcmMemory::before_write(std::uint32_t address, unsigned octets, std::uint32_t value)
{
    (void)octets;
    (void)value;
    const std::uint32_t page = (address - ccm_base) / 1024U;
    if ((protected_pages() >> page & 1U) != 0U) {
        core_.find("SYSCFG: a protected page of the CCM SRAM is written, at " + hex(address));
    }
}

Watchdog::Watchdog(Core &core) : Registers(core, "IWDG", 0x400) {}

void Watchdog::reset()
{
    Registers::reset();
    runs_     = false;
    unlocked_ = false;
}

void Watchdog::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == kr) {
        runs_     = runs_ || value == key_start;
        unlocked_ = value == key_unlock;
        if (value == key_serve || value == key_start) {
            served_ = core().cycles();
        }
    } else if (!unlocked_) {
        find("PR or RLR written without its key");
    } else {
        at(offset) = value;
    }
}

std::uint64_t Watchdog::due() const
{
    const double ticks =
        (at(rlr) == 0U ? 4096.0 : at(rlr) + 1.0) * static_cast<double>(4U << at(pr));
    return runs_ ? served_ + static_cast<std::uint64_t>(ticks / slow_Hz * core_Hz) : UINT64_MAX;
}

bool Watchdog::is_out() const
{
    return core().cycles() >= due();
}

} // namespace iss::stm32g431
