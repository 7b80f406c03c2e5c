// SPDX-License-Identifier: MIT
/// Sections of positions and torques, for a certified drive whose file has none.
#pragma once

#include <string>

#include "drive/drive_file.hpp"

namespace sdre {

/// A section, or what is in its way.
struct AddedSection {
    std::string text;    ///< with its first weights; empty: there is none
    std::string why_not; ///< empty when there is one
};

/// [position] of a certified drive whose file has this text. `file`: the name that it has in messages.
AddedSection position_section(const Drive &drive, const std::string &text, const std::string &file);

/// [torque], as above.
AddedSection torque_section(Drive drive, const std::string &text, const std::string &file);

} // namespace sdre
