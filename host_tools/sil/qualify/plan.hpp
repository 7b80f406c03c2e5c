// SPDX-License-Identifier: MIT
/// The trials of a drive, from its own numbers: speeds and loads in shares of the rating, times
/// from physics.
#pragma once

#include <string>
#include <vector>

#include "sil/setup/scenario.hpp"

namespace sdre {

/// The project's bound for every scenario: peak current over the limit.
constexpr double peak_ratio = 1.1;

/// One run and its limits; 0: no limit.
struct Trial {
    std::string what;     ///< "load step", a row of the table
    Scenario    scenario; ///< its last measure is what is judged
    double      most_dip_e_radps = 0.0;
    double      most_settling_s  = 0.0;
    double      most_noise_V     = 0.0; ///< rms of v_q
    bool        must_settle      = true;
    bool        may_trip         = false;
};

struct Plan {
    std::vector<Trial> trials;
    Scenario motors;      ///< speed and load step, for random motors within +-30 % and J x0.5 .. 2
    Scenario wide_motors; ///< the same with +-50 % and J x0.5 .. 3
};

/// A run at one speed with one load on a real disc, without measures or an end.
Scenario at_speed(const Drive &drive, double speed_e_radps, double load_Nm);

/// Time in which a run is steady after a change of the commanded speed without load [s].
double steady_after_s(const Drive &drive, double change_e_radps);

/// `noise_share` is the largest noise of v_q, of the circle.
Plan qualification_plan(const Drive &drive, double noise_share);

} // namespace sdre
