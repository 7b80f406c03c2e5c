// SPDX-License-Identifier: MIT
/// ePWM5 and 6 as the board layer uses them: the unit counts up, software sets and clears output A. The compare value and a
/// trip clear it.
#pragma once

#include <cstdint>

#include "sil/f28335/findings.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

class HoldUnit {
public:
    HoldUnit(volatile EPWM_REGS &registers, int number) : r_(registers), number_(number) {}

    /// Takes the written registers, refreshes the counter. `fault_pin_low`: TZ1 is active.
    void sync(bool fault_pin_low, Findings &findings, double time_s);
    /// SYSCLK cycles until the compare value clears the output; -1: it is low, or the counter stands.
    std::int64_t cycles_to_event() const;
    void         step(std::int64_t cycles);

    /// Level of output A.
    bool high() const
    {
        return high_ && !one_shot_;
    }

private:
    bool clocked() const;
    bool running() const;
    int  cycles_per_count() const;
    void check_settings(Findings &findings, double time_s) const;
    void present();
    void sync_trip(bool fault_pin_low);

    volatile EPWM_REGS &r_;
    int                 number_;
    std::int64_t        position_      = 0; ///< SYSCLK cycles since the count was 0
    std::uint16_t       presented_ctr_ = 0;
    bool                high_          = false;
    bool                one_shot_      = false;
};

} // namespace sdre::f28335
