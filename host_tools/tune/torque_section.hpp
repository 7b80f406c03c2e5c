// SPDX-License-Identifier: MIT
/// Torques of a drive whose file has no [torque].
#pragma once

#include <string>

#include "drive/drive_file.hpp"

namespace sdre {

/// A section, or what is in its way.
struct TorqueSection {
    std::string text;    ///< [torque] without weights; empty: there is none
    std::string why_not; ///< empty when there is one
};

TorqueSection torque_section(Drive drive);

} // namespace sdre
