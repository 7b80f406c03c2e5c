// SPDX-License-Identifier: MIT
/// Each processor by the headers of its board's directory. They name the same macros, so each has a file of its own.
#pragma once

#include "drive/processor.hpp"

namespace sdre {

Processor processor_f28335();
Processor processor_stm32g431();

} // namespace sdre
