// SPDX-License-Identifier: MIT
/// Products of small matrices in long double.
#pragma once

#include "linalg/extended.hpp"

namespace sdre::extended {

/// A B with the sums of a plain loop, four at a time: they do not wait for each other's additions.
Matrix product(const Matrix &A, const Matrix &B);

} // namespace sdre::extended
