// SPDX-License-Identifier: MIT
/// Names of what can end a run.
#pragma once

namespace sdre {

/// Faults beyond drive_fault_t in SimulationResult::fault, of runs with the application on a board.
constexpr int app_fault_base     = 100; ///< plus app_fault_t
constexpr int device_reset_fault = 200; ///< by its watchdog
constexpr int runaway_fault      = 300; ///< Board::runaway(): the plant cannot go on

/// "over current" and so on.
const char *fault_name(int fault);

} // namespace sdre
