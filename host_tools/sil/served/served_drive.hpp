// SPDX-License-Identifier: MIT
/// A drive with a free motor on its bench: from power-up, without an end. A class of each board runs the firmware.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sil/f28335/can_bus.hpp"
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

/// The board's connections that the simulation has.
struct Connections {
    bool can           = true;
    bool limit_inputs  = true;
    bool holding_brake = true;
};

class ServedDrive {
public:
    ServedDrive(const ServedDrive &)            = delete;
    ServedDrive &operator=(const ServedDrive &) = delete;
    virtual ~ServedDrive()                      = default;

    /// The name of the device that runs the firmware, as "the virtual F28335".
    virtual std::string board() const       = 0;
    virtual Connections connections() const = 0;

    /// One control period. A device that its watchdog has reset starts again.
    virtual void period() = 0;
    /// Off and on: registers and memory are as after power-on, the flash is as it was.
    virtual void power_cycle() = 0;
    double       period_s() const
    {
        return bench_.period_s();
    }
    /// Since the start. While the loader runs, nothing else does: the motor stands still meanwhile.
    virtual double time_s() const = 0;

    // The serial line.
    virtual void send(std::uint8_t octet) = 0;
    /// -1: nothing.
    virtual int take() = 0;

    /// Outlives resets and power cycles of the device.
    f28335::CanBus &can_bus()
    {
        return can_bus_;
    }
    const f28335::CanBus &can_bus() const
    {
        return can_bus_;
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
    const AxisSwitches &switches() const
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
    /// Turns of the shaft from the index mark.
    double turns() const;
    /// The home switch is a contact that opens when it is active.
    bool home_is_open() const;
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
    virtual int resets() const = 0;
    /// Findings of the device's model, one line each.
    virtual std::vector<std::string> findings() const = 0;
    const Drive                     &drive() const
    {
        return scenario_.drive;
    }

protected:
    /// @param start_tick Until then the shaft is held, and passes the index: see MotorBench. 0: it is free.
    explicit ServedDrive(const Scenario &scenario, long start_tick = 0);

    const Scenario &scenario() const
    {
        return scenario_;
    }
    MotorBench &bench()
    {
        return bench_;
    }
    /// The dynamometer's torque for the next period.
    void set_load();
    /// A reset has ended the faults of the processor.
    void forget_processor_faults();

private:
    virtual void break_processor(FaultKind kind) = 0;

    Scenario                   scenario_;
    MotorBench                 bench_;
    f28335::CanBus             can_bus_;
    Dynamometer                dynamometer_;
    AxisSwitches               switches_;
    double                     source_V_;
    std::vector<InjectedFault> broken_;
};

/// Dry friction of the bench: 2 % of the rated torque when the motor's file has no friction, else 0. A data sheet seldom has
/// it, and without any a shaft would coast for minutes.
double bench_friction_Nm(const Drive &machine);

/// The scenario of a drive on its bench with a machine: realistic sensors and inverter, at rest, no load. InputError when the
/// machine is none for this drive: other pole pairs or lines, or a value that the drive file has as 0.
Scenario bench_scenario(const Drive &drive, const Machine &machine, std::uint64_t seed);

} // namespace sdre
