// SPDX-License-Identifier: MIT
/// Weights from physical specifications, by search on the sampled closed loop (EQ-CERT-3).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "drive/drive_file.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

/// What one robustness case reaches in the linear model.
struct CaseResult {
    double dip_e_radps     = 0.0;
    double settling_time_s = 0.0; ///< the whole simulated time when it does not settle
    double ripple_e_radps  = 0.0; ///< three standard deviations
    double voltage_V       = 0.0; ///< largest in the load step, plus three standard deviations
    double spectral_radius = 0.0; ///< worst over speeds
};

struct TuneResult {
    Drive                   drive; ///< with the found weights
    std::vector<CaseResult> cases;
    double worst_ratio = 0.0; ///< largest result / specification; at most 1 when every one is met
    int    evaluations = 0;
};

/// Called now and then with the evaluations so far and the best worst ratio.
using TuneProgress = std::function<void(int evaluations, double worst_ratio)>;

/// Nelder-Mead over the logarithms of six weights from a fixed start, so the same input gives the same weights.
/// DesignError when no stable design was found.
TuneResult tune_drive(const Drive &drive, const TuneSpec &spec, const TuneProgress &progress);

/// The [nosc] and [nodo] sections with every choice explained, ready for a drive file.
std::string tuned_sections(const TuneResult &result, const TuneSpec &spec);

/// InputError unless both sections begin with their header at the start of a line; call before the search.
void require_rewritable(const std::filesystem::path &file, const std::string &drive_text);

/// A drive file's text with those two sections in place of its own, the rest byte for byte.
std::string with_sections(const std::string &drive_text, const std::string &sections);

} // namespace sdre
