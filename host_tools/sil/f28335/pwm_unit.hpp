// SPDX-License-Identifier: MIT
/// One ePWM unit: time base, shadow compare, trip zone, events. Up-down counting only.
#pragma once

#include <cstdint>

#include "sil/f28335/findings.hpp"
#include "sil/f28335/gate_edges.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

/// Events of one instant.
struct PwmEvents {
    bool zero      = false;
    bool period    = false;
    bool soc_a     = false;
    bool interrupt = false; ///< of the event trigger
};

class PwmUnit {
public:
    PwmUnit(volatile EPWM_REGS &registers, int number);

    /// Takes the written registers, refreshes those to be read. `fault_pin_low`: TZ1 is active.
    void sync(bool fault_pin_low, Findings &findings, double time_s);
    /// SYSCLK cycles to the next ZERO or PRD; -1: the counter stands.
    std::int64_t cycles_to_event() const;
    PwmEvents    step(std::int64_t cycles);

    bool running() const;
    bool tripped() const
    {
        return one_shot_;
    }
    /// True once per trip with TZEINT.OST.
    bool take_trip_interrupt();
    bool at_period() const; ///< the counter has its top value at this very cycle
    int  cycles_per_count() const;
    /// The active compare values change at ZERO and at PRD.
    bool two_updates() const
    {
        return r_.CMPCTL.bit.LOADAMODE == CC_CTR_ZERO_PRD;
    }
    bool at_zero() const; ///< the counter is at 0 at this very cycle
    /// Gates over the control period that begins now.
    LegPeriod begin_period(Count count, AtLoad at_load);
    /// Trip action on the outputs, 0 HiZ, 1 high, 2 low, 3 nothing; the worse of A and B.
    int trip_action_a() const;
    int trip_action_b() const;

private:
    std::int64_t half_cycles() const;
    void         present();
    void         sync_trip(bool fault_pin_low);
    void         check_settings(Findings &findings, double time_s) const;
    bool         count_event(unsigned select, unsigned enable, unsigned every, int &count,
                             const PwmEvents &now) const;

    volatile EPWM_REGS &r_;
    int                 number_;
    std::int64_t        position_       = 0; ///< SYSCLK cycles since ZERO
    std::uint16_t       presented_ctr_  = 0;
    int                 cmpa_           = 0; ///< active
    int                 cmpb_           = 0;
    int                 cmpa_before_    = 0; ///< the last load
    int                 cmpb_before_    = 0;
    std::uint16_t       aqctla_         = 0; ///< at the start of this control period
    bool                began_          = false;
    bool                one_shot_       = false;
    bool                trip_interrupt_ = false;
    int                 soc_a_count_    = 0;
    int                 int_count_      = 0;
    std::uint16_t       tz_flags_       = 0;
    std::uint16_t       et_flags_       = 0;
    LegMemory           memory_;
};

} // namespace sdre::f28335
