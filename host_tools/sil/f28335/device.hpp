// SPDX-License-Identifier: MIT
/// A virtual TMS320F28335: runs firmware against the register model.
///
/// Registers are plain memory. At the firmware's hooks the model takes the written values and
/// refreshes the values to be read. Hooks are EALLOW, EDIS, EINT, DINT, asm(), DELAY_US and the
/// return of an ISR. The accesses that the headers count are hooks too (SCIRXBUF, SCITXBUF, WDKEY, and the mailbox flags
/// of eCAN-A).
///
/// Time passes in asm(" NOP"), in DELAY_US, and where a test advances it. Between two hooks the
/// firmware takes no time. Only one device may exist at a time, because the registers exist once.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "sil/f28335/adc_unit.hpp"
#include "sil/f28335/can_bus.hpp"
#include "sil/f28335/clock.hpp"
#include "sil/f28335/cpu_timer.hpp"
#include "sil/f28335/ecan_unit.hpp"
#include "sil/f28335/encoder_unit.hpp"
#include "sil/f28335/findings.hpp"
#include "sil/f28335/gpio.hpp"
#include "sil/f28335/guarded.hpp"
#include "sil/f28335/hold_unit.hpp"
#include "sil/f28335/pie.hpp"
#include "sil/f28335/pwm_unit.hpp"
#include "sil/f28335/registers.hpp"
#include "sil/f28335/runner.hpp"
#include "sil/f28335/sci_unit.hpp"
#include "sil/f28335/surroundings.hpp"
#include "sil/f28335/watchdog.hpp"

/// The stack of the image, filled as code_start fills it. No firmware runs on it here: a test may
/// write it.
extern "C" volatile Uint16 codestart_stack[0x700];

namespace sdre::f28335 {

/// The watchdog's own pulse: 512 cycles of the crystal.
constexpr double watchdog_pulse_s = 512 / 30e6;

struct DeviceOptions {
    ClockFaults clock;
    double      dead_time_s = 0.0; ///< required by the bridge; a shorter one is reported
    double  xrs_low_s = 0.2; ///< the reset pin before the start: a supervisor's time after power-on
    AtLoad  at_load   = AtLoad::old_values;
    bool    own_stack = can_switch_stacks; ///< of the firmware; false: by passes (runner.hpp)
    CanBus *can_bus   = nullptr;           ///< outlives the device; null: one of its own
};

class Device {
public:
    /// Power-up: registers as after reset, watchdog stopped as the start-up code leaves it.
    Device(Surroundings &surroundings, const Firmware &firmware, const DeviceOptions &options);
    Device(Surroundings &surroundings, int (*main)(), const DeviceOptions &options)
        : Device(surroundings, Firmware{main}, options)
    {
    }
    ~Device();
    Device(const Device &)            = delete;
    Device &operator=(const Device &) = delete;

    void run_for(double time_s);
    /// Until `done` says so or the time is over; false in the latter case.
    template <typename Done>
    bool run_until(const Done &done, double longest_s, double step_s = 25e-6)
    {
        const double end_s = time_s() + longest_s;
        while (!done()) {
            if (time_s() >= end_s || stopped()) {
                return false;
            }
            run_for(step_s);
        }
        return true;
    }

    double time_s() const
    {
        return static_cast<double>(now_) / tick_Hz;
    }
    /// main() has returned, or the watchdog has reset the device.
    bool stopped() const
    {
        return reset_ || main_.finished();
    }
    bool was_reset() const
    {
        return reset_;
    }
    /// Processor cycles from main() to the first instant at which gates and driver enable are outputs and low;
    /// -1: not yet.
    std::int64_t pins_safe_cycles() const
    {
        return pins_safe_;
    }
    /// Level of the brake chopper's output.
    bool chopper_is_on() const
    {
        return chopper_high_;
    }
    /// Level of the holding brake's output.
    bool brake_is_released() const
    {
        return brake_high_;
    }
    const Findings &findings() const
    {
        return findings_;
    }
    SciUnit &serial()
    {
        return sci_;
    }
    EcanUnit &can()
    {
        return can_;
    }
    const Clock &clock() const
    {
        return clock_;
    }

    /// Length of a pass of the background loop.
    void set_pass(double time_s);

    // External faults.
    void set_fault_pin(bool low);
    /// Level that the board drives onto a plain input.
    void set_input(int pin, bool high)
    {
        gpio_.drive(pin, high);
    }
    void lose_crystal();
    /// No conversion is started from now on.
    void lose_trigger()
    {
        trigger_lost_ = true;
    }
    /// The program masks every interrupt from now on and goes on otherwise.
    void mask_interrupts()
    {
        masked_ = true;
    }
    /// The next interrupt is served this late, as if another one held the processor.
    void delay_next_interrupt(std::int64_t cycles)
    {
        late_cycles_ = cycles;
    }

    // Firmware's hooks.
    void instruction(const char *text);
    void wait_s(double time_s);
    /// The flash is erased or written for this long.
    void change_flash(double time_s);
    void spend_cycles(std::int64_t cycles);
    void calibrate_adc();
    void serial_read_access();
    void serial_write_access();
    void can_access();
    void watchdog_key_access();

    /// The device that the hooks belong to.
    static Device &current();

private:
    void               sync();
    void               update_legs();
    bool               is_high(int pin, const HoldUnit &unit) const;
    void               update_outputs();
    bool               pins_are_safe() const;
    void               wait_ticks(std::int64_t ticks);
    bool               wait_towards(std::int64_t end, bool resumed);
    std::int64_t       idle_ticks();
    void               pass_or_idle();
    std::int64_t       ticks_to_event() const;
    void               elapse(std::int64_t ticks);
    void               step_pwm(std::int64_t cycles);
    void               begin_control_period(Count count);
    void               step_encoder(std::int64_t cycles);
    void               dispatch();
    std::optional<int> take_interrupt();
    void               serve(int vector, unsigned ier_bit);
    bool               fault_pin_trips() const;
    double             into_period_s() const;

    Surroundings               &surroundings_;
    DeviceOptions               options_;
    Findings                    findings_;
    std::int64_t                now_          = 0; ///< ticks of 1 / 150 MHz
    std::int64_t                outside_      = 0; ///< how far the device was asked to run
    std::int64_t                target_       = 0; ///< the firmware is suspended there
    std::int64_t                period_began_ = 0;
    bool                        reset_        = false;
    bool                        intm_         = true; ///< interrupts masked
    bool                        eallow_       = false;
    bool                        fault_low_    = false;
    std::int64_t                late_cycles_  = 0;
    std::int64_t                cycles_       = 0; ///< of the processor
    std::int64_t                pins_safe_    = -1;
    std::optional<std::int64_t> idle_end_;  ///< without a stack: of the wait between two passes
    std::int64_t                polls_ = 0; ///< with interrupts masked, in a row
    // Chosen: short beside the 96 us of an octet on the line.
    std::int64_t           background_ticks_ = 3750; ///< of a pass of the background loop
    bool                   trigger_lost_     = false;
    bool                   masked_           = false;
    std::array<bool, 3>    legs_{};
    bool                   chopper_high_ = false; ///< GPIO8
    bool                   brake_high_   = false; ///< GPIO10
    Clock                  clock_;
    Watchdog               watchdog_;
    Pie                    pie_;
    Gpio                   gpio_;
    std::array<PwmUnit, 3> pwm_;
    HoldUnit               chopper_{EPwm5Regs, 5};
    HoldUnit               brake_{EPwm6Regs, 6};
    AdcUnit                adc_;
    EncoderUnit            encoder_;
    CpuTimer               timer_;
    CpuTimer               timer1_;
    SciUnit                sci_;
    CanBus                 own_bus_;
    EcanUnit               can_;
    Guard                  guard_;
    Runner                 main_;
};

} // namespace sdre::f28335
