// SPDX-License-Identifier: MIT
/// Samples that are wrong for a moment: what an interference does to a reading, not to the motor.
#pragma once

#include <vector>

#include "common/toml_reader.hpp"

namespace sdre {

struct Glitch {
    double time_s      = 0.0; ///< of the first wrong sample
    int    samples     = 1;
    int    encoder_cnt = 0; ///< added to the position as it is read; the counter goes on as it was
    double ia_A        = 0.0; ///< added to what the converter sees, which ends at its full scale
    double ib_A        = 0.0;
};

/// The [[glitch]] entries.
std::vector<Glitch> read_glitches(TomlReader &t);

/// Errors of the sample at an instant; zero without an entry.
Glitch glitch_at(const std::vector<Glitch> &glitches, double time_s, double period_s);

} // namespace sdre
