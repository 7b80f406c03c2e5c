// SPDX-License-Identifier: MIT
/// The watchdog counts crystal / 512 / prescale up to 256, then resets the device.
///
/// WDFLAG does not record this reset. Some time after the start of any reset the device samples
/// XRS, and sets the flag if the pin is high again (TI's answer on WDFLAG of the 2823x/2833x).
#pragma once

#include <cstdint>

namespace sdre::f28335 {

class Watchdog {
public:
    /// @param xrs_low_s Time for which XRS was low before this start.
    explicit Watchdog(double xrs_low_s);

    /// Takes a change of WDCR and SCSR.
    void sync();
    /// Takes the key written last; call before the next one is written and at every sync().
    void         take_key();
    void         pass(std::int64_t ticks);
    std::int64_t ticks_to_reset() const; ///< -1: stopped
    bool         reset_wanted() const
    {
        return reset_;
    }

private:
    std::int64_t period_ticks() const;

    bool          disabled_       = true;
    bool          locked_         = false; ///< WDOVERRIDE was cleared: cannot be stopped
    bool          half_key_       = false;
    bool          reset_          = false;
    bool          flag_           = false; ///< WDFLAG
    unsigned      prescale_       = 0;
    std::int64_t  counter_ticks_  = 0;
    std::uint16_t presented_wdcr_ = 0;
};

} // namespace sdre::f28335
