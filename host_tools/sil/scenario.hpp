// SPDX-License-Identifier: MIT
/// A closed-loop experiment, read from TOML.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drive_file.hpp"

namespace sdre {

/// A value from a time on.
struct Step {
    double time_s = 0.0;
    double value  = 0.0;
};

/// Factors per motor key, e.g. {"inertia_kgm2", 2.0}.
using MotorScale = std::map<std::string, double>;

struct Measure {
    std::string name;
    double      time_s =
        0.0; ///< the event; the window ends at the next measure or at the end of the run
    double band_e_radps = 0.0; ///< settled when the speed stays this close to the final reference
    std::map<std::string, double> paper; ///< published values by metric name, printed beside ours
};

/// The motor changes at a time.
struct PlantChange {
    double     time_s = 0.0;
    MotorScale plant_scale;
};

struct Scenario {
    std::string name; ///< the file's stem
    Drive       drive;
    double      duration_s            = 0.0;
    double      initial_speed_e_radps = 0.0;
    MotorScale  controller_scale; ///< what the controller believes, relative to the drive file
    MotorScale  plant_scale;      ///< what the motor is, relative to the drive file
    std::optional<int>       nosc_order; ///< instead of the drive file's
    std::optional<int>       nodo_order;
    std::vector<Step>        speed_reference; ///< electrical rad/s, sorted by time
    std::vector<Step>        load_torque;     ///< N m, sorted by time
    std::vector<PlantChange> changes;         ///< sorted by time
    std::vector<Measure>     measures;        ///< sorted by time
    double                   dc_link_V = 0.0; ///< the supply; the drive file's unless given
};

/// InputError in one line on anything wrong. The drive path is relative to the scenario file, or to the
/// working directory when no such file is there.
Scenario read_scenario_file(const std::filesystem::path &file);

/// The motor with every factor applied.
Motor scaled(Motor motor, const MotorScale &scale);

/// The last step at or before a time; `before` when there is none.
double value_at(const std::vector<Step> &steps, double time_s, double before);

} // namespace sdre
