// SPDX-License-Identifier: MIT
/// Types of the solvers in long double.
///
/// On x86 a long double has 64 bits of mantissa, eleven more than the double at input and output.
/// The eleven bits compensate the conditioning of the equation. Results are correct to the last
/// digits of a double up to about 1e3 times the condition number that a double solver allows. Where
/// long double is no wider than double, everything works with the accuracy of a double solver.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace sdre::extended {

using Scalar        = long double;
using Complex       = std::complex<Scalar>;
using Matrix        = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
using Vector        = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;
using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;

/// (M + M') / 2
inline Matrix symmetric_part(const Matrix &M)
{
    return (M + M.transpose()) / Scalar(2);
}

/// G = F F'. F is kept as a factor when B and R are known. B R^-1 B' of a nearly singular R loses
/// digits that X G X = (F'X)'(F'X) keeps.
struct ControlWeight {
    Matrix G;
    Matrix F; ///< empty when only G is known

    /// X G X
    Matrix quadratic(const Matrix &X) const;
};

/// DesignError when R is not symmetric positive definite, InputError on wrong shapes or non-finite
/// entries.
ControlWeight control_weight(const Eigen::MatrixXd &B, const Eigen::MatrixXd &R);

} // namespace sdre::extended
