// SPDX-License-Identifier: MIT
/// The positions that a scenario commands, as the core gets them, and where its reference is.
#pragma once

#include <optional>

#include "drive/core_types.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// The [[position_reference]] of a scenario. Positions count from the first sample's.
class PositionCommands {
public:
    explicit PositionCommands(const Scenario &scenario);

    /// The command at a tick with this sample; null before the first position. Call it once per
    /// tick with rising times.
    const position_command_t *at(double time_s, const drive_sample_t &sample);

    /// The first sample's angle on the count of a shaft that began there; 0 without positions.
    double zero_e_rad(double start_e_rad) const;
    /// Where the core's reference is from there, electrical [rad]; none in a speed run, and of laws that take no positions.
    std::optional<double> reference_e_rad(const drive_t &drive) const;

private:
    void follow(float theta_e_rad);

    const Scenario    &scenario_;
    double             pole_pairs_;
    bool               started_ = false;
    position_t         zero_{};
    position_command_t command_{};
};

} // namespace sdre
