// SPDX-License-Identifier: MIT
/// The commands of sdre-sil, one file each.
#pragma once

#include "common/command_line.hpp"

namespace sdre {

/// A drive tripped, a motor failed: the simulation ran, and what it shows is not good.
constexpr int exit_fault = 4;

Command run_command();
Command compare_command();
Command motors_command();
Command bench_command();
Command qualify_command();
Command commission_command();
Command serve_command();
Command verify_command();

} // namespace sdre
