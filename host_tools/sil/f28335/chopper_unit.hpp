// SPDX-License-Identifier: MIT
/// ePWM5 as the board layer uses it: counts up, software sets and clears output A, the compare value clears it.
#pragma once

#include <cstdint>

#include "sil/f28335/findings.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

class ChopperUnit {
public:
    explicit ChopperUnit(volatile EPWM_REGS &registers) : r_(registers) {}

    /// Takes the written registers, refreshes the counter.
    void sync(Findings &findings, double time_s);
    /// SYSCLK cycles until the compare value clears the output; -1: it is low, or the counter stands.
    std::int64_t cycles_to_event() const;
    void         step(std::int64_t cycles);

    /// Level of output A.
    bool high() const
    {
        return high_;
    }

private:
    bool running() const;
    int  cycles_per_count() const;
    void check_settings(Findings &findings, double time_s) const;
    void present();

    volatile EPWM_REGS &r_;
    std::int64_t        position_      = 0; ///< SYSCLK cycles since the count was 0
    std::uint16_t       presented_ctr_ = 0;
    bool                high_          = false;
};

} // namespace sdre::f28335
