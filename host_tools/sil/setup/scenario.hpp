// SPDX-License-Identifier: MIT
/// A closed-loop experiment, read from TOML.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"
#include "drive/drive_file.hpp"
#include "sil/plant/load.hpp"
#include "sil/setup/board_settings.hpp"

namespace sdre {

/// A value from a time on.
struct Step {
    double time_s = 0.0;
    double value  = 0.0;
};

/// Factors per motor key, e.g. {"inertia_kgm2", 2.0}.
using MotorScale = std::map<std::string, double>;

/// Factors that one random motor of `sdre-sil motors` is drawn with, relative to the drive file.
struct MotorRanges {
    Range resistance{1.0, 1.0};
    Range inductance{1.0, 1.0}; ///< one factor for both axes
    Range flux{1.0, 1.0};
    Range inertia{1.0, 1.0};
};

struct Measure {
    std::string name;
    double      time_s =
        0.0; ///< the event; the window ends at the next measure or at the end of the run
    double band_e_radps = 0.0; ///< settled when the speed stays this close to the final reference
    std::map<std::string, double> paper; ///< published for this drive's law, by metric name
    std::optional<double>         tail_s =
        std::nullopt; ///< the steady part; the window's last fifth unless given
};

/// Motor, board or load change at a time. A table that is there holds all values from then on, not only
/// the keys that the file names.
struct PlantChange {
    double                          time_s = 0.0;
    MotorScale                      plant_scale; ///< replaces the scale before when changes_plant
    bool                            changes_plant = true;
    std::optional<SensorSettings>   sensors;
    int                             lost_counts = 0; ///< the encoder's counter misses these, now
    std::optional<InverterSettings> inverter;
    std::optional<LoadSine>         load_sine;
};

struct Scenario {
    std::string name; ///< the file's stem
    Drive       drive;
    double      duration_s            = 0.0;
    double      initial_speed_e_radps = 0.0;
    MotorScale  controller_scale; ///< what the controller believes, relative to the drive file
    MotorScale  plant_scale;      ///< what the motor is, relative to the drive file
    std::optional<MotorRanges> motor_ranges;
    std::optional<int>         nosc_order; ///< instead of the drive file's
    std::optional<int>         nodo_order;
    std::vector<Step>          speed_reference; ///< electrical rad/s, sorted by time
    std::vector<Step>          load_torque;     ///< N m, sorted by time
    std::vector<PlantChange>   changes;         ///< sorted by time
    std::vector<Measure>       measures;        ///< sorted by time
    double                     dc_link_V = 0.0; ///< the supply; the drive file's unless given
    std::uint64_t              seed      = 1;   ///< of every random draw
    SensorSettings             sensors;
    InverterSettings           inverter;
    MotorEffects               motor_effects;
    std::vector<LoadRamp>      load_ramps; ///< sorted by time
    LoadSine                   load_sine;
    double                     load_fan_Nm_per_radps2 = 0.0; ///< of the mechanical speed
};

/// InputError in one line on anything wrong. The drive path is relative to the scenario file, or to the
/// working directory when no such file is there; `drive`, unless empty, is read instead.
Scenario read_scenario_file(const std::filesystem::path &file,
                            const std::filesystem::path &drive = {});

/// Where the `drive` key of a scenario file points: beside the file when it is there, else as it stands.
std::filesystem::path scenario_drive_path(const std::filesystem::path &scenario,
                                          const std::string           &drive);

/// The motor with every factor applied.
Motor scaled(Motor motor, const MotorScale &scale);

/// The last step at or before a time; `before` when there is none.
double value_at(const std::vector<Step> &steps, double time_s, double before);

/// value_at() for times that rise: it goes on from where it was.
class StepCursor {
public:
    StepCursor(const std::vector<Step> &steps, double before) : steps_(steps), value_(before) {}
    double at(double time_s);

private:
    const std::vector<Step> &steps_;
    std::size_t              next_ = 0;
    double                   value_;
};

} // namespace sdre
