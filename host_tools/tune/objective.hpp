// SPDX-License-Identifier: MIT
/// Value of a set of weights: the sampled closed loop (EQ-CERT-3) in every robustness case,
/// compared with the specification.
#pragma once

#include <vector>

#include "tune/searched_weights.hpp"
#include "tune/shaft_cases.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

/// Results of one robustness case in the linear model.
struct CaseResult {
    double    dip_e_radps     = 0.0;
    double    settling_time_s = 0.0; ///< the whole simulated time when it does not settle
    double    ripple_e_radps  = 0.0; ///< three standard deviations
    double    voltage_V       = 0.0; ///< largest in the load step, plus three standard deviations
    double    voltage_noise_V = 0.0; ///< rms of v_q
    double    spectral_radius = 0.0; ///< worst over speeds
    double    peak            = 0.0; ///< sensitivity at the largest speed, of rare edges
    ShaftStep shaft{};               ///< nominal case
};

/// One result over its goal; at most 1 when the goal is met.
struct GoalRatio {
    const char *name;
    double      ratio;
};

std::vector<GoalRatio> goal_ratios(const CaseResult &result, const RobustnessCase &wanted,
                                   const TuneSpec &spec);

struct Score {
    double worst = 0.0; ///< largest result / specification; at most 1 when every one is met
    double value =
        0.0; ///< what is minimised: the worst, and a little of every case's so that none idles
    std::vector<CaseResult> cases;
};

/// From here on a score's worst means that a loop is unstable or has no solution.
constexpr double unstable_score = 1e9;

/// All cases at once. `worst` and `value` have six digits: what differs from one compiler to the next is far below, and the
/// search takes the same way everywhere.
Score score(const Drive &drive, const TuneSpec &spec);

} // namespace sdre
