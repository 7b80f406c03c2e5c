// SPDX-License-Identifier: MIT
/// The observer that has lost its encoder: a Riccati equation with the currents alone, at some speeds without load.
#pragma once

#include <string>

#include "design/sampled_model.hpp"
#include "drive/core_types.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

struct CurrentObserver {
    nodo_current_gains_t gains{};
    double               worst_residual  = 0.0; ///< of the Riccati equations
    double               spectral_radius = 0.0; ///< of the errors, worst over speeds and currents
};

CurrentObserver design_nodo_current(const ReducedParameters &l, const Drive &drive,
                                    double trip_e_radps);

/// Spectral radius of the errors of this observer with another motor, at a speed from the first
/// node on.
double nodo_current_radius(const nodo_current_gains_t &gains, const ReducedParameters &motor,
                           const OperatingPoint &at, double ts_s);

/// ".gain = {..},\n"
std::string nodo_current_block(const nodo_current_gains_t &gains);

} // namespace sdre
