// SPDX-License-Identifier: MIT
/// Gains of the plain field-oriented control that a tick's cost is compared with.
#pragma once

#include "drive/drive_file.hpp"

extern "C" {
#include "sil/eval/pi_foc_tick.h"
}

namespace sdre {

/// Pole cancellation for the currents at a tenth of the control rate's bandwidth, symmetric speed loop.
pi_foc_gains_t pi_foc_gains(const Drive &drive);

} // namespace sdre
