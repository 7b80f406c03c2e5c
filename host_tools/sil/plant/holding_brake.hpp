// SPDX-License-Identifier: MIT
/// Holding brake: dry friction that ends a time after its output went high, and comes a time after it went low  EQ-LOAD-3
#pragma once

#include "sil/setup/load_settings.hpp"

namespace sdre {

/// Call with rising times.
class HoldingBrake {
public:
    HoldingBrake() = default;
    explicit HoldingBrake(const HoldingBrakeSettings &settings) : settings_(settings) {}

    /// Level of the drive's output from this time on; high releases.
    void command(bool high, double time_s)
    {
        if (high != high_) {
            closed_  = is_closed(time_s);
            high_    = high;
            since_s_ = time_s;
        }
    }
    /// Largest torque with which it holds or brakes.
    double torque_Nm(double time_s) const
    {
        return is_closed(time_s) ? settings_.torque_Nm : 0.0;
    }

private:
    bool is_closed(double time_s) const
    {
        const double passed_s = time_s - since_s_;
        const bool moved = passed_s >= (high_ ? settings_.release_time_s : settings_.close_time_s);
        return moved ? !high_ : closed_;
    }

    HoldingBrakeSettings settings_;
    bool                 high_    = false;
    bool                 closed_  = true; ///< when the output last changed
    double               since_s_ = 0.0;
};

} // namespace sdre
