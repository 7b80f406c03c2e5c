// SPDX-License-Identifier: MIT
/// Value of a set of weights: the sampled closed loop (EQ-CERT-3) in every robustness case,
/// compared with the specification.
#pragma once

#include <vector>

#include "drive/drive_file.hpp"
#include "tune/shaft_cases.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

/// The logarithms, base 10, of searched_weights() in the units of with_weights().
using Point = std::vector<double>;

/// One weight that a search moves, where two axes have the same: both.
struct SearchedWeight {
    bool                  controller; ///< else the observer's
    std::vector<double *> values;     ///< in the drive
};

/// Controller: speed error and q-axis error. Observer: drift of the load, drift of both voltages, noise of speed and currents.
/// noc_shaft has four more: speed of the load and twist, first the controller's and then the observer's. The drive is near optimal
/// and in its encoder form.
std::vector<SearchedWeight> searched_weights(Drive &drive);

/// Standard deviations of one sample.
struct Sensors {
    double current_A; ///< noise and quantisation
    double angle_rad; ///< quantisation, or what the edges are off
};

Sensors sensors_of(const Drive &drive, const TuneSpec &spec);

/// The number that three digits on paper say: weights are searched, judged and written as that.
double written(double weight);

/// A drive's own weights, all positive.
Point point_of(Drive drive);

/// The drive with the weights of a point, each as written().
Drive with_weights(Drive drive, const TuneSpec &spec, const Point &x);

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
