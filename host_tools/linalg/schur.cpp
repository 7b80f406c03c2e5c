// SPDX-License-Identifier: MIT
#include "linalg/schur.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Jacobi>

#include "common/errors.hpp"
#include "linalg/hessenberg.hpp"

namespace sdre::extended {

namespace {

Eigen::RealSchur<Matrix> real_schur(const Matrix &M, bool with_u)
{
    Matrix                   H = M;
    Matrix                   Q = Matrix::Identity(M.rows(), M.cols());
    Eigen::RealSchur<Matrix> schur(M.rows());
    reduce_to_hessenberg(H, with_u ? &Q : nullptr);
    schur.computeFromHessenberg(H, Q, with_u);
    if (schur.info() != Eigen::Success) {
        throw DesignError("the Schur iteration did not converge");
    }
    return schur;
}

bool starts_pair(const Matrix &T, Eigen::Index k)
{
    return k + 1 < T.rows() && T(k + 1, k) != 0;
}

/// The eigenvalue with Im > 0 of the 2 x 2 block at k, which holds a conjugate pair.
Complex pair_at(const Matrix &T, Eigen::Index k)
{
    const Scalar p = (T(k, k) - T(k + 1, k + 1)) / 2;
    return {T(k + 1, k + 1) + p, std::sqrt(std::abs(p * p + T(k + 1, k) * T(k, k + 1)))};
}

/// Columns k and k + 1 of M times Q = [c -s; s c*], s real.
void turn_columns(ComplexMatrix &M, Eigen::Index k, Complex c, Scalar s)
{
    for (Eigen::Index i = 0; i < M.rows(); i++) {
        const Complex first = M(i, k);
        M(i, k)             = first * c + M(i, k + 1) * s;
        M(i, k + 1)         = M(i, k + 1) * std::conj(c) - first * s;
    }
}

} // namespace

SchurForm schur_form(const Matrix &M)
{
    const Eigen::RealSchur<Matrix> schur = real_schur(M, true);
    const Matrix                  &T     = schur.matrixT();
    SchurForm                      form{T.cast<Complex>(), schur.matrixU().cast<Complex>()};
    for (Eigen::Index k = 0; k < M.rows(); k++) {
        if (!starts_pair(T, k)) {
            continue;
        }
        // The first column of Q is the block's eigenvector.
        const Complex s    = pair_at(T, k);
        const Complex c    = s - T(k + 1, k + 1);
        const Scalar  size = std::hypot(std::abs(c), T(k + 1, k));
        const Scalar  sine = T(k + 1, k) / size;
        turn_columns(form.T, k, c / size, sine);
        turn_columns(form.U, k, c / size, sine);
        form.T.transposeInPlace();
        turn_columns(form.T, k, std::conj(c) / size, sine);
        form.T.transposeInPlace();
        form.T(k, k)         = s;
        form.T(k + 1, k + 1) = std::conj(s);
        form.T(k + 1, k)     = 0;
    }
    return form;
}

void swap_neighbours(SchurForm &s, Eigen::Index k)
{
    const Eigen::Index             size   = s.T.rows();
    const Complex                  first  = s.T(k, k);
    const Complex                  second = s.T(k + 1, k + 1);
    Eigen::JacobiRotation<Complex> rotation;
    rotation.makeGivens(s.T(k, k + 1), second - first);
    s.T.rightCols(size - k).applyOnTheLeft(k, k + 1, rotation.adjoint());
    s.T.topRows(k + 2).applyOnTheRight(k, k + 1, rotation);
    s.U.applyOnTheRight(k, k + 1, rotation);
    s.T(k, k)         = second;
    s.T(k + 1, k + 1) = first;
    s.T(k + 1, k)     = 0;
}

ComplexVector eigenvalues(const Matrix &M)
{
    const Eigen::RealSchur<Matrix> schur  = real_schur(M, false);
    const Matrix                  &T      = schur.matrixT();
    ComplexVector                  values = T.diagonal().cast<Complex>();
    for (Eigen::Index k = 0; k < M.rows(); k++) {
        if (starts_pair(T, k)) {
            values(k)     = pair_at(T, k);
            values(k + 1) = std::conj(values(k));
        }
    }
    return values;
}

Eigen::VectorXcd sorted_eigenvalues(const ComplexVector &eigenvalues)
{
    Eigen::VectorXcd sorted = eigenvalues.cast<std::complex<double>>();
    std::sort(sorted.data(), sorted.data() + sorted.size(), [](const auto &a, const auto &b) {
        return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
    });
    return sorted;
}

} // namespace sdre::extended
