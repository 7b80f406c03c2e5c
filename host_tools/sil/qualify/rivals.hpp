// SPDX-License-Identifier: MIT
/// The laws that drives usually have, tuned for the same trial: what a drive is compared with.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sil/qualify/qualify.hpp"

namespace sdre {

/// Runs a trial with seeds 1 .. `seeds`.
using RunTrial = std::function<TrialResult(const Trial &trial, int seeds)>;

/// The rival laws on the drive's sensors. Subplex searches the bandwidths and the observer's pole, with the budget of
/// `sdre-gains tune`. It minimises the larger ratio of settling time and dip to `own`. The noise of v_q is limited to that
/// of `own`. A law that finds nothing certified as quiet that settles has no load step.
std::vector<Rival> best_rivals(const Trial &load_step, const TrialResult &own, int seeds,
                               const RunTrial &run);

} // namespace sdre
