// SPDX-License-Identifier: MIT
/// Weights from physical specifications, by search on the sampled closed loop (EQ-CERT-3).
#pragma once

#include <functional>
#include <vector>

#include "drive/drive_file.hpp"
#include "tune/objective.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

struct TuneResult {
    Drive                   drive; ///< with the weights, as they are written
    std::vector<CaseResult> cases; ///< of these very weights
    double worst_ratio = 0.0; ///< largest result / specification; at most 1 when every one is met
    int    evaluations = 0;
    bool   kept        = false;    ///< the drive's own weights: the search improved too little
    bool   moved_position = false; ///< positions have weights that go with the found ones
};

/// Called now and then with the evaluations so far and the best worst ratio.
using TuneProgress = std::function<void(int evaluations, double worst_ratio)>;

/// Searches the logarithms of six weights from fixed starts, of noc_shaft from the drive's own weights too. The same input gives the
/// same weights, with every compiler. Best weights of a start that are not certified are moved until they are, or as near as a short
/// search comes. The drive's own certified
/// weights stay when the found ones are not better by 3 %. With a coupling that
/// is not rigid, and where the found weights are not certified with them, the drive's positions follow, see with_position().
/// DesignError when no stable design was found.
TuneResult tune_drive(const Drive &drive, const TuneSpec &spec, const TuneProgress &progress);

} // namespace sdre
