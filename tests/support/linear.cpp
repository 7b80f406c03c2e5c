// SPDX-License-Identifier: MIT
#include "linear.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace support {

Eigen::MatrixXd inverse(const Eigen::MatrixXd &M)
{
    return M.inverse();
}

Eigen::MatrixXcd inverse(const Eigen::MatrixXcd &M)
{
    return M.inverse();
}

LongMatrix inverse(const LongMatrix &M)
{
    return M.inverse();
}

Eigen::VectorXd solve(const Eigen::MatrixXd &M, const Eigen::VectorXd &b)
{
    return M.fullPivLu().solve(b);
}

LongMatrix solve(const LongMatrix &M, const LongMatrix &b)
{
    return M.fullPivLu().solve(b);
}

long double determinant(const LongMatrix &M)
{
    return M.determinant();
}

Modes modes_of(const Eigen::MatrixXd &M)
{
    const Eigen::EigenSolver<Eigen::MatrixXd> found(M);
    return {found.eigenvalues(), found.eigenvectors()};
}

double least_eigenvalue(const Eigen::MatrixXd &M)
{
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues().minCoeff();
}

} // namespace support
