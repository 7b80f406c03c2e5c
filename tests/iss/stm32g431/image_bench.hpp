// SPDX-License-Identifier: MIT
/// The image with a motor and with a Modbus client at its serial line.
#pragma once

#include <string>
#include <vector>

#include "sil/f28335/modbus_master.hpp"
#include "stm32g431/chip.hpp"
#include "stm32g431/image_memory.hpp"
#include "stm32g431/motor_circuit.hpp"
#include "stm32g431/serial_line.hpp"

extern "C" {
#include "app_status.h"
}

namespace iss::stm32g431 {

/// A program and the places of its variables.
struct Program {
    ElfImage image;
    ElfImage layout; ///< layout.c
};

/// The drive at rest with the sensors and the dead time of its file, three shunts, and the dry friction of a small machine.
sdre::Scenario at_rest(const sdre::Drive &drive);

/// A fault of the processor, until a reset.
void break_chip(Chip &chip, const Program &program, sdre::FaultKind kind);

class ImageBench {
public:
    /// @param start_s Until then the shaft is held and passes the index once: the drive knows the angle. 0: it is free.
    ImageBench(const sdre::Scenario &scenario, double start_s, const Program &program);

    void pass(double time_s);
    /// The same with a question now and then, as a drive whose client is silent stops.
    void run(double time_s);
    /// Control word and speed in the mode of profile velocity. False: it was not taken.
    bool command(unsigned word, double speed_e_radps);
    bool write(std::uint16_t first, const std::vector<std::uint16_t> &words);
    int  input(std::uint16_t number); ///< -1: no answer
    /// Enables and waits for the mode RUN; false: it does not come within this time.
    bool enable(double speed_e_radps, double within_s);
    /// Time from now until all switches are off; negative: they are not within this time.
    double opens_s(double within_s);

    app_mode_t mode() const
    {
        return memory.get<app_mode_t>("tick_side", "mode");
    }
    app_fault_t fault() const
    {
        return memory.get<app_fault_t>("tick_side", "fault");
    }
    drive_fault_t drive_fault() const
    {
        return memory.get<drive_fault_t>("tick_side", "drive_fault");
    }
    double speed_e_radps() const
    {
        return bench.plant_state().omega_e_radps;
    }

    const Program             &program;
    sdre::Scenario             scenario;
    sdre::MotorBench           bench;
    MotorCircuit               circuit;
    Chip                       chip;
    ImageMemory                memory;
    SerialLine                 line;
    sdre::f28335::ModbusMaster master;

private:
    bool answered();
};

} // namespace iss::stm32g431
