// SPDX-License-Identifier: MIT
/// Dry friction of one mass in steps of a fixed length. Sliding friction opposes the speed. At rest
/// the friction holds the mass or opposes the rest of the torque. A step that takes the speed
/// through zero ends at zero.
#pragma once

#include <cmath>

namespace sdre {

class DryFriction {
public:
    /// Before a step: with the rest of the torque and the friction at this speed.
    void choose(double omega_m_radps, double torque_Nm, double friction_Nm)
    {
        dry_ = friction_Nm != 0.0;
        if (omega_m_radps != 0.0) {
            slide_ = std::copysign(1.0, omega_m_radps);
        } else if (std::abs(torque_Nm) <= friction_Nm) {
            slide_ = 0.0;
        } else {
            slide_ = std::copysign(1.0, torque_Nm);
        }
    }
    /// The torque minus the friction, within the step.
    double left_Nm(double torque_Nm, double friction_Nm) const
    {
        if (!dry_) {
            return torque_Nm;
        }
        return slide_ != 0.0 ? torque_Nm - slide_ * friction_Nm : 0.0;
    }
    /// The speed after the step.
    double ended(double omega_m_radps) const
    {
        return dry_ && slide_ * omega_m_radps < 0.0 ? 0.0 : omega_m_radps;
    }

private:
    bool   dry_   = false;
    double slide_ = 0.0; ///< direction in this step: -1, 0 (held), 1
};

} // namespace sdre
