// SPDX-License-Identifier: MIT
/// The image that is flashed with a free motor: from power-up, without an end. CAN and the cycles of the flash are not
/// modelled.
#pragma once

#include "sil/served/served_drive.hpp"
#include "stm32g431/image_bench.hpp"

namespace iss::stm32g431 {

class ServedImage final : public sdre::ServedDrive {
public:
    /// InputError: the image has other constants than those of the drive, or does not start.
    /// @param machine Is on the bench; the image knows the motor and disc of `drive`.
    ServedImage(const sdre::Drive &drive, const sdre::Machine &machine, std::uint64_t seed,
                const Program &program);

    std::string board() const override
    {
        return "the simulated B-G431B-ESC1";
    }
    sdre::Connections connections() const override
    {
        return {false, false, false};
    }
    void   period() override;
    void   power_cycle() override;
    double time_s() const override
    {
        return chip_.time_s();
    }
    void send(std::uint8_t octet) override
    {
        chip_.serial().send(octet);
    }
    int take() override
    {
        return chip_.serial().take();
    }
    int resets() const override
    {
        return resets_;
    }
    std::vector<std::string> findings() const override
    {
        return chip_.core().findings();
    }

private:
    void start();
    void break_processor(sdre::FaultKind kind) override;

    const Program &program_;
    MotorCircuit   circuit_;
    Chip           chip_;
    int            resets_ = 0;
};

} // namespace iss::stm32g431
