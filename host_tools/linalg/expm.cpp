// SPDX-License-Identifier: MIT
#include "linalg/expm.hpp"

#include <cmath>

namespace sdre {
namespace {

// Behind the term of this degree the series of e^x, |x| <= 1/2, has 4e-21 left: below half a digit of a long double.
constexpr int degree = 16;

template <class Matrix> Matrix scaled_and_squared(const Matrix &A)
{
    using Real = typename Matrix::Scalar;
    int        halvings;
    const Real size = A.cwiseAbs().colwise().sum().maxCoeff();
    std::frexp(size, &halvings); // size < 2^halvings
    halvings = size > Real(0) && std::isfinite(size) ? std::max(0, halvings + 1) : 0;

    const Matrix X = A * std::ldexp(Real(1), -halvings);
    Matrix       E = Matrix::Identity(A.rows(), A.cols());
    for (int k = degree; k > 0; k--) { // Horner
        E = Matrix((X / Real(k)).lazyProduct(E));
        E.diagonal().array() += Real(1);
    }
    for (int k = 0; k < halvings; k++) {
        E = Matrix(E.lazyProduct(E));
    }
    return E;
}

} // namespace

Eigen::MatrixXd exponential(const Eigen::MatrixXd &A)
{
    return scaled_and_squared(A);
}

extended::Matrix exponential(const extended::Matrix &A)
{
    return scaled_and_squared(A);
}

} // namespace sdre
