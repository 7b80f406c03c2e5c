// SPDX-License-Identifier: MIT
/// Conditions for writing a table, checked on the sampled system that the firmware runs.
#pragma once

#include "design/design.hpp"

namespace sdre {

/// Sweeps both loops over their range and collects every failure.
///
/// NOSC: the error dynamics held by a zero-order hold, the voltage one period late (EQ-CERT-1).
/// NODO: explicit Euler, I + Ts (A - L C), as the firmware steps it (EQ-CERT-2).
/// Encoder form: motor, observer, law and delay together (EQ-CERT-3).
void certify(Design &design);

/// Examines the whole loop, keeps the verdict and adds what does not hold to the failures.
void certify_loop(Design &design, const LoopFamily &family,
                  const std::vector<TripMargin> &trips = {});

/// "certified", "not certified", or "not certified, faithful to ..." what the drive file reproduces.
std::string verdict_words(const Design &design);

/// Lines of the comment above the tables.
std::string verdict_lines(const Verdict &verdict);

} // namespace sdre
