// SPDX-License-Identifier: MIT
#include "linalg/c2d.hpp"

#include "linalg/expm.hpp"

namespace sdre {
namespace {

template <class Matrix>
Held<Matrix> held(const Matrix &A, const Matrix &B, typename Matrix::Scalar ts_s)
{
    const Eigen::Index n   = A.rows();
    const Eigen::Index m   = B.cols();
    Matrix             M   = Matrix::Zero(n + m, n + m);
    M.topLeftCorner(n, n)  = A * ts_s;
    M.topRightCorner(n, m) = B * ts_s;
    const Matrix E         = exponential(M);
    return {E.topLeftCorner(n, n), E.topRightCorner(n, m)};
}

} // namespace

Held<Eigen::MatrixXd> c2d(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B, double ts_s)
{
    return held(A, B, ts_s);
}

Held<extended::Matrix> c2d(const extended::Matrix &A, const extended::Matrix &B,
                           extended::Scalar ts_s)
{
    return held(A, B, ts_s);
}

Transition transition(const Eigen::MatrixXd &A, const Eigen::MatrixXd &dA, double ts_s)
{
    const Eigen::Index n      = A.rows();
    Eigen::MatrixXd    M      = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    M.topLeftCorner(n, n)     = A * ts_s;
    M.bottomRightCorner(n, n) = A * ts_s;
    M.topRightCorner(n, n)    = dA * ts_s;
    const Eigen::MatrixXd E   = exponential(M);
    return {E.topLeftCorner(n, n), E.topRightCorner(n, n)};
}

} // namespace sdre
