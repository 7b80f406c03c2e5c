// SPDX-License-Identifier: MIT
/// Drives made equally noisy, so that what they reach can be compared: the faster a law, the more noise it lets through.
///
/// Every law has one knob, its bandwidth. Factor 1 is the drive file, more is faster:
///   noc, noc_h   all weights of the observer's measurements, [nodo] T, divided by it
///   pi_foc       symmetrical_optimum_a divided by it, not below 1.05
///   ladrc        controller_radps and observer_radps times it
#pragma once

#include <optional>
#include <string>

#include "sil/setup/scenario.hpp"

namespace sdre {

/// InputError for a law without a knob.
Drive with_bandwidth(const Drive &drive, double factor);

/// The knob as a drive file has it: "symmetrical_optimum_a = 2.31".
std::string knob_text(const Drive &drive);

struct NoiseMatch {
    double factor  = 1.0;
    double noise_V = 0.0;   ///< with that factor
    bool   reached = false; ///< within noise_tolerance of the goal
};

/// Chosen: less than the seeds differ by.
constexpr double noise_tolerance = 0.02;

/// Mean over the seeds of the noise of v_q in the scenario's last measure; none when a seed faults or the design is refused.
std::optional<double> noise_V(const Scenario &scenario, int seeds);

/// The factor with which the scenario's drive makes this noise; the nearest one where none does.
NoiseMatch match_noise(const Scenario &scenario, double wanted_V, int seeds);

} // namespace sdre
