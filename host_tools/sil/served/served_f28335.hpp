// SPDX-License-Identifier: MIT
/// The firmware on the virtual F28335 with a free motor: from power-up, without an end.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sil/board/motor_surroundings.hpp"
#include "sil/f28335/device.hpp"
#include "sil/f28335/flash_unit.hpp"
#include "sil/run/controller.hpp"
#include "sil/served/served_drive.hpp"

namespace sdre {

class ServedF28335 final : public ServedDrive {
public:
    /// InputError or DesignError when the board cannot have the drive, or no gains exist.
    /// @param machine Is on the bench; the firmware knows the motor and disc of `drive`.
    /// @param flash   What its flash has at the start; empty: as from the factory.
    /// @param own_stack As of f28335::DeviceOptions.
    ServedF28335(const Drive &drive, const Machine &machine, std::uint64_t seed,
                 const f28335::FlashWords &flash = {}, bool own_stack = f28335::can_switch_stacks);
    ServedF28335(const Drive &drive, std::uint64_t seed) : ServedF28335(drive, drive, seed) {}

    std::string board() const override
    {
        return "the virtual F28335";
    }
    Connections connections() const override
    {
        return {};
    }
    void   period() override;
    void   power_cycle() override;
    double time_s() const override
    {
        return before_s_ + device_->time_s();
    }
    void send(std::uint8_t octet) override
    {
        device_->serial().send(octet);
    }
    int take() override
    {
        return device_->serial().take();
    }
    int resets() const override
    {
        return resets_;
    }
    std::vector<std::string> findings() const override;

    /// How long the reset pin stays low after power-on, and after a reset by the watchdog.
    void set_reset_line(double power_on_s, double watchdog_s)
    {
        power_on_low_s_ = power_on_s;
        watchdog_low_s_ = watchdog_s;
    }
    f28335::EcanUnit &can()
    {
        return device_->can();
    }
    f28335::SciUnit &line()
    {
        return device_->serial();
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
    const f28335::Device &device() const
    {
        return *device_;
    }
    /// From the last start of main() to the first tick.
    double ready_s() const
    {
        return ready_s_;
    }

private:
    void power_up(bool after_reset);
    void set_inputs();
    void break_processor(FaultKind kind) override;

    Controller                      controller_;
    f28335::MotorSurroundings       surroundings_;
    bool                            own_stack_;
    std::unique_ptr<f28335::Device> device_;
    int                             resets_         = 0;
    double                          ready_s_        = 0.0;
    unsigned                        power_cycles_   = 0;
    double                          power_on_low_s_ = 0.2;
    double                          watchdog_low_s_ = f28335::watchdog_pulse_s;
    double                          before_s_       = 0.0; ///< of the devices before the last reset
};

} // namespace sdre
