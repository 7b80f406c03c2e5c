// SPDX-License-Identifier: MIT
/// The same commissioning by the drive application: started by a command, its result in the status.
#pragma once

#include "sil/board/board_run.hpp"
#include "sil/commission/bench.hpp"

namespace sdre {

/// InputError when the board cannot have the drive, or the firmware does not begin. Bounds are the drive's.
CommissionRun commission_on_board(const Drive &truth, const CommissionOptions &options,
                                  BoardKind kind);
/// On a board that has its constants already.
CommissionRun commission_on_board(const Drive &truth, const CommissionOptions &options,
                                  const PowerUp &power_up);

} // namespace sdre
