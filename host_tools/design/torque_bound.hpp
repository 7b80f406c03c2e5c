// SPDX-License-Identifier: MIT
/// The least time of a torque step: no drive beats it.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// A step at constant speed, from the currents of the MTPA curve.
struct TorqueStep {
    double speed_e_radps = 0.0;
    double from_Nm       = 0.0;
    double to_Nm         = 0.0;
    double voltage_V     = 0.0; ///< longest voltage, in any direction
    double share         = 0.9; ///< of the step
};

/// The earliest time at which voltages within a circle bring the torque to that share of the step [s]. There is no delay, and i_d is free.
/// The currents that can be reached by a time are a convex set. Its edge is known for every direction, and its largest torque is on that
/// edge. Not a number beyond 0.1 s.                                                                                    EQ-TORQUE-6
double least_torque_time_s(const Motor &motor, const ReducedParameters &l, const TorqueStep &step);

/// The time to 90 % of a step of a drive, with the longest voltage of its dc link: a corner of the hexagon.
double least_torque_time_s(const Drive &drive, double speed_e_radps, double from_Nm, double to_Nm);

} // namespace sdre
