// SPDX-License-Identifier: MIT
#include "linalg/matrix_functions.hpp"

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

namespace sdre {

Eigen::MatrixXd exponential(const Eigen::MatrixXd &A)
{
    return A.exp();
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd &A)
{
    return A.eigenvalues();
}

double spectral_radius(const Eigen::MatrixXd &A)
{
    return eigenvalues(A).cwiseAbs().maxCoeff();
}

} // namespace sdre
