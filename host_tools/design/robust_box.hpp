// SPDX-License-Identifier: MIT
/// Largest distance of the motor from the nominal one, all parameters at once.
///
///     R, L, flux x 0.5^s .. 1.5^s,  J x 0.5^s .. 3^s,  0 <= s <= 1                         EQ-CERT-5
///
/// The share s of the box is the largest at which the sampled loop is stable in all 16 corners. The
/// whole box (s = 1) has motors with 9 times the nominal acceleration per volt. No fixed gain is
/// fast and stable there.
#pragma once

#include <functional>
#include <string>

#include "drive/drive_file.hpp"

namespace sdre {

/// Spectral radius of the loop with this motor, the worst over the operating points; the controller stays.
using MotorRadius = std::function<double(const Motor &motor)>;

struct RobustBox {
    double      share = 0.0; ///< s
    std::string corner;      ///< the first to become unstable, "" when the whole box is stable
};

/// Bisection to one hundredth. At every tenth below the result the corners are stable too.
RobustBox robust_box(const Motor &motor, const MotorRadius &radius);

/// The same with one parameter at either end and the others nominal: eight motors instead of
/// sixteen.
RobustBox robust_alone(const Motor &motor, const MotorRadius &radius);

} // namespace sdre
