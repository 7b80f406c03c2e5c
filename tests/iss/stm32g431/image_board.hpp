// SPDX-License-Identifier: MIT
/// The chip with its image at a motor bench, as a run and a served drive have it.
#pragma once

#include <string>
#include <vector>

#include "sil/setup/injected_faults.hpp"
#include "stm32g431/chip.hpp"
#include "stm32g431/image_memory.hpp"
#include "stm32g431/motor_circuit.hpp"

extern "C" {
#include "app_status.h"
}

namespace iss::stm32g431 {

/// A program and the places of its variables.
struct Program {
    ElfImage image;
    ElfImage layout; ///< layout.c
};

struct ImageBoard {
    /// @param ideal_inverter As of MotorCircuit.
    ImageBoard(sdre::MotorBench &bench, const sdre::Drive &drive, const Program &of,
               bool ideal_inverter);

    /// Until the first tick of a start; false: it has not come within this time.
    bool start(double within_s);
    /// Breaks the processor. A reset ends it.
    void inject(sdre::FaultKind kind);
    app_status_t
    status() const; ///< mode, faults, zeros, and the commissioning without its per cent
    /// Time from now until all switches are off; negative: they are not within this time.
    double opens_s(double within_s);

    const Program    &program;
    sdre::MotorBench &bench;
    MotorCircuit      circuit;
    Chip              chip;
    ImageMemory       memory;
};

} // namespace iss::stm32g431
