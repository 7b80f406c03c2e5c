// SPDX-License-Identifier: MIT
/// Taylor series of the state-dependent Riccati equation in any number of scheduling variables s_k:
///
///     A(s) = A0 + sum_k s_k dA_k                                     EQ-SERIES-1
///     X(s) = sum_alpha s^alpha X_alpha,  |alpha| <= order            EQ-SERIES-2
///
/// X_0 solves one Riccati equation (EQ-CARE-1); every further X_alpha one Lyapunov equation with
/// the closed loop Acl = A0 - G X_0. With e_k the k-th unit multi-index (EQ-SERIES-3):
///
///     X_alpha Acl + Acl' X_alpha + sum_k (X_(alpha-e_k) dA_k + dA_k' X_(alpha-e_k))
///         - sum_(0 < beta < alpha) X_beta G X_(alpha-beta) = 0
///
/// Paper A's controller has one variable (e_iq); so has its observer, which is the dual problem:
/// pass A0', dA', C'T^-1C.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "linalg/care.hpp"

namespace sdre {

struct SdreProblem {
    Eigen::MatrixXd              A0; ///< n x n
    std::vector<Eigen::MatrixXd> dA; ///< one n x n matrix per scheduling variable
    Eigen::MatrixXd              G;  ///< n x n, symmetric >= 0
    Eigen::MatrixXd              Q;  ///< n x n, symmetric >= 0
};

struct SeriesTerm {
    std::vector<int> powers; ///< multi-index alpha, one exponent per scheduling variable
    Eigen::MatrixXd  X;      ///< n x n, symmetric
    double           relative_residual = 0.0;
};

struct SdreSeries {
    /// Sorted by total degree, then lexicographically with the first variable's power descending.
    std::vector<SeriesTerm> terms;
    CareSolution            care; ///< the term of degree 0

    /// X(s) truncated to total degree <= max_degree (all terms when negative). s has one value per
    /// variable.
    Eigen::MatrixXd evaluate(const std::vector<double> &s, int max_degree = -1) const;
};

/// A(s) of EQ-SERIES-1.
Eigen::MatrixXd state_matrix(const SdreProblem &problem, const std::vector<double> &s);

/// Throws InputError when order < 0 or shapes disagree, DesignError from the solvers. X_0 is found with the given
/// precision, the other terms in extended precision.
SdreSeries solve_sdre_series(const SdreProblem &problem, int order,
                             Precision precision = Precision::quick);

/// The SDRE solved exactly at the frozen state s (the reference that the series approximates).
CareSolution solve_sdre_exact(const SdreProblem &problem, const std::vector<double> &s);

} // namespace sdre
