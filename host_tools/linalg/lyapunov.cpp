// SPDX-License-Identifier: MIT
#include "linalg/lyapunov.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/extended.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre::extended {

namespace {

/// Spectral radius of a matrix without negative entries, to the few percent that a threshold needs.
Scalar perron_root(const Matrix &P)
{
    Vector v    = Vector::Ones(P.cols());
    Scalar root = 0;
    for (int step = 0; step < 30; ++step) {
        const Vector next = P * v;
        root              = next.maxCoeff();
        if (!(root > 0) || !std::isfinite(root)) {
            return root;
        }
        v = next / root;
    }
    return root;
}

/// Indices of the eigenvalues with Im >= 0 in ascending order of `key`, at most six.
template <class Key> std::vector<Eigen::Index> nearest(const ComplexVector &eigenvalues, Key key)
{
    std::vector<Eigen::Index> order;
    for (Eigen::Index i = 0; i < eigenvalues.size(); ++i) {
        if (eigenvalues(i).imag() >= 0) {
            order.push_back(i);
        }
    }
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return key(eigenvalues(a)) < key(eigenvalues(b));
    });
    order.resize(std::min<std::size_t>(order.size(), 6));
    return order;
}

} // namespace

Matrix symmetric_part(const Matrix &M)
{
    return (M + M.transpose()) / Scalar(2);
}

ComplexVector eigenvalues(const Matrix &M)
{
    const Eigen::EigenSolver<Matrix> eigen(M, false);
    if (eigen.info() != Eigen::Success) {
        throw DesignError("the eigenvalue iteration did not converge");
    }
    return eigen.eigenvalues();
}

Eigen::VectorXcd sorted_eigenvalues(const ComplexVector &eigenvalues)
{
    Eigen::VectorXcd sorted = eigenvalues.cast<std::complex<double>>();
    std::sort(sorted.data(), sorted.data() + sorted.size(), [](const auto &a, const auto &b) {
        return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
    });
    return sorted;
}

bool touches_axis(const Matrix &M, Scalar omega)
{
    // M - j omega I turns singular under a change |dM| <= t |M| only if t rho(|(M - j omega I)^-1|
    // |M|) >= 1, and rho is the same for every diagonal scaling of the states.
    const Eigen::Index n       = M.rows();
    ComplexMatrix      shifted = M.cast<Complex>();
    shifted.diagonal().array() -= Complex(0, omega);
    const Matrix inverse = shifted.partialPivLu().inverse().cwiseAbs();
    if (!inverse.allFinite()) {
        return true;
    }
    const Scalar rounding =
        Scalar(2 * n) * static_cast<Scalar>(std::numeric_limits<double>::epsilon());
    return !(perron_root(inverse * M.cwiseAbs()) * rounding < 1);
}

bool find_axis_eigenvalue(const Matrix &M, const ComplexVector &eigenvalues, Complex &found)
{
    const auto absolute = nearest(eigenvalues, [](Complex s) { return std::abs(s.real()); });
    const auto relative = nearest(eigenvalues, [](Complex s) {
        const Scalar size = std::abs(s);
        return size > 0 ? std::abs(s.real()) / size : Scalar(0);
    });
    std::vector<Scalar> tried;
    for (const auto &order : {absolute, relative}) {
        for (const Eigen::Index i : order) {
            const Scalar omega = eigenvalues(i).imag();
            if (std::find(tried.begin(), tried.end(), omega) != tried.end()) {
                continue;
            }
            tried.push_back(omega);
            if (touches_axis(M, omega)) {
                found = Complex(0, omega);
                return true;
            }
        }
    }
    return false;
}

SchurForm schur_form(const Matrix &M)
{
    const Eigen::ComplexSchur<Matrix> schur(M, true);
    if (schur.info() != Eigen::Success) {
        throw DesignError("the Schur iteration did not converge");
    }
    return {schur.matrixT(), schur.matrixU()};
}

LyapunovSolver::LyapunovSolver(const Matrix &A) : schur_(schur_form(A)) {}

Matrix LyapunovSolver::solve(const Matrix &W) const
{
    // With A = U T U^H and Y = U^H X U the equation reads T^H Y + Y T = -U^H W U; T is upper
    // triangular, so each column of Y follows from the columns before it by forward substitution.
    const Eigen::Index  n    = schur_.T.rows();
    const ComplexMatrix C    = schur_.U.adjoint() * W.cast<Complex>() * schur_.U;
    ComplexMatrix       Y    = ComplexMatrix::Zero(n, n);
    ComplexMatrix       left = schur_.T.adjoint();
    for (Eigen::Index j = 0; j < n; ++j) {
        const ComplexVector rhs = -C.col(j) - Y.leftCols(j) * schur_.T.col(j).head(j);
        left.diagonal()         = schur_.T.diagonal().conjugate().array() + schur_.T(j, j);
        Y.col(j)                = left.triangularView<Eigen::Lower>().solve(rhs);
    }
    return symmetric_part((schur_.U * Y * schur_.U.adjoint()).real());
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
    const extended::Matrix XA   = solution.X.cast<extended::Scalar>() * Ax;
    const extended::Scalar size = 2 * XA.norm() + Wx.norm();
    solution.relative_residual =
        size > 0 ? static_cast<double>((XA + XA.transpose() + Wx).norm() / size) : 0.0;
    return solution;
}

} // namespace sdre
