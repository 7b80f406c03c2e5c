// SPDX-License-Identifier: MIT
/// The list of laws: a line each, a file each.
#pragma once

#include "design/law_design.hpp"

namespace sdre {

extern const LawDesign noc_design;
extern const LawDesign noc_speed_design;
extern const LawDesign noc_h_design;
extern const LawDesign noc_shaft_design;
extern const LawDesign noc_iron_design;
extern const LawDesign conventional_design;
extern const LawDesign dobc_design;
extern const LawDesign pid_design;
extern const LawDesign pi_foc_design;
extern const LawDesign ladrc_design;

} // namespace sdre
