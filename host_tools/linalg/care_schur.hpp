// SPDX-License-Identifier: MIT
/// The thorough way to the stabilising solution: invariant subspace of the scaled Hamiltonian from
/// an ordered Schur form, then Newton steps, all in long double (extended.hpp says why). The Schur
/// form finds the solution whatever the starting point; the Newton steps remove what its orthogonal
/// transformations lost to the size of X. Every refusal names the assumption that fails.
#pragma once

#include "linalg/care.hpp"
#include "linalg/care_problem.hpp"

namespace sdre::extended {

/// What sdre::solve_care returns, and its X before rounding to double.
struct CareResult {
    CareSolution solution;
    Matrix       X;
};

/// The double X that is returned, not a better one, is verified: it solves and stabilises.
CareResult solve_care_by_schur(const Problem &p);

} // namespace sdre::extended
