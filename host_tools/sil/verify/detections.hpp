// SPDX-License-Identifier: MIT
/// How well a comparison would work on a drive: simulated machines with one value changed.
#pragma once

#include <string>
#include <vector>

#include "sil/verify/judge.hpp"

namespace sdre {

/// Machines with the same change.
struct Detection {
    std::string what; ///< "inertia +", ..; "none" without a change
    int         machines = 0;
    int         outside  = 0; ///< found, with the next two
    int         named    = 0; ///< the changed value explains most
    int         tripped  = 0;
};

/// First machines within the uncertainties, ten times as many as of each change. Then one value is changed by twice its
/// uncertainty, the others are drawn. A disc cannot be better than perfect, and friction only grows.
std::vector<Detection> run_detections(const Drive &drive, const Programme &programme, int machines,
                                      const RehearsalCounts &counts = {});

std::string detections_text(const Drive &drive, const std::vector<Detection> &detections);

} // namespace sdre
