// SPDX-License-Identifier: MIT
/// Steady noise of a sampled system.
#pragma once

#include <Eigen/Core>

namespace sdre {

/// Covariance of x(k+1) = A x(k) + B n(k) with independent white noise of these variances; A is stable.
Eigen::MatrixXd covariance(Eigen::MatrixXd A, const Eigen::MatrixXd &B,
                           const Eigen::VectorXd &variances);

} // namespace sdre
