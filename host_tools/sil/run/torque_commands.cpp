// SPDX-License-Identifier: MIT
#include "sil/run/torque_commands.hpp"

#include <algorithm>

namespace sdre {
TorqueCommands::TorqueCommands(const Scenario &scenario, const drive_config_t &config)
    : scenario_(scenario)
{
    if (scenario.torque_reference.empty()) {
        return;
    }
    rated_Nm_                  = config.rated_torque_Nm;
    const float most           = config.speed_max_e_radps;
    const auto  asked          = static_cast<float>(scenario.torque_speed_max_e_radps);
    command_.speed_max_e_radps = asked > 0.0F ? std::min(asked, most) : most;
}

const torque_command_t *TorqueCommands::at(double time_s)
{
    const std::vector<Step> &steps = scenario_.torque_reference;
    if (steps.empty() || time_s < steps.front().time_s) {
        return nullptr;
    }
    const double     share = value_at(steps, time_s, 0.0) / static_cast<double>(rated_Nm_);
    constexpr double most  = TORQUE_SHARE_MAX;
    command_.share         = single(std::clamp(share, -most, most));
    return &command_;
}

} // namespace sdre
