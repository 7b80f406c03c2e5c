// SPDX-License-Identifier: MIT
/// The register instances that the headers declare.
#pragma once

#include "DSP28x_Project.h"

namespace sdre::f28335 {

/// Everything zero, then the values that reset leaves and that the drivers or the model depend on.
void reset_registers();

} // namespace sdre::f28335
