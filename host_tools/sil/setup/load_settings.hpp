// SPDX-License-Identifier: MIT
/// Load torque that is no step.
#pragma once

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

} // namespace sdre
