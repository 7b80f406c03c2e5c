// SPDX-License-Identifier: MIT
#include "sil/run/position_commands.hpp"

#include <cmath>

namespace sdre {
namespace {

const double two_pi = 2.0 * std::acos(-1.0);

double rad_of(const position_t &p)
{
    return two_pi * p.turns + static_cast<double>(p.theta_e_rad);
}

position_t position_of(double e_rad)
{
    const double turns = std::round(e_rad / two_pi);
    return {static_cast<std::int32_t>(turns), static_cast<float>(e_rad - two_pi * turns)};
}

const near_optimal_t *references_of(const drive_t &drive)
{
    if (constants_of<law_noc_config_t>(*drive.config) != nullptr) {
        return &drive.law.noc.near_optimal;
    }
    return constants_of<law_noc_h_config_t>(*drive.config) != nullptr
               ? &drive.law.noc_h.near_optimal
               : nullptr;
}

} // namespace

PositionCommands::PositionCommands(const Scenario &scenario)
    : scenario_(scenario), pole_pairs_(scenario.drive.motor.pole_pairs)
{
    const PositionProfile &p = scenario.position_profile;
    command_.profile = {static_cast<float>(p.speed_e_radps), static_cast<float>(p.accel_e_radps2),
                        static_cast<float>(p.decel_e_radps2), static_cast<float>(p.jerk_e_radps3)};
}

void PositionCommands::follow(float theta_e_rad)
{
    const float theta = frames_wrap(theta_e_rad);
    if (!started_) {
        command_.actual = {0, theta};
        zero_           = command_.actual;
        started_        = true;
    }
    command_.actual = position_followed(&command_.actual, theta);
}

const position_command_t *PositionCommands::at(double time_s, const drive_sample_t &sample)
{
    const std::vector<Step> &steps = scenario_.position_reference;
    if (steps.empty()) {
        return nullptr;
    }
    follow(sample.theta_e_rad);
    if (time_s < steps.front().time_s) {
        return nullptr;
    }
    const double turns = value_at(steps, time_s, 0.0);
    command_.target    = position_of(rad_of(zero_) + two_pi * pole_pairs_ * turns);
    return &command_;
}

double PositionCommands::zero_e_rad(double start_e_rad) const
{
    const double off = static_cast<double>(zero_.theta_e_rad) - start_e_rad;
    return started_ ? start_e_rad + off - two_pi * std::round(off / two_pi) : 0.0;
}

std::optional<double> PositionCommands::reference_e_rad(const drive_t &drive) const
{
    const near_optimal_t *s = references_of(drive);
    if (s == nullptr || s->follows != NEAR_OPTIMAL_POSITION || drive.state != DRIVE_RUN) {
        return std::nullopt;
    }
    return rad_of(s->position_ref.at) - rad_of(zero_);
}

} // namespace sdre
