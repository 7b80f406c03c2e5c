// SPDX-License-Identifier: MIT
/// Crystal, PLL and dividers. The model's time counts ticks of 1 / 150 MHz; SYSCLKOUT is a ratio of that.
#pragma once

#include <cstdint>

#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

constexpr double       tick_Hz       = 150e6;
constexpr std::int64_t ticks_per_osc = 5; ///< 30 MHz crystal

/// How the crystal and the PLL may fail.
struct ClockFaults {
    bool never_locks = false;
    bool limp_mode   = false; ///< no crystal from the start
};

class Clock {
public:
    explicit Clock(const ClockFaults &faults);

    void sync(std::int64_t now_ticks, Findings &findings, double time_s);
    /// The crystal dies: the PLL idles at a few MHz and MCLKSTS says so, unless the detector is off.
    void lose_crystal();

    /// SYSCLKOUT cycles within a time that passes now.
    std::int64_t cycles(std::int64_t ticks);
    /// Ticks until so many cycles have passed; at least one.
    std::int64_t ticks_for(std::int64_t cycles) const;
    double       sysclk_Hz() const;
    double       hspclk_Hz() const;
    double       lspclk_Hz() const;

private:
    void update_ratio();

    ClockFaults   faults_;
    bool          limp_        = false;
    std::int64_t  lock_at_     = 0;
    bool          locking_     = false;
    std::uint16_t pllcr_       = 0;
    std::int64_t  numerator_   = 1; ///< SYSCLKOUT cycles per tick
    std::int64_t  denominator_ = 20;
    std::int64_t  remainder_   = 0;
};

} // namespace sdre::f28335
