// SPDX-License-Identifier: MIT
/// Paper B's loops as they run: sampled, one period late, with the constants of the firmware.
///
/// Speed loop, opened at the motor's q voltage. DOBC: paper B's (5), which takes EQ-DOBC-1 as
/// exact. PID: the whole q axis with its back-EMF.
///
///     s(k+1) = A s(k) + B r(k),  u_q(k) = c s(k),  S(z) = 1 + c (zI - A)^-1 B             EQ-CERT-4
///
/// r is added to the voltage on its way to the motor; the observer does not see it.
#pragma once

#include "design/loop_check.hpp"
#include "drive/core_types.hpp"

namespace sdre {

BrokenLoop speed_loop(const Motor &motor, const drive_config_t &config);
BrokenLoop d_axis_loop(const Motor &motor, const drive_config_t &config);

} // namespace sdre
