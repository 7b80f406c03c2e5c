// SPDX-License-Identifier: MIT
/// Eigenvalues of real square matrices in double.
#pragma once

#include <Eigen/Core>

namespace sdre {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd &A);

/// Sorted by real, then imaginary part.
Eigen::VectorXcd sorted_eigenvalues(const Eigen::MatrixXd &A);

/// Largest |eigenvalue|; infinite when an element is infinite or not a number.
double spectral_radius(const Eigen::MatrixXd &A);

} // namespace sdre
