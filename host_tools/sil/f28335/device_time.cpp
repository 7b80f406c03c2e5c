// SPDX-License-Identifier: MIT
// The device's units as time passes, and their effect on the bridge.
#include "sil/f28335/device.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace sdre::f28335 {
namespace {

constexpr int pin_gate_enable = 6;
constexpr int pin_chopper     = 8;
constexpr int pin_brake       = 10;

// Chosen: the unit timer follows the PWM within a few cycles; within this the shaft stands still.
constexpr std::int64_t same_instant_ticks = 150;

} // namespace

bool Device::pins_are_safe() const
{
    for (int pin = 0; pin <= pin_gate_enable; pin++) {
        if (!Gpio::is_muxed(pin, 0) || !Gpio::is_output(pin) || gpio_.output_high(pin)) {
            return false;
        }
    }
    return true;
}

void Device::update_legs()
{
    std::array<bool, 3> now{};
    for (int n = 0; n < 3; n++) {
        const PwmUnit &unit   = pwm_[static_cast<std::size_t>(n)];
        const bool     muxed  = Gpio::is_muxed(2 * n, 1) && Gpio::is_muxed(2 * n + 1, 1);
        const bool     driver = gpio_.output_high(pin_gate_enable);
        const int      a      = unit.trip_action_a();
        const int      b      = unit.trip_action_b();
        const bool     forced_off =
            a != TZ_FORCE_HI && a != TZ_NO_CHANGE && b != TZ_FORCE_HI && b != TZ_NO_CHANGE;
        now[static_cast<std::size_t>(n)] =
            muxed && driver && !reset_ && !(unit.tripped() && forced_off);
        if (unit.tripped() && muxed && (a == TZ_HIZ || b == TZ_HIZ)) {
            findings_.add(Finding::trip,
                          fmt::format("a trip leaves the gates of leg {} floating", n + 1),
                          time_s());
        }
        if (fault_low_ && now[static_cast<std::size_t>(n)]) {
            findings_.add(Finding::trip,
                          fmt::format("the fault input is active and leg {} goes on", n + 1),
                          time_s());
        }
    }
    if (now != legs_) {
        legs_ = now;
        surroundings_.legs_change(legs_, into_period_s());
    }
}

/// A pin that is no output is pulled down by the board.
bool Device::is_high(int pin, const HoldUnit &unit) const
{
    const bool by_unit = Gpio::is_muxed(pin, 1) && unit.high();
    const bool plain   = Gpio::is_muxed(pin, 0) && gpio_.output_high(pin);
    return !reset_ && (by_unit || plain);
}

void Device::update_outputs()
{
    const bool chopper = is_high(pin_chopper, chopper_);
    if (chopper != chopper_high_) {
        chopper_high_ = chopper;
        surroundings_.chopper_changes(chopper, into_period_s());
    }
    const bool brake = is_high(pin_brake, brake_);
    if (brake != brake_high_) {
        brake_high_ = brake;
        surroundings_.brake_changes(brake, into_period_s());
    }
}

std::int64_t Device::ticks_to_event() const
{
    std::int64_t next = -1;
    const auto   take = [&next](std::int64_t ticks) {
        if (ticks >= 0 && (next < 0 || ticks < next)) {
            next = ticks;
        }
    };
    for (const PwmUnit &unit : pwm_) {
        const std::int64_t cycles = unit.cycles_to_event();
        take(cycles < 0 ? -1 : clock_.ticks_for(cycles));
    }
    for (const HoldUnit *unit : {&chopper_, &brake_}) {
        const std::int64_t cycles = unit->cycles_to_event();
        take(cycles < 0 ? -1 : clock_.ticks_for(cycles));
    }
    const std::int64_t timeout = encoder_.cycles_to_timeout();
    take(timeout < 0 ? -1 : clock_.ticks_for(timeout));
    const std::int64_t timer1 = timer1_.cycles_to_interrupt();
    take(timer1 < 0 ? -1 : clock_.ticks_for(timer1));
    take(adc_.ticks_to_end(now_));
    take(watchdog_.ticks_to_reset());
    take(sci_.ticks_to_event(now_));
    take(can_.ticks_to_event(now_));
    return next < 0 ? -1 : std::max<std::int64_t>(1, next);
}

void Device::begin_control_period(Count count)
{
    period_began_ = now_;
    ControlPeriod period;
    period.counts           = period_counts(EPwm1Regs.TBPRD, count);
    period.cycles_per_count = pwm_[0].cycles_per_count();
    period.sysclk_Hz        = clock_.sysclk_Hz();
    for (std::size_t n = 0; n < 3; n++) {
        if (count == Count::up ? !pwm_[n].at_zero() : !pwm_[n].at_period()) {
            findings_.add(Finding::unsupported, "the three legs are out of step", time_s());
        }
        period.legs[n]               = pwm_[n].begin_period(count, options_.at_load);
        const std::optional<int> gap = shortest_gap_cnt(period.legs[n].gates);
        if (legs_[n] && !period.legs[n].complementary) {
            findings_.add(Finding::unsupported,
                          fmt::format("the gates of leg {} are not made from one signal", n + 1),
                          time_s());
        }
        // Tolerance of half a count: the required time need not be a whole number of counts.
        if (legs_[n] && gap &&
            period.seconds(*gap) + 0.5 * period.seconds(1) < options_.dead_time_s) {
            findings_.add(Finding::dead_time,
                          *gap < 0 ? fmt::format("both switches of leg {} are on", n + 1)
                                   : fmt::format("dead time of leg {} is {:.2f} us", n + 1,
                                                 1e6 * period.seconds(*gap)),
                          time_s());
        }
    }
    surroundings_.period_begins(period);
    encoder_.move(surroundings_.shaft(0.0), now_);
}

void Device::step_pwm(std::int64_t cycles)
{
    std::array<PwmEvents, 3> events;
    for (std::size_t n = 0; n < 3; n++) {
        events[n] = pwm_[n].step(cycles);
    }
    const bool two = pwm_[0].two_updates();
    if (events[0].period) {
        begin_control_period(two ? Count::down : Count::down_up);
    } else if (events[0].zero && two) {
        begin_control_period(Count::up);
    }
    for (int n = 0; n < 3; n++) {
        const PwmEvents &e = events[static_cast<std::size_t>(n)];
        if (e.soc_a && !trigger_lost_) {
            adc_.start_of_conversion(now_, clock_, findings_, time_s());
        }
        if (e.interrupt) {
            pie_.request(3, n + 1, intm_, findings_, time_s());
        }
    }
}

void Device::step_encoder(std::int64_t cycles)
{
    if (!encoder_.step(cycles)) {
        return;
    }
    if (now_ - period_began_ > same_instant_ticks) {
        encoder_.move(surroundings_.shaft(into_period_s()), now_);
    }
    encoder_.latch(now_);
    if (encoder_.take_interrupt()) {
        pie_.request(5, 1, intm_, findings_, time_s());
    }
}

void Device::elapse(std::int64_t ticks)
{
    now_ += ticks;
    const std::int64_t cycles = clock_.cycles(ticks);
    cycles_ += cycles;
    watchdog_.pass(ticks);
    step_pwm(cycles);
    chopper_.step(cycles);
    brake_.step(cycles);
    step_encoder(cycles);
    if (timer_.step(cycles)) {
        pie_.request(1, 7, intm_, findings_, time_s());
    }
    if (timer1_.step(cycles)) {
        IFR = static_cast<Uint16>(IFR | M_INT13);
    }
    if (adc_.ticks_to_end(now_) == 0 && adc_.finish()) {
        pie_.request(1, 1, intm_, findings_, time_s());
    }
    sci_.pass(now_, clock_);
    can_.pass(now_);
    guard_.remember();
    if (watchdog_.reset_wanted()) {
        reset_ = true;
        findings_.add(Finding::watchdog_reset, "the watchdog has reset the device", time_s());
        update_legs();
    }
    update_outputs();
}

} // namespace sdre::f28335
