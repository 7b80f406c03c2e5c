// SPDX-License-Identifier: MIT
/// The machine on the other side of a served drive's shaft. It brakes or drives the shaft, catches it before it bursts, and
/// brings it to rest.
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

/// Torques on the shaft in one control period.
struct DynamometerTorque {
    double active_Nm = 0.0; ///< against positive speed
    double brake_Nm  = 0.0; ///< against the motion, at least 0; at rest it holds
};

class Dynamometer {
public:
    explicit Dynamometer(const Drive &drive);

    /// A brake of that torque from now on, at most most_Nm().
    void brake(double torque_Nm)
    {
        set(torque_Nm, false);
    }
    /// This torque whatever the shaft does, at most most_Nm() of either sign.
    void drive(double torque_Nm)
    {
        set(torque_Nm, true);
    }
    /// Brakes with all that it has until the shaft rests; the load is 0 then.
    void bring_to_rest();
    /// For the next period. A shaft at catch_speed_e_radps() is brought to rest.
    DynamometerTorque at(double omega_e_radps);

    double torque_Nm() const
    {
        return torque_Nm_;
    }
    bool active() const
    {
        return active_;
    }
    /// Largest torque: four times the motor's at its current limit.
    double most_Nm() const
    {
        return most_Nm_;
    }
    /// 1.2 times the speed at which the drive opens its bridge.
    double catch_speed_e_radps() const
    {
        return catch_speed_e_radps_;
    }
    /// How often it has caught the shaft.
    int catches() const
    {
        return catches_;
    }
    /// It has, and nobody has set a load since.
    bool caught() const
    {
        return caught_;
    }

private:
    void set(double torque_Nm, bool active);

    double catch_speed_e_radps_;
    double most_Nm_;
    double torque_Nm_ = 0.0;
    bool   active_    = false;
    bool   stopping_  = false;
    bool   caught_    = false;
    int    catches_   = 0;
};

} // namespace sdre
