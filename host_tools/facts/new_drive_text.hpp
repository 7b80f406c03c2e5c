// SPDX-License-Identifier: MIT
/// A machine as the text of a drive file, every number with its origin.
#pragma once

#include <string>

#include "facts/machine.hpp"

namespace sdre {

/// Ready for read_drive_file(); weights are the start of `sdre-gains tune`.
std::string new_drive_text(const Machine &machine);

} // namespace sdre
