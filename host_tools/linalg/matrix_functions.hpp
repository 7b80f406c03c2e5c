// SPDX-License-Identifier: MIT
/// Functions of square matrices whose templates are slow to compile: they are compiled here, once.
#pragma once

#include <Eigen/Core>

namespace sdre {

Eigen::MatrixXd exponential(const Eigen::MatrixXd &A);

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd &A);

/// Largest |eigenvalue|.
double spectral_radius(const Eigen::MatrixXd &A);

} // namespace sdre
