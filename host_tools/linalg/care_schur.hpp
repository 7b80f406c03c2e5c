// SPDX-License-Identifier: MIT
/// The thorough solver. An ordered Schur form gives the invariant subspace of the scaled Hamiltonian;
/// Newton steps follow, all in long double (reason: extended.hpp). The Schur form needs no starting
/// point. The Newton steps remove the error of its orthogonal transformations at a large X. Every refusal names the assumption that fails.
#pragma once

#include "linalg/care.hpp"
#include "linalg/care_problem.hpp"

namespace sdre::extended {

/// The result of sdre::solve_care, and its X before rounding to double.
struct CareResult {
    CareSolution solution;
    Matrix       X;
};

/// The double X that is returned, not a better one, is verified: it solves and stabilises.
CareResult solve_care_by_schur(const Problem &p);

} // namespace sdre::extended
