// SPDX-License-Identifier: MIT
/// A drive file with the values that a commissioning found in place of its own, the rest byte for byte.
#pragma once

#include <string>

extern "C" {
#include "commission_types.h"
}

namespace sdre {

/// Describes the shaft between motor and load, as the commissioning found it.
std::string coupling_words(const commission_result_t &found);

/// [mechanics] is that of the search for a resonance; without a search it stays. InputError when a key of [motor] does not stand on a line of its own.
std::string commissioned_text(const std::string &drive_text, const commission_result_t &found,
                              const std::string &origin);

} // namespace sdre
