// SPDX-License-Identifier: MIT
#include "sil/f28335/clock.hpp"

#include <algorithm>

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {
namespace {

constexpr std::int64_t lock_osc = 131072; // data sheet

double divided(double clock_Hz, unsigned n)
{
    return n == 0U ? clock_Hz : clock_Hz / (2.0 * n);
}

} // namespace

Clock::Clock(const ClockFaults &faults) : faults_(faults), limp_(faults.limp_mode)
{
    update_ratio();
}

void Clock::lose_crystal()
{
    limp_ = true;
    update_ratio();
}

void Clock::update_ratio()
{
    const unsigned divsel = SysCtrlRegs.PLLSTS.bit.DIVSEL;
    const int      divide = divsel < 2U ? 4 : divsel == 2U ? 2 : 1;
    const bool     locked = pllcr_ != 0U && !locking_;
    numerator_            = locked ? pllcr_ : 1; // 30 MHz = a fifth of a tick's rate
    denominator_          = 5LL * divide;
    if (limp_) {
        numerator_   = 1; // chosen: 2 MHz of the 1 to 5 MHz of a PLL without reference
        denominator_ = 75;
    }
}

void Clock::sync(std::int64_t now_ticks, Findings &findings, double time_s)
{
    auto &sts = SysCtrlRegs.PLLSTS;
    if (SysCtrlRegs.PLLCR.bit.DIV != pllcr_) {
        if (sts.bit.MCLKSTS != 0U) {
            findings.add(Finding::clock, "PLLCR written in limp mode", time_s);
        }
        if (sts.bit.DIVSEL != 0U) {
            findings.add(Finding::clock, "PLLCR written while DIVSEL is not 0", time_s);
        }
        if (sts.bit.MCLKOFF == 0U) {
            findings.add(Finding::clock, "PLLCR written with the clock detector on", time_s);
        }
        pllcr_   = SysCtrlRegs.PLLCR.bit.DIV;
        locking_ = pllcr_ != 0U;
        lock_at_ = now_ticks + lock_osc * ticks_per_osc;
    }
    if (locking_ && now_ticks >= lock_at_ && !faults_.never_locks && !limp_) {
        locking_ = false;
    }
    if (sts.bit.DIVSEL >= 2U && locking_) {
        findings.add(Finding::clock, "divider lowered before the PLL has locked", time_s);
    }
    sts.bit.PLLLOCKS = locking_ ? 0U : 1U;
    sts.bit.MCLKSTS  = limp_ && sts.bit.MCLKOFF == 0U ? 1U : 0U;
    sts.bit.MCLKCLR  = 0U;
    update_ratio();
    if (sysclk_Hz() > tick_Hz) {
        findings.add(Finding::clock, "SYSCLKOUT above 150 MHz", time_s);
    }
}

std::int64_t Clock::cycles(std::int64_t ticks)
{
    const std::int64_t sum = ticks * numerator_ + remainder_;
    remainder_             = sum % denominator_;
    return sum / denominator_;
}

std::int64_t Clock::ticks_for(std::int64_t cycles) const
{
    const std::int64_t needed = cycles * denominator_ - remainder_ % denominator_;
    return std::max<std::int64_t>(1, (needed + numerator_ - 1) / numerator_);
}

double Clock::sysclk_Hz() const
{
    return tick_Hz * static_cast<double>(numerator_) / static_cast<double>(denominator_);
}

double Clock::hspclk_Hz() const
{
    return divided(sysclk_Hz(), SysCtrlRegs.HISPCP.bit.HSPCLK);
}

double Clock::lspclk_Hz() const
{
    return divided(sysclk_Hz(), SysCtrlRegs.LOSPCP.bit.LSPCLK);
}

} // namespace sdre::f28335
