// SPDX-License-Identifier: MIT
/// The design of one of the firmware's laws: how its constants are computed and how they are
/// written.
#pragma once

#include <string>
#include <vector>

#include "design/constants_text.hpp"
#include "design/design.hpp"

namespace sdre {

struct LawDesign {
    const char *name; ///< of the firmware's object and of its header: "law_noc"
    const char *constants_type;
    bool (*is_for)(const Drive &drive); ///< whether the drive file requests it
    /// Gains, certificate and constants, into a design that has its drive, its reduced parameters and the part of its
    /// configuration that no law changes.
    void (*solve)(Design &design);
    std::string (*summary)(const Design &design); ///< lines of the comment above the tables
    /// Preprocessor conditions, of which none may hold for the control core.
    std::vector<std::string> (*mismatches)(const Design &design);
    Layout (*layout)(const Design &design); ///< how its arrays read in the table
};

/// That of the drive. Every drive that read_drive_file() accepts has one.
const LawDesign &law_design(const Drive &drive);

/// Keeps the constants and points the configuration at them.
template <typename Constants> void keep_constants(Design &design, const Constants &constants)
{
    const auto kept  = std::make_shared<const Constants>(constants);
    design.constants = kept;
    set_law(design.config, *kept);
}

} // namespace sdre
