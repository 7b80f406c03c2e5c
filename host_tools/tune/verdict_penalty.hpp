// SPDX-License-Identifier: MIT
/// A search adds this to the value of weights that the certificate's verdict does not hold for.
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

/// 0 where the verdict holds with a little room; elsewhere it outweighs every goal. A design that fails counts as far off.
double verdict_penalty(const Drive &drive);

} // namespace sdre
