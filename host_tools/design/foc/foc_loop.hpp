// SPDX-License-Identifier: MIT
/// pi_foc and ladrc as they run, linearised at an operating point: motor, one period of delay, current loops, speed
/// measurement, speed law, with the constants of the firmware. EQ-CERT-4, broken where a signal r is added.
///
/// Currents are taken in the frame of the true angle; angle extrapolation, flux weakening and limits are left out.
#pragma once

#include "design/design.hpp"
#include "design/sampled_model.hpp"

namespace sdre {

/// One closed loop, to be excited at three places.
struct FocLoop {
    SampledServoLoop speed;  ///< r on the current reference
    SampledServoLoop q_axis; ///< r on the q voltage
    SampledServoLoop d_axis; ///< r on the d voltage
};

FocLoop foc_loop(const Design &design, const OperatingPoint &at, speed_difference_mode_t mode);

/// Worst peak and radius at standstill and at rated speed, without current and at both ends of the MTPA curve, for both ways to
/// measure the speed.
CascadeCheck check_foc_loops(const Design &design);

} // namespace sdre
