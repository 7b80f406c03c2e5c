// SPDX-License-Identifier: MIT
#include "sil/f28335/device.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace sdre::f28335 {
namespace {

constexpr int pin_trip      = 12;
constexpr int pin_direction = 27;
constexpr int top_vectors   = 128;

// Places in the vector table: INT13; the PIE's, eight of each group.
constexpr int vector_int13 = 13;
constexpr int first_of_pie = 32;
constexpr int per_group    = 8;

// Chosen: a poll of a register costs about this much; it makes a polling loop's time-out worth testing.
constexpr std::int64_t poll_cycles = 20;
// Derived: 1.2 times the polls of the longest such loop, the lock time of the PLL. Beyond this
// count the firmware loops without interrupts for good, as the loader does.
constexpr std::int64_t most_polls = 40'000;

Device *the_device = nullptr; // hooks are plain functions, so they need one

/// Registers go back to reset before any unit reads them.
Surroundings &after_reset(Surroundings &s)
{
    reset_registers();
    return s;
}

} // namespace

Device::Device(Surroundings &surroundings, const Firmware &firmware, const DeviceOptions &options)
    : surroundings_(after_reset(surroundings)), options_(options), clock_(options.clock),
      watchdog_(options.xrs_low_s), pwm_{PwmUnit(EPwm1Regs, 1), PwmUnit(EPwm2Regs, 2),
                                         PwmUnit(EPwm3Regs, 3)},
      adc_([this](int side, int number) { return surroundings_.analog_V(side, number); }),
      timer_(CpuTimer0Regs, 0), timer1_(CpuTimer1Regs, 1),
      can_(options.can_bus != nullptr ? *options.can_bus : own_bus_),
      main_(firmware, options.own_stack)
{
    the_device = this;
    std::fill(std::begin(codestart_stack), std::end(codestart_stack), Uint16{0xC0DE});
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
    outside_ += std::llround(time_s * tick_Hz); // a pass may be ahead of it
    target_ = outside_;
    while (now_ < outside_ && !stopped()) {
        if (main_.has_stack()) {
            main_.resume();
        } else {
            try {
                pass_or_idle();
            } catch (const Abandoned &) {
                return; // by a reset
            }
        }
    }
}

/// Without a stack of its own: one pass, and then what main() waits after it, as far as the target.
void Device::pass_or_idle()
{
    const bool resumed = idle_end_.has_value();
    if (!resumed) {
        const std::int64_t target = target_;
        main_.pass();
        target_   = target;
        idle_end_ = now_ + idle_ticks();
    }
    if (wait_towards(*idle_end_, resumed)) {
        idle_end_.reset();
    }
}

bool Device::fault_pin_trips() const
{
    return fault_low_ && Gpio::is_muxed(pin_trip, 1);
}

void Device::set_pass(double time_s)
{
    background_ticks_ = std::llround(time_s * tick_Hz);
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
    if (pins_safe_ < 0 && pins_are_safe()) {
        pins_safe_ = cycles_;
    }
    for (PwmUnit &unit : pwm_) {
        unit.sync(fault_pin_trips(), findings_, t);
    }
    chopper_.sync(fault_pin_trips(), findings_, t);
    brake_.sync(fault_pin_trips(), findings_, t);
    adc_.sync(now_);
    encoder_.sync(findings_, t);
    timer_.sync();
    timer1_.sync();
    sci_.drive_direction(Gpio::is_output(pin_direction) && Gpio::is_muxed(pin_direction, 0)
                             ? std::optional<bool>(gpio_.output_high(pin_direction))
                             : std::nullopt,
                         now_);
    sci_.sync(findings_, t);
    can_.sync(now_, clock_, findings_, t);
    reset_ = reset_ || watchdog_.reset_wanted();
    for (int n = 0; n < 3; n++) {
        if (pwm_[static_cast<std::size_t>(n)].take_trip_interrupt()) {
            pie_.request(2, n + 1, intm_, findings_, t);
        }
    }
    guard_.remember();
    update_legs();
    update_outputs();
}

/// Lets time pass, on the firmware's stack, with the interrupts that fall into it.
void Device::wait_ticks(std::int64_t ticks)
{
    const std::int64_t end = now_ + ticks;
    for (bool resumed = false; !wait_towards(end, resumed); resumed = true) {
        if (!main_.suspend(reset_)) {
            target_ = end + 1; // the pass goes on
        }
    }
}

/// False: before this time, the device has been reset or what is outside has its turn.
/// @param resumed After that, in the same wait.
bool Device::wait_towards(std::int64_t end, bool resumed)
{
    for (;; resumed = false) {
        sync();
        if (!resumed) {
            dispatch();
        }
        if (reset_ || now_ >= target_) {
            return false;
        }
        if (now_ >= end) {
            return true;
        }
        std::int64_t       step  = std::min(end, target_) - now_;
        const std::int64_t event = ticks_to_event();
        step                     = event > 0 ? std::min(step, event) : step;
        elapse(step);
    }
}

/// How long an idle instruction takes.
std::int64_t Device::idle_ticks()
{
    polls_ = intm_ ? polls_ + 1 : 0;
    return intm_ && polls_ <= most_polls ? clock_.ticks_for(poll_cycles) : background_ticks_;
}

/// Vector of the interrupt to serve now. Those of the PIE come before INT13, CPU timer 1.
std::optional<int> Device::take_interrupt()
{
    if (const std::optional<int> vector = pie_.take()) {
        return vector;
    }
    if ((IFR & IER & M_INT13) == 0U) {
        return std::nullopt;
    }
    IFR = static_cast<Uint16>(IFR & ~M_INT13);
    return vector_int13;
}

void Device::dispatch()
{
    while (!intm_ && !masked_ && !reset_) {
        const std::optional<int> vector = take_interrupt();
        if (!vector) {
            return;
        }
        serve(*vector,
              *vector == vector_int13 ? M_INT13 : 1U << ((*vector - first_of_pie) / per_group));
    }
}

/// @param ier_bit The processor takes it out of IER until the return.
void Device::serve(int vector, unsigned ier_bit)
{
    PINT const *table = reinterpret_cast<PINT const *>(&PieVectTable);
    PINT        isr   = vector < top_vectors ? table[vector] : nullptr;
    if (isr == nullptr) {
        findings_.add(Finding::interrupt, fmt::format("interrupt {} has no vector", vector),
                      time_s());
        return;
    }
    const bool eallow = eallow_;
    const auto ier    = IER;
    eallow_           = false; // status register saved and cleared, and restored on return
    intm_             = true;
    IER               = static_cast<Uint16>(ier & ~ier_bit);
    if (late_cycles_ > 0) {
        const std::int64_t late = late_cycles_;
        late_cycles_            = 0;
        spend_cycles(late);
    }
    isr();
    sync();
    intm_   = false;
    IER     = ier;
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
        wait_ticks(idle_ticks());
    } else if (std::strstr(text, "NOP") == nullptr && std::strstr(text, "DBGM") == nullptr) {
        findings_.add(Finding::unsupported, fmt::format("instruction{}", text), time_s());
    }
}

void Device::wait_s(double time_s)
{
    wait_ticks(std::llround(time_s * tick_Hz));
}

void Device::change_flash(double time_s)
{
    if (!intm_) {
        findings_.add(Finding::flash, "flash changed with interrupts on", this->time_s());
    }
    if (watchdog_.ticks_to_reset() >= 0) {
        findings_.add(Finding::flash, "flash changed while the watchdog runs", this->time_s());
    }
    wait_s(time_s);
}

void Device::spend_cycles(std::int64_t cycles)
{
    wait_ticks(clock_.ticks_for(cycles));
}

void Device::calibrate_adc()
{
    sync();
    if (!eallow_) {
        findings_.add(Finding::eallow, "ADC_cal() without EALLOW", time_s());
    }
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

void Device::can_access()
{
    sync();
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
