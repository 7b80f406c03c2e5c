// SPDX-License-Identifier: MIT
/// The image that is flashed with a free motor: from power-up, without an end. The cycles of the flash are not modelled.
#pragma once

#include "sil/served/served_drive.hpp"
#include "stm32g431/image_board.hpp"

namespace iss::stm32g431 {

class ServedImage : public sdre::ServedDrive {
public:
    /// InputError: the image has other constants than those of the drive, or does not start.
    /// @param machine Is on the bench; the image knows the motor and disc of `drive`.
    /// @param held_s  Until then the shaft is held, and passes the index: the drive needs no alignment.
    ServedImage(const sdre::Drive &drive, const sdre::Machine &machine, std::uint64_t seed,
                const Program &program, double held_s = 0.0);

    using ServedDrive::bench;
    ImageBoard &image()
    {
        return board_;
    }
    std::string board() const override
    {
        return "the simulated B-G431B-ESC1";
    }
    sdre::Connections connections() const override
    {
        return {true, false, false};
    }
    void   period() override;
    void   power_cycle() override;
    double time_s() const override
    {
        return board_.chip.time_s();
    }
    void send(std::uint8_t octet) override
    {
        board_.chip.serial().send(octet);
    }
    int take() override
    {
        return board_.chip.serial().take();
    }
    int resets() const override
    {
        return resets_;
    }
    std::vector<std::string> findings() const override
    {
        return board_.chip.core().findings();
    }

private:
    void start();
    void break_processor(sdre::FaultKind kind) override;

    ImageBoard board_;
    double     ends_s_ = 0.0; ///< of the period that passed last
    int        resets_ = 0;
};

} // namespace iss::stm32g431
