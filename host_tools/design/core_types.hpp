// SPDX-License-Identifier: MIT
/// The control core's C headers, for C++.
#pragma once

extern "C" {
#include "drive_tick.h"
}
