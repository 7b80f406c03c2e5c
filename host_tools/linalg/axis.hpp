// SPDX-License-Identifier: MIT
/// Eigenvalues that rounding can put on the imaginary axis.
#pragma once

#include "linalg/extended.hpp"

namespace sdre::extended {

/// True when rounding the entries of M to double can put an eigenvalue of M on the point omega of
/// the imaginary axis. The measure does not depend on the scaling of the states.
bool touches_axis(const Matrix &M, Scalar omega);

/// The eigenvalue of M that touches the imaginary axis in the sense of touches_axis. Looks at those
/// nearest to the axis, absolutely and relative to their size. False when there is none.
bool find_axis_eigenvalue(const Matrix &M, const ComplexVector &eigenvalues, Complex &found);

} // namespace sdre::extended
