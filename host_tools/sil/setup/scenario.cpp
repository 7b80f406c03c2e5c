// SPDX-License-Identifier: MIT
#include "sil/setup/scenario.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/random.hpp"
#include "common/toml_reader.hpp"
#include "sil/setup/board_reader.hpp"
#include "sil/setup/sorted_times.hpp"

namespace sdre {
namespace {

constexpr Range time_range_s{0.0, 1e4};
constexpr Range duration_range_s{1e-3, 1e4};
constexpr Range speed_range_e_radps{-1e5, 1e5};
constexpr Range angle_range_e_rad{-1e3, 1e3};
constexpr Range torque_range_Nm{-1e5, 1e5};
constexpr Range current_range_A{1e-3, 1e4};
constexpr Range turns_range{-1e6, 1e6};
constexpr Range profile_range{1e-3, 1e12};
constexpr Range updates_range{1, 2};
constexpr Range fan_range_Nm_per_radps2{0.0, 1e3};
constexpr Range brake_range_Nm{0.0, 1e5};
constexpr Range brake_range_s{0.0, 100.0};
constexpr Range seed_range{0, 2147483647};
constexpr Range order_range{0, 8};

std::vector<Step> read_steps(TomlReader &t, const char *key, const char *value_key, Range range)
{
    std::vector<Step> steps;
    for (TomlReader &entry : t.tables(key)) {
        steps.push_back({entry.number("time_s", time_range_s), entry.number(value_key, range)});
        entry.reject_unknown_keys();
    }
    require_sorted(t, key, steps);
    return steps;
}

/// A step in the middle of a ramp would leave open what the ramp does after it.
void require_no_step_in_ramp(const TomlReader &t, const Scenario &s)
{
    for (const LoadRamp &ramp : s.load_ramps) {
        for (const Step &step : s.load_torque) {
            if (step.time_s > ramp.time_s && step.time_s < ramp.until_s) {
                t.fail(
                    "load_torque",
                    fmt::format("time_s = {:g} is not allowed: inside the load_ramp {:g} .. {:g}",
                                step.time_s, ramp.time_s, ramp.until_s));
            }
        }
    }
}

void read_positions(TomlReader &t, Scenario &s)
{
    s.position_reference = read_steps(t, "position_reference", "turns", turns_range);
    if (!s.position_reference.empty() && !s.drive.position) {
        t.fail("position_reference",
               "is not allowed: the drive takes no positions, its file has no [position]");
    }
    if (std::optional<TomlReader> profile = t.table_if("position_profile")) {
        PositionProfile &p = s.position_profile;
        p.speed_e_radps    = profile->number_or("speed_e_radps", profile_range, p.speed_e_radps);
        p.accel_e_radps2   = profile->number_or("accel_e_radps2", profile_range, p.accel_e_radps2);
        p.decel_e_radps2   = profile->number_or("decel_e_radps2", profile_range, p.decel_e_radps2);
        p.jerk_e_radps3    = profile->number_or("jerk_e_radps3", profile_range, p.jerk_e_radps3);
        profile->reject_unknown_keys();
    }
}

void read_torques(TomlReader &t, Scenario &s)
{
    s.torque_reference = read_steps(t, "torque_reference", "value_Nm", torque_range_Nm);
    if (!s.torque_reference.empty() && !s.drive.torque) {
        t.fail("torque_reference",
               "is not allowed: the drive takes no torques, its file has no [torque]");
    }
    if (!s.torque_reference.empty() && !s.position_reference.empty()) {
        t.fail("torque_reference", "is not allowed: the scenario has positions");
    }
    s.torque_speed_max_e_radps =
        t.number_or("torque_speed_max_e_radps", {0.0, speed_range_e_radps.hi}, 0.0);
}

void read_load(TomlReader &t, Scenario &s)
{
    s.load_torque = read_steps(t, "load_torque", "value_Nm", torque_range_Nm);
    s.load_ramps  = read_load_ramps(t);
    require_no_step_in_ramp(t, s);
    if (std::optional<TomlReader> sine = t.table_if("load_sine")) {
        s.load_sine = read_load_sine(*sine, s.load_sine);
    }
    if (std::optional<TomlReader> fan = t.table_if("load_fan")) {
        s.load_fan_Nm_per_radps2 = fan->number("Nm_per_radps2", fan_range_Nm_per_radps2);
        fan->reject_unknown_keys();
    }
    s.load_brake.command = read_steps(t, "brake_torque", "value_Nm", brake_range_Nm);
    if (std::optional<TomlReader> brake = t.table_if("load_brake")) {
        s.load_brake.time_constant_s = brake->number_or("time_constant_s", brake_range_s, 0.0);
        s.load_brake.drag_Nm         = brake->number_or("drag_Nm", brake_range_Nm, 0.0);
        brake->reject_unknown_keys();
    }
}

void read_board(TomlReader &t, Scenario &s)
{
    s.dc_link_V = s.drive.inverter.dc_link_V;
    s.sensors   = sensors_of_drive(s.drive);
    if (std::optional<TomlReader> inverter = t.table_if("inverter")) {
        inverter->integer_or("updates_per_period", updates_range, 1); // read with the drive
        s.inverter  = read_board_inverter(*inverter, s.inverter, s.drive);
        s.dc_link_V = s.inverter.dc_link_V.value_or(s.dc_link_V);
    }
    if (std::optional<TomlReader> sensors = t.table_if("sensors")) {
        s.sensors.ideal = false; // a table without `ideal` is the shipped board
        s.sensors       = read_sensors(*sensors, s.sensors, s.drive);
    }
    const auto inertia = s.plant_scale.find("inertia_kgm2");
    s.motor_effects =
        effects_of_drive(s.drive, inertia == s.plant_scale.end() ? 1.0 : inertia->second);
    if (std::optional<TomlReader> effects = t.table_if("motor_effects")) {
        s.motor_effects = read_motor_effects(*effects, s.motor_effects);
    }
}

/// The drive, with what the scenario overrides for controller and plant alike.
Drive overridden(Drive drive, TomlReader &t)
{
    drive.motor.max_current_A =
        t.number_or("max_current_A", current_range_A, drive.motor.max_current_A);
    if (std::optional<TomlReader> inverter = t.table_if("inverter")) {
        drive.inverter.updates_per_period = inverter->integer_or(
            "updates_per_period", updates_range, drive.inverter.updates_per_period);
    }
    return drive;
}

void read_controller(TomlReader t, Scenario &s)
{
    if (t.has("nosc_order")) {
        s.nosc_order = t.integer("nosc_order", order_range);
    }
    if (t.has("nodo_order")) {
        s.nodo_order = t.integer("nodo_order", order_range);
    }
    t.reject_unknown_keys();
}

/// `own` is the law of the drive that the scenario names, where another drive may stand in for it.
Scenario read_scenario(TomlReader &t, const std::string &name, const Drive &drive, Law own)
{
    Scenario s;
    s.name                = name;
    s.drive               = overridden(drive, t);
    const std::string law = law_name(s.drive.law);
    if (t.text_or("law", law) != law) {
        t.fail("law",
               fmt::format("is not allowed: must be \"{}\", the law of the drive file", law));
    }
    s.seed                  = static_cast<std::uint64_t>(t.integer_or("seed", seed_range, 1));
    s.duration_s            = t.number("duration_s", duration_range_s);
    s.initial_speed_e_radps = t.number_or("initial_speed_e_radps", speed_range_e_radps, 0.0);
    if (t.has("initial_angle_e_rad")) {
        s.initial_angle_e_rad = t.number("initial_angle_e_rad", angle_range_e_rad);
    }
    if (std::optional<TomlReader> scale = t.table_if("controller_scale")) {
        s.controller_scale = read_scale(*scale);
    }
    if (std::optional<TomlReader> scale = t.table_if("plant_scale")) {
        s.plant_scale = read_scale(*scale);
    }
    if (std::optional<TomlReader> ranges = t.table_if("motor_ranges")) {
        s.motor_ranges = read_motor_ranges(*ranges);
    }
    if (std::optional<TomlReader> controller = t.table_if("controller")) {
        read_controller(*controller, s);
    }
    s.speed_reference = read_steps(t, "speed_reference", "value_e_radps", speed_range_e_radps);
    read_positions(t, s);
    read_torques(t, s);
    read_load(t, s);
    read_board(t, s);
    PlantChange start;
    start.sensors   = s.sensors;
    start.inverter  = s.inverter;
    start.load_sine = s.load_sine;
    s.changes       = read_changes(t, start, s.drive);
    require_magnet(t, s.motor_effects, s.drive);
    require_slow_shaft(t, s.motor_effects, s.drive, s.plant_scale);
    for (const PlantChange &change : s.changes) {
        require_slow_shaft(t, s.motor_effects, s.drive, change.plant_scale);
    }
    s.glitches = read_glitches(t);
    s.faults   = read_injected_faults(t);
    for (const InjectedFault &f : s.faults) {
        if (is_of_a_sensor(f.kind) && f.phase == 2 && drive.current_sensors.count == 2) {
            t.fail("fault",
                   "has phase c: this drive has no current sensor there ([current_sensors] count)");
        }
    }
    s.measures = read_measures(t, s.drive.law, own);
    if (!s.measures.empty() && s.measures.back().time_s >= s.duration_s) {
        t.fail("measure", fmt::format("\"{}\": time_s must be before duration_s = {:g}",
                                      s.measures.back().name, s.duration_s));
    }
    t.reject_unknown_keys();
    return s;
}

} // namespace

std::filesystem::path scenario_drive_path(const std::filesystem::path &scenario,
                                          const std::string           &drive)
{
    const std::filesystem::path beside = scenario.parent_path() / drive;
    std::error_code             error;
    return std::filesystem::exists(beside, error) ? beside : std::filesystem::path(drive);
}

Scenario read_scenario_file(const std::filesystem::path &file, const std::filesystem::path &drive)
{
    const toml::table root = parse_toml_file(file);
    TomlReader        t(file.string(), "", root);
    const Drive       own = read_drive_file(scenario_drive_path(file, t.text("drive")));
    return read_scenario(t, file.stem().string(), drive.empty() ? own : read_drive_file(drive),
                         own.law);
}

Scenario read_scenario_table(const toml::table &root, const std::string &source,
                             const std::string &name, const Drive &drive, Law own)
{
    TomlReader t(source, "", root);
    t.text_or("drive", "");
    return read_scenario(t, name, drive, own);
}

double start_theta_e_rad(const Scenario &s)
{
    if (s.initial_angle_e_rad || s.sensors.ideal) {
        return s.initial_angle_e_rad.value_or(0.0);
    }
    const double half_turn = std::acos(-1.0) * s.drive.motor.pole_pairs;
    return half_turn * EvenNumbers(s.seed, NoiseStream::start_angle).at(0);
}

} // namespace sdre
