// SPDX-License-Identifier: MIT
/// The loops of pi_foc and ladrc with the constants of the firmware, linearised at an operating
/// point. They have motor, one period of delay, current loops, speed measurement and speed law.
/// EQ-CERT-4 opens a loop where a signal r is added.
///
/// Currents are taken in the frame of the true angle; angle extrapolation, flux weakening and limits are left out.
#pragma once

#include "design/design.hpp"
#include "design/sampled_model.hpp"

namespace sdre {

/// Run to a speed, run to a torque, and run to a torque whose speed limit acts.
enum class FocRun { speed, torque, limit };

/// One closed loop, opened at the current reference, at the q and at the d voltage. The shaft of a torque is free.
///
/// @param motor what the motor is; the constants are those of the design.
std::vector<BrokenLoop> foc_loops(const Design &design, const Motor &motor,
                                  const OperatingPoint &at, speed_difference_mode_t mode,
                                  FocRun run = FocRun::speed);

/// For each run that the drive takes, and for both ways to measure the speed; without edge times they are the same. The published
/// rules ask for no other motor.
LoopFamily foc_family(const Design &design);

} // namespace sdre
