// SPDX-License-Identifier: MIT
#include "sil/f28335/gpio.hpp"

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {
namespace {

struct Port {
    volatile std::uint32_t &dat;
    volatile std::uint32_t &set;
    volatile std::uint32_t &clear;
    volatile std::uint32_t &toggle;
    std::uint32_t           dir;
};

Port port(int n)
{
    auto &d = GpioDataRegs;
    auto &c = GpioCtrlRegs;
    switch (n) {
    case 0:
        return {d.GPADAT.all, d.GPASET.all, d.GPACLEAR.all, d.GPATOGGLE.all, c.GPADIR.all};
    case 1:
        return {d.GPBDAT.all, d.GPBSET.all, d.GPBCLEAR.all, d.GPBTOGGLE.all, c.GPBDIR.all};
    default:
        return {d.GPCDAT.all, d.GPCSET.all, d.GPCCLEAR.all, d.GPCTOGGLE.all, c.GPCDIR.all};
    }
}

} // namespace

Gpio::Gpio()
{
    for (std::uint32_t &o : outside_) {
        o = 0xFFFFFFFFU; // idle lines are pulled up
    }
    sync();
}

void Gpio::sync()
{
    for (int n = 0; n < 3; n++) {
        const Port p = port(n);
        if (p.dat != presented_[n]) {
            latch_[n] = p.dat;
        }
        latch_[n] |= p.set;
        latch_[n] &= ~p.clear;
        latch_[n] ^= p.toggle;
        p.set         = 0;
        p.clear       = 0;
        p.toggle      = 0;
        presented_[n] = (latch_[n] & p.dir) | (outside_[n] & ~p.dir);
        p.dat         = presented_[n];
    }
}

void Gpio::drive(int pin, bool high)
{
    const std::uint32_t bit = 1U << (pin % 32);
    outside_[pin / 32]      = high ? outside_[pin / 32] | bit : outside_[pin / 32] & ~bit;
    sync();
}

bool Gpio::output_high(int pin) const
{
    const std::uint32_t bit = 1U << (pin % 32);
    return (port(pin / 32).dir & bit) != 0U && (latch_[pin / 32] & bit) != 0U;
}

bool Gpio::is_output(int pin)
{
    return (port(pin / 32).dir & (1U << (pin % 32))) != 0U;
}

bool Gpio::is_muxed(int pin, unsigned function)
{
    const std::uint32_t mux = pin < 16 ? GpioCtrlRegs.GPAMUX1.all : GpioCtrlRegs.GPAMUX2.all;
    return ((mux >> (2 * (pin % 16))) & 3U) == function;
}

} // namespace sdre::f28335
