// SPDX-License-Identifier: MIT
/// Continuous-time Lyapunov equation (EQ-LYAP-1)   A'X + X A + W = 0,   W symmetric.
#pragma once

#include <Eigen/Core>

#include "linalg/schur.hpp"

namespace sdre {

struct LyapunovSolution {
    Eigen::MatrixXd X;                       ///< symmetric
    double          relative_residual = 0.0; ///< |A'X+XA+W|_F / (2|A'X|_F+|W|_F); 0 when W = 0
};

/// Throws InputError on wrong shapes, non-finite entries or unsymmetric W; DesignError when A is
/// not Hurwitz.
LyapunovSolution solve_lyapunov(const Eigen::MatrixXd &A, const Eigen::MatrixXd &W);

namespace extended {

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

} // namespace extended
} // namespace sdre
