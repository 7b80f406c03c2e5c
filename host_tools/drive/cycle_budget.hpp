// SPDX-License-Identifier: MIT
// Generated from docs/budget.json. Do not edit: ./dev budget record.
/// Upper ends of a whole period's cycles, the dearer of a run's first and the others.
/// position: more on the way to a position.
#pragma once

namespace sdre::cycle_budget {

constexpr double noc_speed        = 5134.0;
constexpr double noc              = 5442.0;
constexpr double noc_h            = 8876.0;
constexpr double noc_shaft        = 5975.0;
constexpr double conventional     = 7255.0;
constexpr double position         = 2995.0;
constexpr double background_share = 0.10666666666666667;

} // namespace sdre::cycle_budget
