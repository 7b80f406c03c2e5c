// SPDX-License-Identifier: MIT
#include "stm32g431/converter.hpp"

namespace iss::stm32g431 {
namespace {

constexpr std::uint32_t isr   = 0x00;
constexpr std::uint32_t ier   = 0x04;
constexpr std::uint32_t cr    = 0x08;
constexpr std::uint32_t smpr1 = 0x14;
constexpr std::uint32_t jsqr  = 0x4C;
constexpr std::uint32_t jdr1  = 0x80;

constexpr std::uint32_t ready     = 1U;
constexpr std::uint32_t end_flags = 3U << 5U; // JEOC, JEOS
constexpr std::uint32_t sequence  = 1U << 6U; // JEOS
constexpr std::uint32_t enable    = 1U;
constexpr std::uint32_t armed     = 1U << 3U;
constexpr std::uint32_t regulator = 1U << 28U;
constexpr std::uint32_t calibrate = 1U << 31U;

constexpr double                cycles_per_clock = 4.0; // CKMODE of this board
constexpr double                conversion       = 12.5;
constexpr std::array<double, 8> sampling{2.5, 6.5, 12.5, 24.5, 47.5, 92.5, 247.5, 640.5};

} // namespace

Converter::Converter(Core &core, int number)
    : Registers(core, "ADC" + std::to_string(number), 0x100), number_(number)
{
}

void Converter::reset()
{
    Registers::reset();
    due_ = UINT64_MAX;
}

void Converter::start(Circuit &circuit, std::uint64_t cycle)
{
    const std::uint32_t trigger = (at(jsqr) >> 2U) & 0x7FU; // JEXTSEL 0, rising
    if ((at(cr) & armed) == 0U || trigger != 0x20U) {
        return;
    }
    if (due_ != UINT64_MAX) {
        find("triggered while it converts");
    }
    double              clocks = 0.0;
    const std::uint32_t count  = (at(jsqr) & 3U) + 1U;
    for (std::uint32_t n = 0; n < count; n++) {
        const std::uint32_t input = (at(jsqr) >> (9U + 6U * n)) & 31U;
        const std::uint32_t time  = (at(smpr1 + 4U * (input / 10U)) >> (3U * (input % 10U))) & 7U;
        clocks += sampling.at(time) + conversion;
        results_.at(n) = static_cast<std::uint32_t>(circuit.code(number_, static_cast<int>(input)));
    }
    due_ = cycle + static_cast<std::uint64_t>(clocks * cycles_per_clock);
}

void Converter::end()
{
    due_ = UINT64_MAX;
    for (std::uint32_t n = 0; n < 4; n++) {
        at(jdr1 + 4U * n) = results_.at(n);
    }
    at(isr) |= end_flags;
}

bool Converter::interrupts() const
{
    return (at(isr) & at(ier) & end_flags) != 0U;
}

std::uint32_t Converter::on_read(std::uint32_t offset)
{
    if (offset >= jdr1 && offset < jdr1 + 16U && due_ != UINT64_MAX) {
        find("a result is read before its conversion has ended");
    }
    return at(offset);
}

void Converter::on_write(std::uint32_t offset, std::uint32_t value)
{
    if (offset == isr) {
        at(isr) &= ~value;
        core().stop();
    } else if (offset == cr) {
        if ((value & enable) != 0U && (value & regulator) == 0U) {
            find("enabled without its regulator");
        }
        at(cr) = (value & ~calibrate) | (at(cr) & (enable | armed) & (value | enable | armed));
        at(isr) |= (value & enable) != 0U ? ready : 0U;
    } else {
        at(offset) = value;
    }
}

} // namespace iss::stm32g431
