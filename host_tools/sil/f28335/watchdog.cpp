// SPDX-License-Identifier: MIT
#include "sil/f28335/watchdog.hpp"

#include <algorithm>

#include "sil/f28335/clock.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {
namespace {

constexpr unsigned wdps         = 0x07;
constexpr unsigned wdchk        = 0x38;
constexpr unsigned good         = 0x28;
constexpr unsigned wddis        = 0x40;
constexpr unsigned wdflag       = 0x80;
constexpr unsigned no_key       = 0x100; // cannot be written by a key of eight bits
constexpr unsigned override_bit = 0x01;

// 8192 cycles at a quarter of the crystal's rate and 512 of the crystal's.
constexpr double xrs_looked_at_s = (8192 * 4 + 512) / 30e6;

} // namespace

/// Stopped: that is what the start-up code before main() leaves.
Watchdog::Watchdog(double xrs_low_s) : flag_(xrs_low_s < xrs_looked_at_s)
{
    presented_wdcr_           = static_cast<std::uint16_t>(wddis | (flag_ ? wdflag : 0U));
    SysCtrlRegs.WDCR          = presented_wdcr_;
    SysCtrlRegs.SCSR          = 0; // WDOVERRIDE reads as written here: 1 means "cleared now"
    SysCtrlRegs.WDKEY_word[0] = no_key;
}

void Watchdog::take_key()
{
    const unsigned key        = SysCtrlRegs.WDKEY_word[0];
    SysCtrlRegs.WDKEY_word[0] = no_key;
    if (key == no_key) {
        return;
    }
    if (key == 0x55U) {
        half_key_ = true;
    } else if (key == 0xAAU) {
        counter_ticks_ = half_key_ ? 0 : counter_ticks_;
        half_key_      = false;
    } else {
        reset_ = true; // any other value
    }
}

void Watchdog::sync()
{
    take_key();
    locked_             = locked_ || (SysCtrlRegs.SCSR & override_bit) != 0U;
    SysCtrlRegs.SCSR    = static_cast<std::uint16_t>(SysCtrlRegs.SCSR & ~override_bit);
    const unsigned wdcr = SysCtrlRegs.WDCR;
    if (wdcr != presented_wdcr_) {
        reset_    = reset_ || (wdcr & wdchk) != good;
        disabled_ = (wdcr & wddis) != 0U && !locked_;
        prescale_ = wdcr & wdps;
        flag_     = flag_ && (wdcr & wdflag) == 0U; // written 1 to clear
    }
    // The check bits read as zero.
    presented_wdcr_ =
        static_cast<std::uint16_t>((disabled_ ? wddis : 0U) | (flag_ ? wdflag : 0U) | prescale_);
    SysCtrlRegs.WDCR   = presented_wdcr_;
    SysCtrlRegs.WDCNTR = static_cast<std::uint16_t>(
        std::min<std::int64_t>(255, 256 * counter_ticks_ / period_ticks()));
}

std::int64_t Watchdog::period_ticks() const
{
    const std::int64_t factor = prescale_ <= 1U ? 1 : 1LL << (prescale_ - 1U);
    return 256LL * 512 * factor * ticks_per_osc;
}

void Watchdog::pass(std::int64_t ticks)
{
    if (disabled_) {
        return;
    }
    counter_ticks_ += ticks;
    reset_ = reset_ || counter_ticks_ >= period_ticks();
}

std::int64_t Watchdog::ticks_to_reset() const
{
    return disabled_ ? -1 : std::max<std::int64_t>(0, period_ticks() - counter_ticks_);
}

} // namespace sdre::f28335
