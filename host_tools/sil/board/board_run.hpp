// SPDX-License-Identifier: MIT
/// A scenario with the drive application on a board, instead of the control core alone.
///
/// `api`: application on an implementation of board.h. `f28335`: application, main() and the drivers of
/// board/f28335 on the virtual device, commands by Modbus over its serial line. Both see the same converter codes and encoder
/// counts, and both give duty ratios in counts.
///
/// The firmware boots and calibrates while the shaft is held; the scenario starts with the first tick in RUN. When
/// that is follows from a rehearsal: everything is repeatable.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sil/run/simulation.hpp"

namespace sdre {

enum class BoardKind { api, f28335 };

class BoardRun;
struct BoardScenario;
/// Powers a board up. @param start_tick As of MotorBench.
using PowerUp = std::function<std::unique_ptr<BoardRun>(const BoardScenario &, long start_tick)>;

/// Values at the board's interface at one tick, for comparisons.
struct BoardTick {
    std::array<int, 2> current_code{};
    std::int64_t       count = 0;
    std::array<int, 3> duty_cnt{}; ///< in force from this tick on
    bool               bridge_on = false;
};

struct BoardResult {
    SimulationResult                                  result;
    std::vector<BoardTick, LargeAllocator<BoardTick>> ticks;
    std::vector<std::string>                          notes;    ///< differences from the scenario
    std::vector<std::string>                          findings; ///< of the virtual device
    double                                            zero_a_cnt     = 0.0; ///< calibrated
    double                                            zero_b_cnt     = 0.0;
    int                                               modbus_answers = 0;
    int                                               modbus_errors  = 0;
};

/// InputError when the scenario is none for this board, or when the firmware does not come to RUN.
BoardResult simulate_on_board(const Scenario &scenario, BoardKind kind);
BoardResult simulate_on_board(const Scenario &scenario, BoardKind kind,
                              const Controller &controller);
/// On a board that has its constants already; `controller` only tells the result where they come from.
BoardResult simulate_on_board(const Scenario &scenario, const PowerUp &power_up,
                              const Controller &controller);

} // namespace sdre
