// SPDX-License-Identifier: MIT
/// The virtual F28335 of tests/served/test_soak.cpp.
#pragma once

#include <memory>

#include "sil/board/board_runs.hpp"
#include "sil/run/controller.hpp"

namespace sdre {

constexpr const char *soak_drive = SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml";

inline std::unique_ptr<ModbusRun> soak_board(const Scenario &s, long start)
{
    static Controller c; // the firmware keeps addresses of it
    c = prepare_controller(s);
    set_firmware(c.config, s.drive);
    return std::make_unique<F28335Run>(s, start, 3e-6);
}

} // namespace sdre
