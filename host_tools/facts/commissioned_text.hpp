// SPDX-License-Identifier: MIT
/// A drive file with the values that a commissioning found in place of its own, the rest byte for byte.
#pragma once

#include <string>

#include "facts/found_file.hpp"

namespace sdre {

/// Describes the shaft between motor and load, as the commissioning found it.
std::string coupling_words(const commission_result_t &found);

/// Says what the measured inductances are good for, up to the current limit [A]; empty without a measurement.
std::string iron_words(const Found &found, double limit_A);

/// [mechanics] is that of the search for a resonance; without a search it stays. The table [saturation] is that of the measured
/// inductances, up to the current limit [A]. It is written when they change with the current, or when the file has one; without
/// a measurement it stays. InputError when a key of [motor] does not stand on a line of its own.
std::string commissioned_text(const std::string &drive_text, const Found &found, double limit_A,
                              const std::string &origin);

} // namespace sdre
