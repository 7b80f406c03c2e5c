// SPDX-License-Identifier: MIT
/// The image of tests/served/test_soak.cpp.
#pragma once

#include <memory>

#include "stm32g431/image_run.hpp"
#include "stm32g431/image_scenario.hpp"

namespace sdre {

constexpr const char *soak_drive = ISS_DRIVE;

inline std::unique_ptr<ModbusRun> soak_board(const Scenario &s, long start)
{
    static const iss::stm32g431::Program program = iss::stm32g431::read_program(ISS_IMAGE);
    return std::make_unique<iss::stm32g431::ImageRun>(iss::stm32g431::with_three_shunts(s), start,
                                                      program, false);
}

} // namespace sdre
