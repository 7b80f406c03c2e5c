// SPDX-License-Identifier: MIT
// Generated from docs/budget.json. Do not edit: ./dev budget record.
/// Upper ends of a whole period's cycles, the dearer of a run's first and the others.
/// `position` is more on the way to a position. `torque` is more with one.
#pragma once

namespace sdre::cycle_budget {

constexpr double noc_speed        = 5151.0;
constexpr double noc              = 5440.0;
constexpr double noc_h            = 8897.0;
constexpr double noc_shaft        = 5992.0;
constexpr double conventional     = 7362.0;
constexpr double position         = 3098.0;
constexpr double torque           = 558.0;
constexpr double background_share = 0.10666666666666667;

} // namespace sdre::cycle_budget
