// SPDX-License-Identifier: MIT
/// Inverses in long double.
#pragma once

#include "linalg/extended.hpp"

namespace sdre::extended {

/// Not finite when M is singular.
Matrix        inverse(Matrix M);
ComplexMatrix inverse(ComplexMatrix M);

} // namespace sdre::extended
