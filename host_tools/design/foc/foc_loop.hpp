// SPDX-License-Identifier: MIT
/// pi_foc and ladrc as they run, linearised at an operating point: motor, one period of delay, current loops, speed
/// measurement, speed law, with the constants of the firmware. EQ-CERT-4, broken where a signal r is added.
///
/// Currents are taken in the frame of the true angle; angle extrapolation, flux weakening and limits are left out.
#pragma once

#include "design/design.hpp"
#include "design/sampled_model.hpp"

namespace sdre {

/// One closed loop, broken at the current reference, at the q and at the d voltage.
///
/// @param motor what the motor is; the constants are those of the design.
std::vector<BrokenLoop> foc_loops(const Design &design, const Motor &motor,
                                  const OperatingPoint &at, speed_difference_mode_t mode);

/// For both ways to measure the speed; without edge times they are the same. The published rules ask for no other motor.
LoopFamily foc_family(const Design &design);

} // namespace sdre
