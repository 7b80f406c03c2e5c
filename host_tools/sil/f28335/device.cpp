// SPDX-License-Identifier: MIT
#include "sil/f28335/device.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace sdre::f28335 {
namespace {

constexpr int pin_gate_enable = 6;
constexpr int pin_trip        = 12;
constexpr int top_vectors     = 128;

// Chosen: a poll of a register costs about this much; it makes a polling loop's time-out worth testing.
constexpr std::int64_t poll_cycles = 20;
// Chosen: a pass of the background loop, short beside the 96 us of an octet on the line.
constexpr std::int64_t background_ticks = 3750;
// Chosen: the unit timer follows the PWM within a few cycles; within this the shaft stands still.
constexpr std::int64_t same_instant_ticks = 150;

Device *the_device = nullptr; // hooks are plain functions, so they need one

/// Registers go back to reset before any unit reads them.
Surroundings &after_reset(Surroundings &s)
{
    reset_registers();
    return s;
}

} // namespace

Device::Device(Surroundings &surroundings, Firmware firmware, const DeviceOptions &options)
    : surroundings_(after_reset(surroundings)), options_(options),
      clock_(options.clock), pwm_{PwmUnit(EPwm1Regs, 1), PwmUnit(EPwm2Regs, 2),
                                  PwmUnit(EPwm3Regs, 3)},
      adc_([this](int side, int number) { return surroundings_.analog_V(side, number); }),
      main_([firmware] { firmware(); })
{
    the_device = this;
    clock_.sync(now_, findings_, time_s());
    guard_.remember();
}

Device::~Device()
{
    the_device = nullptr;
}

Device &Device::current()
{
    return *the_device;
}

void Device::run_for(double time_s)
{
    target_ = now_ + std::llround(time_s * tick_Hz);
    while (now_ < target_ && !stopped()) {
        main_.resume();
    }
}

bool Device::fault_pin_trips() const
{
    return fault_low_ && Gpio::is_muxed(pin_trip, 1);
}

double Device::into_period_s() const
{
    return static_cast<double>(now_ - period_began_) / tick_Hz;
}

/// Takes everything the firmware has written since the last look.
void Device::sync()
{
    const double t = time_s();
    guard_.check(eallow_, findings_, t);
    clock_.sync(now_, findings_, t);
    watchdog_.sync();
    pie_.sync();
    gpio_.sync();
    for (PwmUnit &unit : pwm_) {
        unit.sync(fault_pin_trips(), findings_, t);
    }
    adc_.sync(now_);
    encoder_.sync(findings_, t);
    timer_.sync();
    sci_.sync(findings_, t);
    reset_ = reset_ || watchdog_.reset_wanted();
    for (int n = 0; n < 3; n++) {
        if (pwm_[static_cast<std::size_t>(n)].take_trip_interrupt()) {
            pie_.request(2, n + 1, intm_, findings_, t);
        }
    }
    guard_.remember();
    update_legs();
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
    const std::int64_t timeout = encoder_.cycles_to_timeout();
    take(timeout < 0 ? -1 : clock_.ticks_for(timeout));
    take(adc_.ticks_to_end(now_));
    take(watchdog_.ticks_to_reset());
    take(sci_.ticks_to_event(now_));
    return next < 0 ? -1 : std::max<std::int64_t>(1, next);
}

void Device::begin_control_period()
{
    period_began_ = now_;
    ControlPeriod period;
    period.tbprd            = EPwm1Regs.TBPRD;
    period.cycles_per_count = pwm_[0].cycles_per_count();
    period.sysclk_Hz        = clock_.sysclk_Hz();
    for (std::size_t n = 0; n < 3; n++) {
        if (!pwm_[n].at_period()) {
            findings_.add(Finding::unsupported, "the three legs are out of step", time_s());
        }
        period.legs[n]               = pwm_[n].begin_period();
        const std::optional<int> gap = shortest_gap_cnt(period.legs[n].gates);
        if (legs_[n] && !period.legs[n].complementary) {
            findings_.add(Finding::unsupported,
                          fmt::format("the gates of leg {} are not made from one signal", n + 1),
                          time_s());
        }
        // Half a count: the wanted time need not be a whole number of counts.
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
    encoder_.move(surroundings_.shaft(0.0));
}

void Device::step_pwm(std::int64_t cycles)
{
    std::array<PwmEvents, 3> events;
    for (std::size_t n = 0; n < 3; n++) {
        events[n] = pwm_[n].step(cycles);
    }
    if (events[0].period) {
        begin_control_period();
    }
    for (int n = 0; n < 3; n++) {
        const PwmEvents &e = events[static_cast<std::size_t>(n)];
        if (e.soc_a) {
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
        encoder_.move(surroundings_.shaft(into_period_s()));
    }
    encoder_.latch();
    if (encoder_.take_interrupt()) {
        pie_.request(5, 1, intm_, findings_, time_s());
    }
}

void Device::elapse(std::int64_t ticks)
{
    now_ += ticks;
    const std::int64_t cycles = clock_.cycles(ticks);
    watchdog_.pass(ticks);
    step_pwm(cycles);
    step_encoder(cycles);
    if (timer_.step(cycles)) {
        pie_.request(1, 7, intm_, findings_, time_s());
    }
    if (adc_.ticks_to_end(now_) == 0 && adc_.finish()) {
        pie_.request(1, 1, intm_, findings_, time_s());
    }
    sci_.pass(now_, clock_);
    guard_.remember();
    if (watchdog_.reset_wanted()) {
        reset_ = true;
        findings_.add(Finding::watchdog_reset, "the watchdog has reset the device", time_s());
        update_legs();
    }
}

/// Lets time pass, on the firmware's stack, with the interrupts that fall into it.
void Device::wait_ticks(std::int64_t ticks)
{
    const std::int64_t end = now_ + ticks;
    for (;;) {
        sync();
        dispatch();
        while (reset_ || now_ >= target_) {
            main_.suspend();
            sync(); // what happened meanwhile, from outside
        }
        if (now_ >= end) {
            return;
        }
        std::int64_t       step  = std::min(end, target_) - now_;
        const std::int64_t event = ticks_to_event();
        step                     = event > 0 ? std::min(step, event) : step;
        elapse(step);
    }
}

void Device::dispatch()
{
    while (!intm_ && !reset_) {
        const std::optional<int> vector = pie_.take();
        if (!vector) {
            return;
        }
        serve(*vector);
    }
}

void Device::serve(int vector)
{
    PINT const *table = reinterpret_cast<PINT const *>(&PieVectTable);
    PINT        isr   = vector < top_vectors ? table[vector] : nullptr;
    if (isr == nullptr) {
        findings_.add(Finding::interrupt, fmt::format("interrupt {} has no vector", vector),
                      time_s());
        return;
    }
    const bool eallow = eallow_;
    eallow_           = false; // status register saved and cleared, and restored on return
    intm_             = true;
    if (late_cycles_ > 0) {
        const std::int64_t late = late_cycles_;
        late_cycles_            = 0;
        spend_cycles(late);
    }
    isr();
    sync();
    intm_   = false;
    eallow_ = eallow;
}

void Device::instruction(const char *text)
{
    sync(); // under the protection that held until here
    if (std::strcmp(text, " EALLOW") == 0) {
        eallow_ = true;
    } else if (std::strcmp(text, " EDIS") == 0) {
        eallow_ = false;
    } else if (std::strcmp(text, " setc INTM") == 0) {
        intm_ = true;
    } else if (std::strcmp(text, " clrc INTM") == 0) {
        intm_ = false;
        dispatch();
    } else if (std::strcmp(text, " NOP") == 0) {
        wait_ticks(intm_ ? clock_.ticks_for(poll_cycles) : background_ticks);
    } else if (std::strstr(text, "NOP") == nullptr && std::strstr(text, "DBGM") == nullptr) {
        findings_.add(Finding::unsupported, fmt::format("instruction{}", text), time_s());
    }
}

void Device::wait_s(double time_s)
{
    wait_ticks(std::llround(time_s * tick_Hz));
}

void Device::spend_cycles(std::int64_t cycles)
{
    wait_ticks(clock_.ticks_for(cycles));
}

void Device::calibrate_adc()
{
    sync();
    adc_.calibrate(findings_, time_s());
}

void Device::serial_read_access()
{
    sync();
    sci_.read_access();
    guard_.remember();
}

void Device::serial_write_access()
{
    sync();
    sci_.write_access();
    guard_.remember();
}

void Device::watchdog_key_access()
{
    sync();
}

void Device::set_fault_pin(bool low)
{
    fault_low_ = low;
    gpio_.drive(pin_trip, !low);
    sync();
}

void Device::lose_crystal()
{
    clock_.lose_crystal();
    sync();
}

} // namespace sdre::f28335
