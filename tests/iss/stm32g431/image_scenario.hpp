// SPDX-License-Identifier: MIT
/// A scenario of the simulation with the image that is flashed.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sil/board/board_run.hpp"
#include "stm32g431/cycle_meter.hpp"
#include "stm32g431/image_run.hpp"

namespace iss::stm32g431 {

struct ImageResult {
    sdre::BoardResult                           board;
    std::vector<CycleMeter::Run>                interrupts; ///< those in RUN
    std::vector<std::pair<double, std::string>> functions;  ///< as of CycleMeter
    double                                      period_cycles = 0.0;
    double speed = 0.0; ///< simulated seconds in one of the processor, with boot and rehearsal
};

/// An image with its places of variables; std::runtime_error when it is none.
Program read_program(const std::filesystem::path &image);

/// The board has three shunts, also when the drive reads two.
sdre::Scenario with_three_shunts(sdre::Scenario s);

/// InputError: the constants in the image are not those of the drive.
void require_constants(const Program &program, const sdre::Drive &drive);

/// InputError when the scenario is none for this board or for the constants of the image, or when the image does not come
/// to RUN.
ImageResult simulate_image(const sdre::Scenario &scenario, const Program &program);

/// Worst and median cycles of the control interrupt, and the speed, as lines.
std::string cycles_text(const ImageResult &result);

} // namespace iss::stm32g431
