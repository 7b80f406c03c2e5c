// SPDX-License-Identifier: MIT
#include "linalg/lyapunov.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/axis.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre::extended {

LyapunovSolver::LyapunovSolver(const Matrix &A) : schur_(schur_form(A)) {}

Matrix LyapunovSolver::solve(const Matrix &W) const
{
    // With A = U T U^H and Y = U^H X U the equation becomes T^H Y + Y T = -U^H W U. T is upper
    // triangular, so each entry of Y follows from those above it and to its left.
    const ComplexMatrix &T  = schur_.T;
    const ComplexMatrix &U  = schur_.U;
    const Eigen::Index   n  = T.rows();
    const ComplexMatrix  WU = W.cast<Complex>().lazyProduct(U);
    ComplexMatrix        Y  = -U.adjoint().lazyProduct(WU);
    for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = 0; i < n; ++i) {
            Complex rest = Y(i, j);
            for (Eigen::Index k = 0; k < j; ++k) {
                rest -= Y(i, k) * T(k, j);
            }
            for (Eigen::Index k = 0; k < i; ++k) {
                rest -= std::conj(T(k, i)) * Y(k, j);
            }
            Y(i, j) = rest / (std::conj(T(i, i)) + T(j, j));
        }
    }
    const ComplexMatrix UY = U.lazyProduct(Y);
    return symmetric_part(UY.lazyProduct(U.adjoint()).real());
}

} // namespace sdre::extended

namespace sdre {

LyapunovSolution solve_lyapunov(const Eigen::MatrixXd &A, const Eigen::MatrixXd &W)
{
    require_square(A, "A");
    require_shape(W, A.rows(), A.cols(), "W");
    require_finite(A, "A");
    require_finite(W, "W");
    if (!is_symmetric(W)) {
        throw InputError("W is not symmetric");
    }

    const extended::Matrix        Ax    = A.cast<extended::Scalar>();
    const extended::Matrix        Wx    = extended::symmetric_part(W.cast<extended::Scalar>());
    const extended::ComplexVector modes = extended::eigenvalues(Ax);
    extended::Complex             worst = modes(0);
    for (const extended::Complex &mode : modes) {
        worst = mode.real() > worst.real() ? mode : worst;
    }
    extended::Complex on_axis;
    if (!(worst.real() < 0) || extended::find_axis_eigenvalue(Ax, modes, on_axis)) {
        throw DesignError(fmt::format("A is not Hurwitz: eigenvalue at s = {}",
                                      mode_text(std::complex<double>(worst))));
    }

    LyapunovSolution solution;
    solution.X = extended::LyapunovSolver(Ax).solve(Wx).cast<double>();
    if (!solution.X.allFinite()) {
        throw DesignError("the solution of the Lyapunov equation exceeds the range of a double");
    }
    const extended::Matrix XA   = solution.X.cast<extended::Scalar>().lazyProduct(Ax);
    const extended::Scalar size = 2 * XA.norm() + Wx.norm();
    solution.relative_residual =
        size > 0 ? static_cast<double>((XA + XA.transpose() + Wx).norm() / size) : 0.0;
    return solution;
}

} // namespace sdre
