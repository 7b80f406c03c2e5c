// SPDX-License-Identifier: MIT
/// Load torque that is no step.
#pragma once

#include <vector>

#include "sil/setup/steps.hpp"

namespace sdre {

/// A straight line from the torque at time_s to to_Nm at until_s, which then stays.
struct LoadRamp {
    double time_s  = 0.0;
    double until_s = 0.0;
    double to_Nm   = 0.0;
};

struct LoadSine {
    double amplitude_Nm = 0.0;
    double frequency_Hz = 0.0;
    double start_s      = 0.0;
};

/// A magnetic powder brake on the shaft.
struct BrakeSettings {
    std::vector<Step> command;               ///< N m, at least 0, sorted by time
    double            time_constant_s = 0.0; ///< of its coil
    double            drag_Nm         = 0.0; ///< without current: powder, seals, bearings
};

/// A brake on the shaft that a spring closes and a coil releases.
struct HoldingBrakeSettings {
    double torque_Nm      = 0.0; ///< dry friction while it is closed; 0: no brake
    double release_time_s = 0.0; ///< from the output to the open brake
    double close_time_s   = 0.0; ///< from the output to the full torque
};

} // namespace sdre
