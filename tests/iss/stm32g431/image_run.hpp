// SPDX-License-Identifier: MIT
/// The image that is flashed, with the motor of the simulation, from power-up on.
#pragma once

#include "sil/board/board_runs.hpp"
#include "stm32g431/image_board.hpp"
#include "stm32g431/serial_line.hpp"

namespace iss::stm32g431 {

class ImageRun : public sdre::ModbusRun {
public:
    /// @param ideal_inverter As of MotorCircuit.
    ImageRun(const sdre::Scenario &scenario, long start_tick, const Program &program,
             bool ideal_inverter);

    bool                     step() override;
    void                     inject(sdre::FaultKind kind) override;
    std::array<int, 3>       duty_cnt() const override;
    std::vector<std::string> findings() const override;
    app_status_t             status() const override;
    const drive_t           &drive() const override
    {
        return drive_;
    }
    Chip &chip()
    {
        return board_.chip;
    }

private:
    sdre::f28335::ModbusMaster &master() override
    {
        return master_;
    }
    const sdre::f28335::ModbusMaster &master() const override
    {
        return master_;
    }
    void look();

    ImageBoard                 board_;
    SerialLine                 line_;
    sdre::f28335::ModbusMaster master_;
    std::uint64_t              period_cycles_;
    std::uint64_t              rests_ = 0; ///< cycle between two ticks
    int                        resets_;
    drive_t                    drive_{};
};

} // namespace iss::stm32g431
