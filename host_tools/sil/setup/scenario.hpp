// SPDX-License-Identifier: MIT
/// A closed-loop experiment, read from TOML.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drive/drive_file.hpp"
#include "sil/setup/board_settings.hpp"
#include "sil/setup/changes.hpp"
#include "sil/setup/glitches.hpp"
#include "sil/setup/injected_faults.hpp"
#include "sil/setup/load_settings.hpp"
#include "sil/setup/measures.hpp"
#include "sil/setup/motor_scale.hpp"
#include "sil/setup/steps.hpp"

namespace sdre {

/// Limits of the way to a position; the core takes what it can of them.
struct PositionProfile {
    double speed_e_radps  = 1e9;
    double accel_e_radps2 = 1e9;
    double decel_e_radps2 = 1e9;
    double jerk_e_radps3  = 1e12;
};

struct Scenario {
    std::string name; ///< the file's stem
    Drive       drive;
    double      duration_s            = 0.0;
    double      initial_speed_e_radps = 0.0;
    std::optional<double>
               initial_angle_e_rad; ///< of the rotor, electrical; drawn from the seed without it
    MotorScale controller_scale;    ///< the controller's model, relative to the drive file
    MotorScale plant_scale;         ///< what the motor is, relative to the drive file
    std::optional<MotorRanges> motor_ranges;
    std::optional<int>         nosc_order; ///< instead of the drive file's
    std::optional<int>         nodo_order;
    std::vector<Step>          speed_reference; ///< electrical rad/s, sorted by time
    std::vector<Step> position_reference; ///< turns of the shaft from its start, sorted by time
    PositionProfile   position_profile;
    std::vector<Step> torque_reference;     ///< N m, sorted by time
    double torque_speed_max_e_radps = 0.0;  ///< limit of the speed in a torque run; 0: the drive's
    std::vector<Step>          load_torque; ///< N m, sorted by time
    std::vector<PlantChange>   changes;     ///< sorted by time
    std::vector<Glitch>        glitches;    ///< sorted by time
    std::vector<InjectedFault> faults;      ///< sorted by time
    std::vector<Measure>       measures;    ///< sorted by time
    double                     dc_link_V = 0.0; ///< the supply; the drive file's unless given
    std::uint64_t              seed      = 1;   ///< of every random draw
    SensorSettings             sensors;
    InverterSettings           inverter;
    MotorEffects               motor_effects;
    std::vector<LoadRamp>      load_ramps; ///< sorted by time
    LoadSine                   load_sine;
    double                     load_fan_Nm_per_radps2 = 0.0; ///< of the mechanical speed
    BrakeSettings              load_brake;
};

/// InputError in one line on any error. The drive path is relative to the scenario file, or to the
/// working directory when no such file is there. `drive`, unless empty, replaces it.
Scenario read_scenario_file(const std::filesystem::path &file,
                            const std::filesystem::path &drive = {});

/// The same of a table in memory with a drive that is known; `source` names it in messages. `own` is the law of the drive
/// that the table was written for: published values are its.
Scenario read_scenario_table(const toml::table &root, const std::string &source,
                             const std::string &name, const Drive &drive, Law own);

/// Where the `drive` key of a scenario file points: beside the file when it is there, else as it stands.
std::filesystem::path scenario_drive_path(const std::filesystem::path &scenario,
                                          const std::string           &drive);

/// Rotor position at the start, electrical. It is that of the scenario, else drawn from the seed
/// over a whole turn of the shaft. With ideal sensors it is zero, because they work at any angle.
double start_theta_e_rad(const Scenario &scenario);

} // namespace sdre
