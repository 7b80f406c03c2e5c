// SPDX-License-Identifier: MIT
/// board_config.c: what application and board layer have to know of a drive.
#pragma once

#include <string>

#include "drive/drive_file.hpp"

namespace sdre {

/// The text of the file. InputError when the board cannot have the drive.
std::string board_config_text(const Drive &drive);

} // namespace sdre
