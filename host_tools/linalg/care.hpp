// SPDX-License-Identifier: MIT
/// Continuous-time algebraic Riccati equation (EQ-CARE-1)
///
///     A'X + X A - X G X + Q = 0,   G = B R^-1 B'
///
/// Conventions follow the control literature: A, Q, G, X are n x n, B is n x m, R is m x m.
#pragma once

#include <Eigen/Core>

namespace sdre {

struct CareSolution {
    Eigen::MatrixXd X;                   ///< stabilising solution, symmetric
    bool            semidefinite = true; ///< X >= 0; an indefinite Q may leave none such
    double relative_residual     = 0.0;  ///< EQ-CARE-2: |A'X+XA-XGX+Q|_F / (2|A'X|_F+|XGX|_F+|Q|_F)
    Eigen::VectorXcd closed_loop_eigenvalues; ///< of A - G X, sorted by real, then imaginary part
};

enum class Precision {
    quick, ///< in double, corrected to the last digits of X; in long double where that cannot be vouched for
    extended ///< in long double from the start
};

struct CareOptions {
    Precision precision = Precision::quick;
    bool      allow_indefinite =
        false; ///< return a stabilising X that is not >= 0 instead of refusing it
};

/// B R^-1 B'. Throws DesignError when R is not symmetric positive definite, InputError on wrong
/// shapes.
Eigen::MatrixXd control_weight(const Eigen::MatrixXd &B, const Eigen::MatrixXd &R);

/// Stabilising solution of EQ-CARE-1. Throws InputError on wrong shapes or non-finite entries.
/// Throws DesignError with the failed assumption: Q or G not symmetric, G not positive
/// semidefinite, (A,B) not stabilisable, (A,Q) not detectable. Hamiltonian eigenvalues on the
/// imaginary axis are another one.
///
/// An indefinite Q is refused when there is no stabilising X >= 0; the options may allow any X.
/// Benchmark cases 1.3 and 2.5 have X >= 0, case 1.4 has only an indefinite X. A mode that Q does not
/// weight is refused on the imaginary axis. Off the axis a stabilising solution exists and is returned. The returned X is verified: small residual, A - G X Hurwitz.
CareSolution solve_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &G,
                        const Eigen::MatrixXd &Q, const CareOptions &options = {});

/// The same with G = B R^-1 B' kept to more digits than the double matrix of control_weight() has.
/// Prefer it when R is nearly singular. Also throws DesignError when R is not symmetric positive
/// definite.
CareSolution solve_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B,
                        const Eigen::MatrixXd &R, const Eigen::MatrixXd &Q,
                        const CareOptions &options = {});

} // namespace sdre
