// SPDX-License-Identifier: MIT
/// A search asks the certificate by these.
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

/// Whether there is a design and its whole certificate passes.
bool is_certified(const Drive &drive);

/// A search adds this to the value of its weights. It is 0 where the verdict holds with a little room; elsewhere it outweighs
/// every goal. A design that fails counts as far off.
double verdict_penalty(const Drive &drive);

} // namespace sdre
