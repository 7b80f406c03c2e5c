// SPDX-License-Identifier: MIT
/// Exponential of a square matrix.
#pragma once

#include "linalg/extended.hpp"

namespace sdre {

Eigen::MatrixXd  exponential(const Eigen::MatrixXd &A);
extended::Matrix exponential(const extended::Matrix &A);

} // namespace sdre
