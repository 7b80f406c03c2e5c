// SPDX-License-Identifier: MIT
/// The ideal inverter: voltages from duty ratios alone.
#pragma once

#include "drive/core_types.hpp"
#include "sil/plant/vectors.hpp"

namespace sdre {

/// Stator voltage over one period from three duty ratios (EQ-INVERTER-1). With the gates off the diodes
/// conduct: each phase is at the rail that opposes its current; a phase without current floats.
StatorVector inverter_voltage(const bridge_t &output, double dc_link_V, StatorVector current_A);

} // namespace sdre
