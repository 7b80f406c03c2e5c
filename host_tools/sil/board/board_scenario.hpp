// SPDX-License-Identifier: MIT
/// A scenario as the F28335 board can run it.
#pragma once

#include <string>
#include <vector>

#include "sil/setup/scenario.hpp"

namespace sdre {

struct BoardScenario {
    Scenario                 scenario;
    double                   dead_time_s = 0.0; ///< 0: ideal inverter
    std::vector<std::string> notes;             ///< what was changed
};

/// InputError for what this board's constants do not allow.
BoardScenario for_board(const Scenario &scenario);

/// The commanded speed as the serial line carries it, in tenths.
int tenths_of(double omega_e_radps);

} // namespace sdre
