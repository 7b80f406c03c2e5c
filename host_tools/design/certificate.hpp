// SPDX-License-Identifier: MIT
/// What has to hold before a table is written, checked on the sampled system that the firmware runs.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// Sweeps both loops over their range and collects every failure.
///
/// NOSC: the error dynamics held by a zero-order hold, the voltage one period late (EQ-CERT-1).
/// NODO: explicit Euler, I + Ts (A - L C), as the firmware steps it (EQ-CERT-2).
/// Encoder form: motor, observer, law and delay together, and in the box of motors of EQ-CERT-5.
void certify(Design &design);

/// A failure when the share is below box_share_limit.
void judge_box(const RobustBox &box, std::vector<std::string> &failures);

} // namespace sdre
