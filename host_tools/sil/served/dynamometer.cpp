// SPDX-License-Identifier: MIT
#include "sil/served/dynamometer.hpp"

#include <algorithm>
#include <cmath>

#include "design/motor_model.hpp"

namespace sdre {
namespace {

// Chosen: the drive has tripped before, and a machine on a real bench has as much margin to its bursting speed.
constexpr double catch_share = 1.2;
// Chosen: it holds the motor against all of its current, and stops the shipped motor from its trip in 0.1 s.
constexpr double strength = 4.0;
constexpr int    angles   = 180;

/// Largest torque at the current limit, whatever the current's angle.
double motor_most_Nm(const Motor &motor)
{
    const double pi   = std::acos(-1.0);
    double       most = 0.0;
    for (int n = 0; n <= angles; n++) {
        const double angle = pi * n / angles;
        most = std::max(most, std::abs(torque_Nm(motor, motor.max_current_A * std::cos(angle),
                                                 motor.max_current_A * std::sin(angle))));
    }
    return most;
}

} // namespace

Dynamometer::Dynamometer(const Drive &drive)
    : catch_speed_e_radps_(catch_share * trip_speed_e_radps(drive)),
      most_Nm_(strength * motor_most_Nm(drive.motor))
{
}

void Dynamometer::set(double torque_Nm, bool active)
{
    torque_Nm_ = torque_Nm;
    active_    = active;
    caught_    = false;
}

void Dynamometer::bring_to_rest()
{
    set(0.0, false);
    stopping_ = true;
}

DynamometerTorque Dynamometer::at(double omega_e_radps)
{
    if (!stopping_ && std::abs(omega_e_radps) >= catch_speed_e_radps_) {
        bring_to_rest();
        caught_ = true;
        catches_++;
    }
    stopping_ = stopping_ && omega_e_radps != 0.0;
    if (stopping_) {
        return {0.0, most_Nm_};
    }
    return active_ ? DynamometerTorque{torque_Nm_, 0.0} : DynamometerTorque{0.0, torque_Nm_};
}

} // namespace sdre
