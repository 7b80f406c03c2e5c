// SPDX-License-Identifier: MIT
#include "linalg/care_refusal.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/axis.hpp"
#include "linalg/linalg_checks.hpp"
#include "linalg/schur.hpp"

namespace sdre::extended {

namespace {

/// Last over first pivot of M = Q R with the longest remaining column first, by Gram and Schmidt.
Scalar pivot_ratio(ComplexMatrix M)
{
    const Eigen::Index n       = M.cols();
    Scalar             largest = 0;
    for (Eigen::Index k = 0; k < n; k++) {
        Eigen::Index pivot  = k;
        Scalar       length = -1;
        for (Eigen::Index j = k; j < n; j++) {
            if (const Scalar size = M.col(j).norm(); size > length) {
                length = size;
                pivot  = j;
            }
        }
        largest = std::max(largest, length);
        if (!(length > 0) || k == n - 1) {
            return largest > 0 ? length / largest : Scalar(0);
        }
        M.col(k).swap(M.col(pivot));
        M.col(k) /= Complex(length);
        for (Eigen::Index j = k + 1; j < n; j++) {
            const Complex along = M.col(k).dot(M.col(j));
            M.col(j) -= along * M.col(k);
        }
    }
    return 0;
}

/// Distance of [A - sI, W] from a loss of rank, between 0 and 1. It does not depend on the size of
/// the columns of W or on the scaling of single states. 0 means that the mode s is not connected to
/// W.
Scalar hautus_margin(const Matrix &A, const Matrix &W, Complex s)
{
    const Eigen::Index n = A.rows();
    ComplexMatrix      M(n, 2 * n);
    M << A.cast<Complex>(), W.cast<Complex>();
    M.leftCols(n).diagonal().array() -= s;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar size = A.row(i).norm() + std::abs(s);
        if (size > 0) {
            M.row(i) /= Complex(size);
        }
    }
    const Scalar floor =
        M.rightCols(n).colwise().norm().maxCoeff() * std::numeric_limits<Scalar>::epsilon();
    for (Eigen::Index j = n; j < 2 * n && floor > 0; ++j) {
        M.col(j) /= Complex(std::max(floor, Scalar(M.col(j).norm())));
    }
    return pivot_ratio(M.adjoint());
}

std::string unstabilisable_text(Complex s)
{
    return fmt::format("(A,B) is not stabilisable: mode at s = {} cannot be moved",
                       mode_text(std::complex<double>(s)));
}

/// The mode with Re s >= 0 that the input reaches least.
struct WeakestMode {
    Complex s{0, 0};
    Scalar  margin = 1;
};

WeakestMode weakest_unstable_mode(const Problem &p)
{
    const ComplexVector modes = eigenvalues(p.A);
    WeakestMode         weakest;
    for (const Complex &s : modes) {
        if (s.real() < 0 || s.imag() < 0) {
            continue;
        }
        const Scalar margin = hautus_margin(p.A, p.weight.G, s);
        if (margin < weakest.margin) {
            weakest = {s, margin};
        }
    }
    return weakest;
}

} // namespace

void require_stabilisable(const Problem &p)
{
    const WeakestMode weakest = weakest_unstable_mode(p);
    if (weakest.margin <= Scalar(4 * p.A.rows()) * Scalar(std::numeric_limits<double>::epsilon())) {
        throw DesignError(unstabilisable_text(weakest.s));
    }
}

/// For G, Q >= 0 the Hamiltonian has an eigenvalue on the axis in two cases only. A mode of A on
/// the axis is not controllable, or it is not observable in Q. The smaller margin shows which one.
void require_no_axis_eigenvalue(const Problem &p, const Matrix &hamiltonian)
{
    Complex s;
    if (!find_axis_eigenvalue(hamiltonian, eigenvalues(hamiltonian), s)) {
        return;
    }
    const std::string axis = fmt::format(
        "Hamiltonian has eigenvalues on the imaginary axis (s = {}): no stabilising solution",
        mode_text(std::complex<double>(s)));
    constexpr Scalar lost  = 1e-6L;
    const Scalar     reach = hautus_margin(p.A, p.weight.G, s);
    const Scalar     sight = hautus_margin(p.A.transpose(), p.Q, std::conj(s));
    if (reach < lost && reach <= sight) {
        throw DesignError(unstabilisable_text(s) + "; " + axis);
    }
    if (sight < lost) {
        throw DesignError(
            fmt::format("(A,Q) is not detectable: mode at s = {} is not weighted by Q; {}",
                        mode_text(std::complex<double>(s)), axis));
    }
    throw DesignError(axis);
}

void refuse(const Problem &balanced, const std::string &reason)
{
    constexpr Scalar  nearly_lost = 1e-9L;
    const WeakestMode weakest     = weakest_unstable_mode(balanced);
    if (weakest.margin < nearly_lost) {
        throw DesignError(unstabilisable_text(weakest.s) + " to working precision; " + reason);
    }
    throw DesignError("no acceptable solution: " + reason);
}

} // namespace sdre::extended
