// SPDX-License-Identifier: MIT
#include "linalg/covariance.hpp"

namespace sdre {

// By doubling: after k steps P holds 2^k periods. Thirty are 10^9 periods, or until nothing is left to add.
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
