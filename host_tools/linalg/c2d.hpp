// SPDX-License-Identifier: MIT
/// Linear systems over one sampling period, exactly.
#pragma once

#include "linalg/extended.hpp"

namespace sdre {

/// x(k+1) = Phi x(k) + Gamma u(k)
template <class Matrix> struct Held {
    Matrix Phi;
    Matrix Gamma;
};

/// x' = A x + B u with u held: the exponential of [A B; 0 0] ts.
Held<Eigen::MatrixXd>  c2d(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B, double ts_s);
Held<extended::Matrix> c2d(const extended::Matrix &A, const extended::Matrix &B,
                           extended::Scalar ts_s);

/// e^(A ts) and its derivative in the direction dA: the exponential of [A dA; 0 A] ts.
struct Transition {
    Eigen::MatrixXd Phi;
    Eigen::MatrixXd dPhi;
};

Transition transition(const Eigen::MatrixXd &A, const Eigen::MatrixXd &dA, double ts_s);

} // namespace sdre
