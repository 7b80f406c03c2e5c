// SPDX-License-Identifier: MIT
/// Eigen's decompositions for the tests' own solutions. They are compiled once: each takes seconds of compiler time.
#pragma once

#include <Eigen/Core>

namespace support {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

Eigen::MatrixXd  inverse(const Eigen::MatrixXd &M);
Eigen::MatrixXcd inverse(const Eigen::MatrixXcd &M);
LongMatrix       inverse(const LongMatrix &M);

/// M^-1 b, with complete pivoting.
Eigen::VectorXd solve(const Eigen::MatrixXd &M, const Eigen::VectorXd &b);
LongMatrix      solve(const LongMatrix &M, const LongMatrix &b);

long double determinant(const LongMatrix &M);

struct Modes {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors; ///< a column each
};
Modes modes_of(const Eigen::MatrixXd &M);

/// The smallest eigenvalue of a symmetric matrix.
double least_eigenvalue(const Eigen::MatrixXd &M);

} // namespace support
