// SPDX-License-Identifier: MIT
/// The commands of sdre-gains, one file each.
#pragma once

#include "common/command_line.hpp"

namespace sdre {

Command generate_command();
Command image_command();
Command report_command();
Command describe_command();
Command orders_command();
Command tune_command();
Command new_command();
Command from_commissioning_command();
Command care_command();

} // namespace sdre
