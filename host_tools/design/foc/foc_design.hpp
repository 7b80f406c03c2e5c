// SPDX-License-Identifier: MIT
/// Constants of field-oriented control's current loops and of its speed measurement.
///
///     k_p = w_b L, k_i = w_b R for each axis                                EQ-FOC-7, pole cancellation
///     T_s = 1 / w_b + T_m / 2                                               EQ-FOC-8
///
/// w_b = 2 pi current_bandwidth_Hz. For the speed loop, the current loop is a lag of 1 / w_b. Its
/// dead time of one and a half periods is inside that loop and changes only second-order terms. A
/// speed averaged over T_m is late by half of T_m.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// EQ-FOC-7 and the limits.
foc_config_t foc_constants(const Drive &drive, const ReducedParameters &l);

/// With counts over window_s, fewer periods where the trip speed would turn half an electrical turn in it, one at least.
speed_difference_config_t speed_difference_constants(const Drive &drive, double window_s);

/// EQ-FOC-8. Counts and times of edges have gains of their own; without edge times both are those of counts.
double small_time_s(const Drive &drive, const speed_difference_config_t &c,
                    speed_difference_mode_t mode);

/// EQ-LADRC-2: both poles at -pole_1ps; at 0 no observer.
speed_observer_gains_t speed_observer_gains(double pole_1ps, double ts_s);

/// Periods that the speed is the mean of.
int speed_periods(const Drive &drive, const speed_difference_config_t &c,
                  speed_difference_mode_t mode);

} // namespace sdre
