// SPDX-License-Identifier: MIT
/// Internal kernels of the matrix equation solvers in long double.
///
/// On x86 a long double carries 64 bits of mantissa, eleven more than the double that goes in and
/// out. The eleven bits pay for the conditioning of the equation: results are then correct to the
/// last digits of a double wherever the condition number stays below about 1e3 times what a double
/// solver could bear. Where long double is no wider than double everything still works, with the
/// accuracy of a double solver.
#pragma once

#include <complex>

#include <Eigen/Core>

#include "linalg/riccati.hpp"

namespace sdre::extended {

using Scalar        = long double;
using Complex       = std::complex<Scalar>;
using Matrix        = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
using Vector        = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;
using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;

/// (M + M') / 2
Matrix symmetric_part(const Matrix &M);

/// Eigenvalues in exact conjugate pairs; DesignError when the iteration fails.
ComplexVector eigenvalues(const Matrix &M);

/// As doubles, sorted by real, then imaginary part.
Eigen::VectorXcd sorted_eigenvalues(const ComplexVector &eigenvalues);

/// True when a relative change of the entries of M by the rounding of a double can put an
/// eigenvalue of M on the point omega of the imaginary axis. The measure does not depend on how the
/// states are scaled.
bool touches_axis(const Matrix &M, Scalar omega);

/// The eigenvalue of M that touches the imaginary axis in the sense of touches_axis. Looks at those
/// nearest to the axis, absolutely and relative to their size. False when there is none.
bool find_axis_eigenvalue(const Matrix &M, const ComplexVector &eigenvalues, Complex &found);

/// M = U T U^H, T upper triangular, U unitary.
struct SchurForm {
    ComplexMatrix T;
    ComplexMatrix U;
};

/// DesignError when the iteration fails.
SchurForm schur_form(const Matrix &M);

/// Factorises A once, then solves EQ-LYAP-1 for any number of right-hand sides.
class LyapunovSolver {
public:
    /// DesignError when the Schur iteration fails. Any A without eigenvalues s, -s is accepted.
    explicit LyapunovSolver(const Matrix &A);

    /// X of A'X + X A + W = 0, W symmetric.
    Matrix solve(const Matrix &W) const;

private:
    SchurForm schur_;
};

/// G = F F'. Kept as a factor when B and R are known: B R^-1 B' of a nearly singular R loses digits
/// that X G X = (F'X)'(F'X) keeps.
struct ControlWeight {
    Matrix G;
    Matrix F; ///< empty when only G is known

    /// X G X
    Matrix quadratic(const Matrix &X) const;
};

/// DesignError when R is not symmetric positive definite, InputError on wrong shapes or non-finite
/// entries.
ControlWeight control_weight(const Eigen::MatrixXd &B, const Eigen::MatrixXd &R);

/// What sdre::solve_care returns, and its X before rounding to double.
struct CareResult {
    CareSolution solution;
    Matrix       X;
};

/// sdre::solve_care with all its checks.
CareResult solve_verified_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &G,
                               const Eigen::MatrixXd &Q);
CareResult solve_verified_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B,
                               const Eigen::MatrixXd &R, const Eigen::MatrixXd &Q);

} // namespace sdre::extended
