// SPDX-License-Identifier: MIT
/// Motors that differ from the drive file's by factors.
#pragma once

#include <map>
#include <string>

#include "common/toml_reader.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

/// Factors per motor key, e.g. {"inertia_kgm2", 2.0}.
using MotorScale = std::map<std::string, double>;

/// Factors that one random motor of `sdre-sil motors` is drawn with, relative to the drive file.
struct MotorRanges {
    Range resistance{1.0, 1.0};
    Range inductance{1.0, 1.0}; ///< of each axis, drawn independently
    Range flux{1.0, 1.0};
    Range inertia{1.0, 1.0};
};

/// The motor with every factor applied.
Motor scaled(Motor motor, const MotorScale &scale);

MotorScale  read_scale(TomlReader t);
MotorRanges read_motor_ranges(TomlReader t);

} // namespace sdre
