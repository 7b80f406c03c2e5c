// SPDX-License-Identifier: MIT
#include "sil/f28335/cpu_timer.hpp"

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

CpuTimer::CpuTimer(volatile CPUTIMER_REGS &registers, int number)
    : registers_(registers), clock_bit_(8 + number)
{
}

void CpuTimer::present()
{
    presented_tim_         = static_cast<std::uint32_t>(count_);
    registers_.TIM.all     = presented_tim_;
    registers_.TCR.bit.TIF = 0; // a written 1 shows; the flag itself is not read by anyone
}

void CpuTimer::sync()
{
    if (registers_.TCR.bit.TIF != 0U) {
        flag_ = false;
    }
    if (registers_.TIM.all != presented_tim_) {
        count_ = registers_.TIM.all;
    }
    if (registers_.TCR.bit.TRB != 0U) {
        count_                 = registers_.PRD.all;
        prescaled_             = 0;
        registers_.TCR.bit.TRB = 0;
    }
    present();
}

bool CpuTimer::runs() const
{
    return ((SysCtrlRegs.PCLKCR3.all >> clock_bit_) & 1U) != 0U && registers_.TCR.bit.TSS == 0U;
}

std::int64_t CpuTimer::divider() const
{
    return ((registers_.TPRH.bit.TDDRH << 8U) | registers_.TPR.bit.TDDR) + 1LL;
}

std::int64_t CpuTimer::cycles_to_interrupt() const
{
    return runs() && registers_.TCR.bit.TIE != 0U ? (count_ + 1) * divider() - prescaled_ : -1;
}

bool CpuTimer::step(std::int64_t cycles)
{
    if (!runs()) {
        return false;
    }
    prescaled_ += cycles;
    const std::int64_t steps = prescaled_ / divider();
    prescaled_ %= divider();
    const std::int64_t states = static_cast<std::int64_t>(registers_.PRD.all) + 1;
    bool               done   = false;
    count_ -= steps;
    while (count_ < 0) {
        count_ += states;
        flag_ = true;
        done  = true;
    }
    present();
    return done && registers_.TCR.bit.TIE != 0U;
}

} // namespace sdre::f28335
