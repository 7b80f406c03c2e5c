// SPDX-License-Identifier: MIT
/// Whether a motor runs as quietly as the one that the controller believes in.
#pragma once

#include <string>
#include <vector>

#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"

namespace sdre {

// Chosen: 0.2 V and 0.02 rad/s of the 390 W motor, whose circle is 170 V and whose rated speed 523 rad/s. Steady running that
// is as quiet as this has no limit cycle.
constexpr double quiet_voltage_share = 0.2 / 170.3;
constexpr double quiet_speed_share   = 0.02 / 523.0;

/// The steady part of a measure may have this at most.
struct NoiseLimit {
    double time_s; ///< of the measure
    double ripple_e_radps;
    double vq_noise_V;
    double vd_noise_V;
};

/// The scenario with the motor that the controller believes in, seeds 1 .. 20: 5 times the median ripple and 3 times the
/// median noise of each voltage, at least the quiet shares. Empty when that motor trips.
std::vector<NoiseLimit> noise_limits(const Scenario &scenario, const Controller &controller);

/// One line for each limit that a run exceeds.
std::vector<std::string> noise_reasons(const std::vector<Metrics>    &metrics,
                                       const std::vector<NoiseLimit> &limits);

} // namespace sdre
