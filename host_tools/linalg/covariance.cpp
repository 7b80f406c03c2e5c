// SPDX-License-Identifier: MIT
#include "linalg/covariance.hpp"

namespace sdre {

// Doubling: after k steps P holds 2^k periods. It ends after thirty steps (10^9 periods), or when
// the sum has converged.
Eigen::MatrixXd covariance(Eigen::MatrixXd A, const Eigen::MatrixXd &B,
                           const Eigen::VectorXd &variances)
{
    Eigen::MatrixXd P = B * variances.asDiagonal() * B.transpose();
    for (int i = 0; i < 30 && A.norm() > 1e-12; i++) {
        P = P + A * P * A.transpose();
        A = A * A;
    }
    return P;
}

} // namespace sdre
