// SPDX-License-Identifier: MIT
/// The four flash sectors that the firmware keeps its store in. They outlast a device: only the power of the program ends them.
#pragma once

namespace sdre::f28335 {

/// As from the factory: every word 0xFFFF.
void erase_flash();

} // namespace sdre::f28335
