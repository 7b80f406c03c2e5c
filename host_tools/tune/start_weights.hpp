// SPDX-License-Identifier: MIT
/// Weights for any motor: those of the 390 W motor in the units in which all motors look alike.
///
/// The unit of time is T = pace * Ts, and the unit of voltage is the circle v_dc / sqrt(3). The
/// unit of current is the change by that voltage in T in the q axis. The unit of speed is the
/// change by that current in T. A larger pace is a slower loop, for sensors with less information.
#pragma once

#include <string>
#include <vector>

#include "drive/drive_file.hpp"

namespace sdre {

/// The units in SI.
struct MotorUnits {
    double time_s;
    double voltage_V;
    double current_A;
    double speed_e_radps;
};

MotorUnits motor_units(const Drive &drive, double pace);

/// Variances of a sample in the observer's design.
struct SampleNoise {
    double current_A; ///< standard deviation, quantisation included
    double angle_rad; ///< the same, electrical; more where edges are rarer than samples
};

SampleNoise sample_noise(const Drive &drive);

/// Periods from one edge of the encoder to the next at half the rated speed; 1 when every period has one.
double periods_per_edge(const Drive &drive);

/// The pace at which the encoder's error is as large in motor_units() as on the 390 W motor; at least 1.
double pace_of_sensors(const Drive &drive);

/// The drive with these weights, each with three digits. Laws without a LinearLoop become noc in its encoder form.
Drive start_weights(Drive drive, double pace);
Drive start_weights(const Drive &drive);

/// Whether its law knows more of the plant than law noc: an elastic shaft, or iron that saturates.
bool has_own_plant(const Drive &drive);
/// Starts of a search for such a law, which ends in different weights from each.
std::vector<Drive> own_plant_starts(const Drive &drive);

/// Its [nosc] and [nodo] sections.
std::string start_sections(const Drive &drive);

} // namespace sdre
