// SPDX-License-Identifier: MIT
/// The converter: sequencer 1, simultaneous sampling, started by the ePWM units' SOCA.
///
///     code = floor(4096 V / 3), held within 0 .. 4095                          EQ-CONVERTER-1
///     all results after 2.5 + (1 + ACQ_PS) + 5 + (pairs - 1)(3 + ACQ_PS) ADCCLK  EQ-CONVERTER-2
///
/// All pairs are sampled at the trigger: the true delay of some 0.1 us is negligible for currents
/// and shaft. With a window of 160 ns or less, the first pair of a sequence reads full scale
/// (advisory).
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "sil/f28335/clock.hpp"
#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

class AdcUnit {
public:
    /// Voltage at an input: side 0 = A, 1 = B; number 0 .. 7.
    using Input = std::function<double(int side, int number)>;

    explicit AdcUnit(Input input);

    void sync(std::int64_t now_ticks);
    /// ADC_cal() was called.
    void         calibrate(Findings &findings, double time_s);
    void         start_of_conversion(std::int64_t now_ticks, const Clock &clock, Findings &findings,
                                     double time_s);
    std::int64_t ticks_to_end(std::int64_t now_ticks) const; ///< -1: idle
    /// Ends the conversion that is due; true when it asks for an interrupt.
    bool finish();

private:
    void present() const;
    int  pairs() const;

    Input                         input_;
    std::array<std::uint16_t, 16> codes_{};
    bool                          busy_       = false;
    bool                          flag_       = false; ///< INT_SEQ1
    bool                          calibrated_ = false;
    std::int64_t                  end_ticks_  = 0;
    std::int64_t                  powered_at_ = -1; ///< -1: not powered
    int                           state_      = 0;  ///< of the sequencer: pair that comes next
    int                           first_      = 0;  ///< pair at which the running conversion began
    int                           running_pairs_ = 0;
};

} // namespace sdre::f28335
