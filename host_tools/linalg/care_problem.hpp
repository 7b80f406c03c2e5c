// SPDX-License-Identifier: MIT
/// A Riccati equation in long double with what the extended solver asks of it.
#pragma once

#include "linalg/extended.hpp"

namespace sdre::extended {

struct Problem {
    Matrix        A;
    ControlWeight weight;
    Matrix        Q;
};

/// A'X + XA - XGX + Q                                                               EQ-CARE-1
Matrix residual(const Problem &p, const Matrix &X);

/// EQ-CARE-2
Scalar relative_residual(const Problem &p, const Matrix &X);

/// The relative change of the entries of A, G and Q that explains the residual. Where the terms of
/// X G X cancel, it stays small while EQ-CARE-2 grows. A double matrix G then has no more
/// information on X.
Scalar backward_error(const Problem &p, const Matrix &X);

/// Powers of two d such that x = diag(d) z brings rows and columns of the Hamiltonian to similar
/// size. In z the equation keeps its form with A_ij d_j/d_i, G_ij/(d_i d_j), Q_ij d_i d_j and X_ij
/// d_i d_j, exactly.
Vector balancing(const Problem &p);

/// The problem in z.
Problem scaled(const Problem &p, const Vector &d);

Matrix hamiltonian(const Problem &p);

} // namespace sdre::extended
