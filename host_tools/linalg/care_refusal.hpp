// SPDX-License-Identifier: MIT
/// Why a Riccati equation has no stabilising solution: the assumption that fails, by name.
#pragma once

#include <string>

#include "linalg/care_problem.hpp"

namespace sdre::extended {

/// DesignError when a mode with Re s >= 0 is out of reach of the input.
void require_stabilisable(const Problem &p);

/// DesignError when an eigenvalue of the Hamiltonian touches the imaginary axis.
void require_no_axis_eigenvalue(const Problem &p, const Matrix &hamiltonian);

/// For failures after the checks above: names the assumption that nearly fails.
[[noreturn]] void refuse(const Problem &balanced, const std::string &reason);

} // namespace sdre::extended
