// SPDX-License-Identifier: MIT
#include "linalg/inverse.hpp"

#include <vector>

namespace sdre::extended {
namespace {

/// Gauss-Jordan in place with row pivots. Eigen's own are blocked for sizes that do not occur here and take a quarter of
/// a minute to compile in long double.
template <class M> M gauss_jordan(M A)
{
    const Eigen::Index        n = A.rows();
    std::vector<Eigen::Index> swapped;
    for (Eigen::Index k = 0; k < n; k++) {
        Eigen::Index pivot = 0;
        A.col(k).tail(n - k).cwiseAbs().maxCoeff(&pivot);
        pivot += k;
        swapped.push_back(pivot);
        A.row(k).swap(A.row(pivot));
        const auto inverse = Scalar(1) / A(k, k);
        A(k, k)            = Scalar(1);
        A.row(k) *= inverse;
        for (Eigen::Index i = 0; i < n; i++) {
            if (i != k) {
                const auto factor = A(i, k);
                A(i, k)           = Scalar(0);
                A.row(i) -= factor * A.row(k);
            }
        }
    }
    for (Eigen::Index k = n; k-- > 0;) {
        A.col(k).swap(A.col(swapped[static_cast<std::size_t>(k)]));
    }
    return A;
}

} // namespace

Matrix inverse(Matrix M)
{
    return gauss_jordan(std::move(M));
}

ComplexMatrix inverse(ComplexMatrix M)
{
    return gauss_jordan(std::move(M));
}

} // namespace sdre::extended
