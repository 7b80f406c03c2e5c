// SPDX-License-Identifier: MIT
/// A CPU timer: counts SYSCLKOUT down.
#pragma once

#include <cstdint>

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

class CpuTimer {
public:
    /// @param number 0 .. 2
    CpuTimer(volatile CPUTIMER_REGS &registers, int number);
    void sync();
    /// SYSCLKOUT cycles until it asks for an interrupt; -1: it will not.
    std::int64_t cycles_to_interrupt() const;
    /// True when it reached zero with its interrupt enabled.
    bool step(std::int64_t cycles);

private:
    void         present();
    bool         runs() const;
    std::int64_t divider() const;

    volatile CPUTIMER_REGS &registers_;
    int                     clock_bit_;

    std::int64_t  count_         = 0xFFFF;
    std::int64_t  prescaled_     = 0;
    std::uint32_t presented_tim_ = 0xFFFF;
    bool          flag_          = false;
};

} // namespace sdre::f28335
