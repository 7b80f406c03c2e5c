// SPDX-License-Identifier: MIT
/// The four flash sectors of the firmware's store. They outlive a device, until the program ends.
#pragma once

namespace sdre::f28335 {

/// As from the factory: every word 0xFFFF.
void erase_flash();

} // namespace sdre::f28335
