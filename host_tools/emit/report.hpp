// SPDX-License-Identifier: MIT
/// Output of `sdre-gains report`.
#pragma once

#include <optional>
#include <string>

#include "design/design.hpp"

namespace sdre {

/// Prediction of the linear sampled loop for the load step from half to all of the rated torque, at
/// half the rated speed: see tune/objective.hpp.
struct Prediction {
    double speed_e_radps   = 0.0;
    double load_step_Nm    = 0.0;
    double dip_e_radps     = 0.0;
    double settling_time_s = 0.0;
    double band_e_radps    = 0.0; ///< that it settles to
    double ripple_e_radps  = 0.0; ///< three standard deviations, without a load step
    double voltage_noise_V = 0.0; ///< rms of v_q
};

/// One JSON object; keys in docs/files.md.
std::string report_json(const Design &design, const std::optional<Prediction> &prediction = {});

/// The same as text.
std::string report_text(const Design &design, const std::optional<Prediction> &prediction = {});

} // namespace sdre
