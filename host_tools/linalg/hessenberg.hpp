// SPDX-License-Identifier: MIT
/// Reduction to Hessenberg form by reflections, for the small matrices at hand. Eigen's is blocked: slower on them, and
/// most of the time it takes to compile a Schur form.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace sdre {

/// M becomes H, zero below the first subdiagonal. Q, if given, must come in as I and gets M = Q H Q'.
template <class Matrix> void reduce_to_hessenberg(Matrix &M, Matrix *Q = nullptr)
{
    using Scalar         = typename Matrix::Scalar;
    const Eigen::Index n = M.rows();
    for (Eigen::Index k = 0; k + 2 < n; k++) {
        Scalar below = 0;
        for (Eigen::Index i = k + 2; i < n; i++) {
            below = std::max(below, std::abs(M(i, k)));
        }
        if (below == Scalar(0)) {
            continue;
        }
        // The reflection I - v v' / h turns column k into its first entry below the diagonal.
        const Scalar size = std::max(below, std::abs(M(k + 1, k)));
        Matrix       v    = Matrix::Zero(n, 1);
        Scalar       sum  = 0;
        for (Eigen::Index i = k + 1; i < n; i++) {
            v(i, 0) = M(i, k) / size;
            sum += v(i, 0) * v(i, 0);
        }
        const Scalar length = std::copysign(std::sqrt(sum), v(k + 1, 0));
        const Scalar h      = sum + length * v(k + 1, 0);
        v(k + 1, 0) += length;
        const auto reflect = [&](auto &&entry, Eigen::Index first, Eigen::Index last) {
            for (Eigen::Index j = first; j < last; j++) {
                Scalar along = 0;
                for (Eigen::Index i = k + 1; i < n; i++) {
                    along += v(i, 0) * entry(i, j);
                }
                along /= h;
                for (Eigen::Index i = k + 1; i < n; i++) {
                    entry(i, j) -= along * v(i, 0);
                }
            }
        };
        reflect([&](Eigen::Index i, Eigen::Index j) -> Scalar & { return M(i, j); }, k, n);
        reflect([&](Eigen::Index i, Eigen::Index j) -> Scalar & { return M(j, i); }, 0, n);
        if (Q != nullptr) {
            reflect([&](Eigen::Index i, Eigen::Index j) -> Scalar & { return (*Q)(j, i); }, 0, n);
        }
        for (Eigen::Index i = k + 2; i < n; i++) {
            M(i, k) = 0;
        }
    }
}

} // namespace sdre
