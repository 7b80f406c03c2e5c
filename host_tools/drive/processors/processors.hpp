// SPDX-License-Identifier: MIT
/// What the headers of each board's directory say of its processor. Two of them name the same macros: one file for each.
#pragma once

#include "drive/processor.hpp"

namespace sdre {

Processor processor_f28335();
Processor processor_stm32g431();

} // namespace sdre
