// SPDX-License-Identifier: MIT
/// The firmware on the virtual F28335 with a free motor: from power-up, without an end.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sil/board/motor_surroundings.hpp"
#include "sil/f28335/device.hpp"
#include "sil/f28335/flash_unit.hpp"
#include "sil/run/controller.hpp"
#include "sil/run/motor_bench.hpp"
#include "sil/served/axis_switches.hpp"
#include "sil/served/dynamometer.hpp"

namespace sdre {

/// The machine on the bench. A drive file says what its motor and encoder disc are.
struct Machine {
    Machine(const Drive &like, double cogging = 0.0) : drive(like), cogging_share(cogging) {}

    Drive drive;
    double
        cogging_share; ///< amplitude, of the rated torque; slots periods a turn, or 12 a pole pair
};

class ServedDrive {
public:
    /// InputError or DesignError when the board cannot have the drive, or no gains exist.
    /// @param machine Is on the bench; the firmware knows the motor and disc of `drive`.
    /// @param flash   What its flash has at the start; empty: as from the factory.
    /// @param own_stack As of f28335::DeviceOptions.
    ServedDrive(const Drive &drive, const Machine &machine, std::uint64_t seed,
                const f28335::FlashWords &flash = {}, bool own_stack = f28335::can_switch_stacks);
    ServedDrive(const Drive &drive, std::uint64_t seed) : ServedDrive(drive, drive, seed) {}

    /// One control period. A device that its watchdog has reset starts again.
    void period();
    /// Off and on: registers and memory are as after power-on, the flash is as it was.
    void power_cycle();
    /// How long the reset pin stays low after power-on, and after a reset by the watchdog.
    void set_reset_line(double power_on_s, double watchdog_s)
    {
        power_on_low_s_ = power_on_s;
        watchdog_low_s_ = watchdog_s;
    }
    double period_s() const
    {
        return bench_.period_s();
    }
    /// Since the start. While the loader runs, nothing else does: the motor stands still meanwhile.
    double time_s() const
    {
        return before_s_ + device_->time_s();
    }

    // The serial line.
    void send(std::uint8_t octet)
    {
        device_->serial().send(octet);
    }
    /// -1: nothing.
    int take()
    {
        return device_->serial().take();
    }

    /// Outlives resets and power cycles of the device.
    f28335::CanBus &can_bus()
    {
        return can_bus_;
    }
    const f28335::CanBus &can_bus() const
    {
        return can_bus_;
    }
    f28335::EcanUnit &can()
    {
        return device_->can();
    }

    f28335::SciUnit &line()
    {
        return device_->serial();
    }

    // The motor's surroundings.
    Dynamometer &dynamometer()
    {
        return dynamometer_;
    }
    const Dynamometer &dynamometer() const
    {
        return dynamometer_;
    }
    void          set_dc_link_V(double voltage_V);
    AxisSwitches &switches()
    {
        return switches_;
    }
    /// A brake at the drive's output, closed now.
    void set_holding_brake(const HoldingBrakeSettings &settings)
    {
        bench_.board()->set_holding_brake(settings);
    }
    bool brake_is_closed() const
    {
        return bench_.board()->brake_is_closed();
    }
    /// Length of a pass of the firmware's background loop, until a reset.
    void set_pass(double time_s)
    {
        device_->set_pass(time_s);
    }
    /// The trip input, TZ1, until a reset.
    void set_trip_input(bool active)
    {
        device_->set_fault_pin(active);
    }
    /// Turns of the shaft from the index mark.
    double turns() const;
    /// Voltage of the supply; the dc link's own is in plant_state().
    double source_V() const
    {
        return source_V_;
    }
    void break_part(const InjectedFault &fault);
    /// Faults that hold now. A reset ends a fault of the processor.
    const std::vector<InjectedFault> &broken() const
    {
        return broken_;
    }
    /// Nothing is broken and the load is 0. A shaft that the drive does not have is brought to rest.
    void              mend();
    const PlantState &plant_state() const
    {
        return bench_.plant_state();
    }
    bool bridge_on() const
    {
        return bench_.bridge_on();
    }
    int resets() const
    {
        return resets_;
    }
    const f28335::Device &device() const
    {
        return *device_;
    }
    /// From the last start of main() to the first tick.
    double ready_s() const
    {
        return ready_s_;
    }
    /// Findings of the device's model, one line each.
    std::vector<std::string> findings() const;
    const Drive             &drive() const
    {
        return scenario_.drive;
    }

private:
    void power_up(bool after_reset);
    void set_inputs();

    Scenario                        scenario_;
    Controller                      controller_;
    MotorBench                      bench_;
    f28335::MotorSurroundings       surroundings_;
    bool                            own_stack_;
    f28335::CanBus                  can_bus_;
    std::unique_ptr<f28335::Device> device_;
    Dynamometer                     dynamometer_;
    AxisSwitches                    switches_;
    double                          source_V_;
    std::vector<InjectedFault>      broken_;
    int                             resets_         = 0;
    double                          ready_s_        = 0.0;
    unsigned                        power_cycles_   = 0;
    double                          power_on_low_s_ = 0.2;
    double                          watchdog_low_s_ = f28335::watchdog_pulse_s;
    double                          before_s_       = 0.0; ///< of the devices before the last reset
};

/// Dry friction of the bench: 2 % of the rated torque when the motor's file has no friction, else 0. A data sheet seldom has
/// it, and without any a shaft would coast for minutes.
double bench_friction_Nm(const Drive &machine);

/// The scenario of a drive on its bench with a machine: realistic sensors and inverter, at rest, no load. InputError when the
/// machine is none for this drive: other pole pairs or lines, or a value that the drive file has as 0.
Scenario bench_scenario(const Drive &drive, const Machine &machine, std::uint64_t seed);

} // namespace sdre
