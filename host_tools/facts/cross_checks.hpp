// SPDX-License-Identifier: MIT
/// Checks that the facts of a data sheet are consistent, also with the inverter. Each contradiction
/// names both values.
#pragma once

#include "facts/machine.hpp"

namespace sdre {

/// Checks torque, power and time constants that the sheet states beside the values that were read.
void check_ratings(const Facts &facts, const Machine &m, Findings &findings);

/// Checks physics: voltage, current slope, acceleration, counts of the encoder, flux of the iron.
void check_machine(const Machine &m, Findings &findings);

} // namespace sdre
