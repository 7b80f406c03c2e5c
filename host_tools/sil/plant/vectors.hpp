// SPDX-License-Identifier: MIT
/// Vectors of the plant, in double precision.
#pragma once

namespace sdre {

struct RotorVector {
    double d = 0.0;
    double q = 0.0;
};

struct StatorVector {
    double alpha = 0.0;
    double beta  = 0.0;
};

struct PhaseVector {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
};

} // namespace sdre
