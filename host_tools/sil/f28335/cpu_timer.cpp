// SPDX-License-Identifier: MIT
#include "sil/f28335/cpu_timer.hpp"

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

void CpuTimer::present()
{
    presented_tim_            = static_cast<std::uint32_t>(count_);
    CpuTimer0Regs.TIM.all     = presented_tim_;
    CpuTimer0Regs.TCR.bit.TIF = 0; // a written 1 shows; the flag itself is not read by anyone
}

void CpuTimer::sync()
{
    if (CpuTimer0Regs.TCR.bit.TIF != 0U) {
        flag_ = false;
    }
    if (CpuTimer0Regs.TIM.all != presented_tim_) {
        count_ = CpuTimer0Regs.TIM.all;
    }
    if (CpuTimer0Regs.TCR.bit.TRB != 0U) {
        count_                    = CpuTimer0Regs.PRD.all;
        prescaled_                = 0;
        CpuTimer0Regs.TCR.bit.TRB = 0;
    }
    present();
}

bool CpuTimer::step(std::int64_t cycles)
{
    if (SysCtrlRegs.PCLKCR3.bit.CPUTIMER0ENCLK == 0U || CpuTimer0Regs.TCR.bit.TSS != 0U) {
        return false;
    }
    const std::int64_t divide =
        ((CpuTimer0Regs.TPRH.bit.TDDRH << 8U) | CpuTimer0Regs.TPR.bit.TDDR) + 1LL;
    prescaled_ += cycles;
    const std::int64_t steps = prescaled_ / divide;
    prescaled_ %= divide;
    const std::int64_t states = static_cast<std::int64_t>(CpuTimer0Regs.PRD.all) + 1;
    bool               done   = false;
    count_ -= steps;
    while (count_ < 0) {
        count_ += states;
        flag_ = true;
        done  = true;
    }
    present();
    return done && CpuTimer0Regs.TCR.bit.TIE != 0U;
}

} // namespace sdre::f28335
