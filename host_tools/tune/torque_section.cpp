// SPDX-License-Identifier: MIT
#include "tune/torque_section.hpp"

#include "tune/verdict_penalty.hpp"

namespace sdre {

TorqueSection torque_section(Drive drive)
{
    if (!is_certified(drive)) {
        return {"",
                "even the start weights of the speed are not certified; `sdre-gains tune` finds "
                "better ones, and torques with them"};
    }
    drive.torque.emplace();
    if (!is_certified(drive)) {
        return {"", "with them it is not certified"};
    }
    return {"\n# Torques; the weights follow the control period.\n[torque]\n", ""};
}

} // namespace sdre
