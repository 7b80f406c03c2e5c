// SPDX-License-Identifier: MIT
/// Averaged three-phase two-level inverter.
#pragma once

#include "core_types.hpp"
#include "plant.hpp"

namespace sdre {

/// Stator voltage over one period from three duty ratios (EQ-INVERTER-1). With the gates off the diodes
/// conduct: each phase is at the rail that opposes its current; a phase without current floats.
StatorVector inverter_voltage(const drive_output_t &output, double dc_link_V,
                              StatorVector current_A);

} // namespace sdre
