// SPDX-License-Identifier: MIT
/// The ideal inverter: voltages from duty ratios alone.
#pragma once

#include "drive/core_types.hpp"
#include "sil/plant/vectors.hpp"

namespace sdre {

/// Stator voltage over one period from the duty ratios of a closed bridge (EQ-INVERTER-1).
StatorVector inverter_voltage(const bridge_t &closed, double dc_link_V);

} // namespace sdre
