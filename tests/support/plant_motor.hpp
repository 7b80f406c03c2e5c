// SPDX-License-Identifier: MIT
#pragma once

#include "drive/drive_file.hpp"

namespace support {

/// Paper A's motor, as tests of the plant write it down.
inline sdre::Motor motor_390w()
{
    sdre::Motor m;
    m.pole_pairs            = 2;
    m.stator_resistance_Ohm = 2.48;
    m.d_axis_inductance_H   = 0.07498;
    m.q_axis_inductance_H   = 0.11391;
    m.pm_flux_Wb            = 0.193;
    m.inertia_kgm2          = 0.00042;
    m.viscous_friction_Nms  = 0.0001;
    return m;
}

} // namespace support
