// SPDX-License-Identifier: MIT
#include "design/law_design.hpp"

#include <stdexcept>

#include "design/laws/laws.hpp"

namespace sdre {

const LawDesign &law_design(const Drive &drive)
{
    static const LawDesign *const all[] = {&noc_design,          &noc_speed_design, &noc_h_design,
                                           &conventional_design, &dobc_design,      &pid_design,
                                           &pi_foc_design,       &ladrc_design};
    for (const LawDesign *law : all) {
        if (law->is_for(drive)) {
            return *law;
        }
    }
    throw std::logic_error("a law without a design");
}

} // namespace sdre
