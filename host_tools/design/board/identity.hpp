// SPDX-License-Identifier: MIT
/// The identity of a drive's board for the firmware (board_identity.h).
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

/// That of the board file. A drive without one, for simulations, gets a board with its own values and limits.
board_identity_t board_identity_of(const Drive &drive);

/// InputError in one line when the drive names no board: tables and images are made for one.
void require_board(const Drive &drive, const std::string &source);

} // namespace sdre
