// SPDX-License-Identifier: MIT
/// Torque steps of a drive with [torque], on its own board.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sil/setup/scenario.hpp"

namespace sdre {

/// Torques of zero, a tenth and all of the rated torque at half of the rated speed. The worst of all seeds.
struct TorqueTrial {
    double speed_e_radps = 0.0;
    double least_tenth_s =
        0.0; ///< EQ-TORQUE-6, with the hexagon's corner; not a number: out of reach
    double                   least_rated_s = 0.0;
    int                      faults        = 0; ///< seeds that tripped
    std::optional<double>    tenth_s;           ///< to 90 % of the step; none: never
    std::optional<double>    rated_s;
    double                   overshoot_percent = 0.0; ///< of the step to the rated torque
    double                   error_percent     = 0.0; ///< of the rated torque, as the next
    double                   ripple_percent    = 0.0;
    double                   peak_current_A    = 0.0;
    std::vector<std::string> reasons; ///< why it is not good; empty when it is
};

/// The run of it. The load takes what is commanded.
Scenario torque_scenario(const Drive &drive);

/// Runs and judges it; without [torque] there is none.
std::optional<TorqueTrial> torque_trial(const Drive &drive, int seeds);

/// A line of the report.
std::string torque_words(const TorqueTrial &trial);

} // namespace sdre
