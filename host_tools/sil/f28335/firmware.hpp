// SPDX-License-Identifier: MIT
/// Firmware for a device: main(), which never returns, or its parts.
#pragma once

extern "C" {
#include "passes.h"
}

namespace sdre::f28335 {

struct Firmware {
    int (*main)()                 = nullptr;
    firmware_pass_t (*start)()    = nullptr;
    void (*pass)(firmware_pass_t) = nullptr;
};

/// That of firmware/board/program/main.c, bound to the constants of the scenario.
Firmware whole_firmware();

} // namespace sdre::f28335
