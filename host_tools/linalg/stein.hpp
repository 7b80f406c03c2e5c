// SPDX-License-Identifier: MIT
/// Stein equation, the sampled form of Lyapunov's.
#pragma once

#include "linalg/extended.hpp"

namespace sdre::extended {

/// X = F X F' + W, W symmetric, by squaring F. DesignError when F has an eigenvalue on or outside the unit circle.
Matrix solve_stein(Matrix F, const Matrix &W);

} // namespace sdre::extended
