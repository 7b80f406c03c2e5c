// SPDX-License-Identifier: MIT
/// The core's input over a run: played back, the core does the same again without a plant.
#pragma once

#include <vector>

#include "drive/core_types.hpp"
#include "sil/run/simulation.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

struct Recording {
    std::vector<drive_t>            drives; ///< the core before each tick
    std::vector<drive_sample_t>     samples;
    std::vector<drive_command_t>    commands;  ///< their pointers do not outlive the run:
    std::vector<law_aim_t>          aims;      ///< of each tick; only whether they are null counts
    std::vector<position_command_t> positions; ///< zero where a speed or a torque is commanded
    std::vector<torque_command_t>   torques;   ///< the same of torques
    std::vector<bridge_t>           outputs;   ///< what the core answered here
};

/// One run of the scenario. DesignError when the core refuses the controller's constants.
Recording record(const Scenario &scenario, const Controller &controller);

} // namespace sdre
