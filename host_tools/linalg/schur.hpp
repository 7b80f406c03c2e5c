// SPDX-License-Identifier: MIT
/// Schur form and eigenvalues in long double.
#pragma once

#include "linalg/extended.hpp"

namespace sdre::extended {

/// M = U T U^H, T upper triangular, U unitary.
struct SchurForm {
    ComplexMatrix T;
    ComplexMatrix U;
};

/// DesignError when the iteration fails.
SchurForm schur_form(const Matrix &M);

/// Exchanges the neighbouring eigenvalues k and k + 1 of the triangular factor.
void swap_neighbours(SchurForm &s, Eigen::Index k);

/// Eigenvalues in exact conjugate pairs; DesignError when the iteration fails.
ComplexVector eigenvalues(const Matrix &M);

/// As doubles, sorted by real, then imaginary part.
Eigen::VectorXcd sorted_eigenvalues(const ComplexVector &eigenvalues);

} // namespace sdre::extended
