// SPDX-License-Identifier: MIT
/// c (zI - A)^-1 b at any number of points z.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace sdre {

/// A is brought to Hessenberg form once; a point then costs n^2 instead of n^3.
class TransferFunction {
public:
    TransferFunction(const Eigen::MatrixXd &A, const Eigen::VectorXd &b,
                     const Eigen::RowVectorXd &c);

    /// Not finite at an eigenvalue of A.
    std::complex<double> at(std::complex<double> z) const;

private:
    Eigen::MatrixXd    H_;
    Eigen::VectorXd    b_;
    Eigen::RowVectorXd c_;
};

} // namespace sdre
