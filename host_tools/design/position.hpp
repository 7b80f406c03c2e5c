// SPDX-License-Identifier: MIT
/// Near optimal control of the position: the error system of the speed law with the angle as a first state,
///
///     x = (theta, w, iq, id) - reference,   theta' = w                       EQ-POSITION-2
///
/// solved as that one is (EQ-SERIES-1 to 3), with weights of its own.
#pragma once

#include <string>

#include "design/design.hpp"

namespace sdre {

/// 4 x 2: the input matrix with a row of zeros for the angle.
Eigen::MatrixXd position_input_matrix(const ReducedParameters &l);

/// Lambda_n of EQ-POSITION-3 with the angle's column first, 2 x 4. Needs the drive's [position].
GainSeries solve_position(const ReducedParameters &l, const Drive &drive, Precision precision);

/// Constants of the firmware: gains, limits of a profile, and how far a reference may be ahead.
/// Needs design.position.
position_gains_t position_constants(const Design &design);

/// The gains of all modes of the law at small errors: Lambda_0 of the speed. Where the drive has
/// it, also Lambda_0 of the position (2 x 4).
std::vector<Eigen::MatrixXd> feedback_gains(const Design &design);

} // namespace sdre
