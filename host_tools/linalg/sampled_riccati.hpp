// SPDX-License-Identifier: MIT
/// The Riccati equation of a sampled observer, and the first term of its series in one scheduling variable.
///
///     P = A P A' - A P C' S^-1 C P A' + Q,  S = C P C' + R,  K = P C' S^-1          EQ-DARE-1
///
/// K corrects: x^+ = x^- + K (y - C x^-). Let A = A_0 + s A_1, Q = Q_0 + s Q_1 and F = A_0 (I - K_0 C).
/// The derivatives at s = 0 obey a Stein equation, the sampled form of Lyapunov's:
///
///     P_1 = F P_1 F' + A_1 (I - K_0 C) P_0 A_0' + A_0 (I - K_0 C) P_0 A_1' + Q_1     EQ-DARE-2
///     K_1 = (I - K_0 C) P_1 C' S_0^-1
#pragma once

#include <Eigen/Core>

namespace sdre {

/// n states, m measurements.
struct SampledObserverProblem {
    Eigen::MatrixXd A0, A1; ///< n x n
    Eigen::MatrixXd Q0, Q1; ///< n x n, symmetric; Q0 >= 0
    Eigen::MatrixXd C;      ///< m x n
    Eigen::MatrixXd R;      ///< m x m, > 0
};

struct SampledObserverGain {
    Eigen::MatrixXd K0, K1;                 ///< n x m
    Eigen::MatrixXd P0, P1;                 ///< n x n, symmetric
    double          riccati_residual = 0.0; ///< relative, Frobenius
    double          stein_residual   = 0.0;
    double          spectral_radius  = 0.0; ///< of F
};

/// DesignError when the doubling iteration finds no stabilising solution. Wrong shapes are a programming error.
SampledObserverGain solve_sampled_observer(const SampledObserverProblem &problem);

} // namespace sdre
