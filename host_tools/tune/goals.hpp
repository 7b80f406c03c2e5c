// SPDX-License-Identifier: MIT
/// Goals of a drive from its motor, inverter and sensors alone: the input of `sdre-gains tune`
/// without a specification.
#pragma once

#include <string>

#include "drive/drive_file.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

/// Physical bound of the load step from half to all of the rated torque, at half the rated speed.
/// First the shaft turns by the encoder's error. A new voltage then acts after one and a half
/// periods, and the current needs its rise time at full voltage.
struct PhysicalBound {
    double reaction_s;  ///< the sum of these, and of shaft_s
    double dip_e_radps; ///< acceleration of the step times that
    double shaft_s;     ///< noc_shaft: 1 / w_r, in which the spring passes a torque on; else 0
};

PhysicalBound physical_bound(const Drive &drive);

/// Goals and robustness cases. InputError when the motor cannot have its ratings: torque beyond the current limit, speed
/// beyond the dc link.
TuneSpec goals_from_physics(const Drive &drive);

/// noc_shaft: cases with the least and the largest resonance of [mechanics], and the goals of the nominal one. None more where the
/// specification has such cases, and none for other laws.
TuneSpec with_shaft_cases(TuneSpec spec, const Drive &drive);

/// InputError when a load is more than the current limit carries, in one line that names both.
void require_torque(const Drive &drive, double load_Nm, const std::string &what);

} // namespace sdre
