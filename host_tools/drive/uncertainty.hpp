// SPDX-License-Identifier: MIT
/// How well the values of a drive file are known: what `verify` allows a real machine to differ.
#pragma once

#include <optional>

#include "common/toml_reader.hpp"

namespace sdre {

/// Half widths. The defaults are chosen: a data sheet's usual tolerances and a commissioned angle.
struct Uncertainty {
    double inertia      = 0.1;  ///< share, as the next four
    double pm_flux      = 0.05; ///< a magnet between 20 and 70 degrees Celsius
    double inductance   = 0.1;  ///< of each axis
    double resistance   = 0.2;  ///< copper between 20 and 70 degrees Celsius
    double dead_time    = 0.2;
    double friction     = 0.02; ///< dry friction up to this share of the rated torque
    double angle_e_rad  = 0.03; ///< of the encoder's zero
    double disc_own_cnt = 0.01; ///< rms
};

/// The table [uncertainty]; without it the defaults. InputError on anything unknown or out of range.
Uncertainty read_uncertainty(std::optional<TomlReader> t);

} // namespace sdre
