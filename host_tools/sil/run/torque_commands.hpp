// SPDX-License-Identifier: MIT
/// The torques that a scenario commands, as the core gets them.
#pragma once

#include "drive/core_types.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

class TorqueCommands {
public:
    /// @param config of the core that runs.
    TorqueCommands(const Scenario &scenario, const drive_config_t &config);

    /// The command at a tick; null before the first torque.
    const torque_command_t *at(double time_s);

private:
    const Scenario  &scenario_;
    float            rated_Nm_ = 1.0F;
    torque_command_t command_{};
};

} // namespace sdre
