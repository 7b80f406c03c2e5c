// SPDX-License-Identifier: MIT
/// Weights without a specification: goals from physics, start point in the motor's own units, certified.
#pragma once

#include <string>

#include "tune/tune.hpp"

namespace sdre {

struct AutoTuneResult {
    TuneResult  tuned;
    TuneSpec    goals;
    std::string binding; ///< which goal is hardest, with its ratio, and what would relax it
};

/// Deterministic. DesignError when nothing that was found is certified, with the certificate's reason.
AutoTuneResult auto_tune(const Drive &drive, const TuneProgress &progress);

} // namespace sdre
