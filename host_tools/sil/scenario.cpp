// SPDX-License-Identifier: MIT
#include "scenario.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "errors.hpp"
#include "metrics.hpp"
#include "toml_reader.hpp"

namespace sdre {
namespace {

constexpr Range time_range_s{0.0, 1e4};
constexpr Range duration_range_s{1e-3, 1e4};
constexpr Range speed_range_e_radps{-1e5, 1e5};
constexpr Range torque_range_Nm{-1e5, 1e5};
constexpr Range band_range_e_radps{1e-9, 1e5};
constexpr Range scale_range{0.01, 100.0};
constexpr Range dc_link_range_V{1.0, 1e4};
constexpr Range order_range{0, 8};
constexpr Range paper_range{-1e9, 1e9};

MotorScale read_scale(TomlReader t)
{
    MotorScale scale;
    Motor      probe;
    for (const std::string &key : t.keys()) {
        scale[key] = t.number(key, scale_range);
        try {
            motor_value(probe, key);
        } catch (const InputError &) {
            t.fail(key, "is not a motor key that can be scaled");
        }
    }
    return scale;
}

/// Times must not go backwards, so that a file reads in the order in which things happen.
template <typename T>
void require_sorted(const TomlReader &t, const char *what, const std::vector<T> &items)
{
    for (std::size_t i = 1; i < items.size(); i++) {
        if (items[i].time_s <= items[i - 1].time_s) {
            t.fail(what, fmt::format("number {}: time_s = {:g} must be later than the one before",
                                     i + 1, items[i].time_s));
        }
    }
}

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

std::map<std::string, double> read_paper(TomlReader t)
{
    std::map<std::string, double> paper;
    for (const std::string &key : t.keys()) {
        if (!is_metric_name(key)) {
            t.fail(key, "is not the name of a metric");
        }
        paper[key] = t.number(key, paper_range);
    }
    return paper;
}

std::vector<Measure> read_measures(TomlReader &t)
{
    std::vector<Measure>  measures;
    std::set<std::string> names;
    for (TomlReader &entry : t.tables("measure")) {
        Measure m;
        m.name         = entry.text("name");
        m.time_s       = entry.number("time_s", time_range_s);
        m.band_e_radps = entry.number("band_e_radps", band_range_e_radps);
        if (std::optional<TomlReader> paper = entry.table_if("paper")) {
            m.paper = read_paper(*paper);
        }
        entry.reject_unknown_keys();
        if (!names.insert(m.name).second) {
            entry.fail("name", fmt::format("= \"{}\" is used twice", m.name));
        }
        measures.push_back(m);
    }
    require_sorted(t, "measure", measures);
    return measures;
}

std::vector<PlantChange> read_changes(TomlReader &t)
{
    std::vector<PlantChange> changes;
    for (TomlReader &entry : t.tables("change")) {
        PlantChange change;
        change.time_s      = entry.number("time_s", time_range_s);
        TomlReader set     = entry.table("set");
        change.plant_scale = read_scale(set.table("plant_scale"));
        set.reject_unknown_keys();
        entry.reject_unknown_keys();
        changes.push_back(change);
    }
    require_sorted(t, "change", changes);
    return changes;
}

std::filesystem::path drive_path(const std::filesystem::path &scenario, const std::string &drive)
{
    const std::filesystem::path beside = scenario.parent_path() / drive;
    std::error_code             error;
    return std::filesystem::exists(beside, error) ? beside : std::filesystem::path(drive);
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

} // namespace

Motor scaled(Motor motor, const MotorScale &scale)
{
    for (const auto &[key, factor] : scale) {
        motor_value(motor, key) *= factor;
    }
    return motor;
}

double value_at(const std::vector<Step> &steps, double time_s, double before)
{
    double value = before;
    for (const Step &step : steps) {
        if (step.time_s > time_s + 1e-12) {
            break;
        }
        value = step.value;
    }
    return value;
}

Scenario read_scenario_file(const std::filesystem::path &file)
{
    const toml::table root = parse_toml_file(file);
    TomlReader        t(file.string(), "", root);
    Scenario          s;
    s.name  = file.stem().string();
    s.drive = read_drive_file(drive_path(file, t.text("drive")));
    if (t.text_or("law", "noc") != "noc") {
        t.fail("law", "is not allowed: must be \"noc\"");
    }
    s.duration_s            = t.number("duration_s", duration_range_s);
    s.initial_speed_e_radps = t.number_or("initial_speed_e_radps", speed_range_e_radps, 0.0);
    if (std::optional<TomlReader> scale = t.table_if("controller_scale")) {
        s.controller_scale = read_scale(*scale);
    }
    if (std::optional<TomlReader> scale = t.table_if("plant_scale")) {
        s.plant_scale = read_scale(*scale);
    }
    if (std::optional<TomlReader> controller = t.table_if("controller")) {
        read_controller(*controller, s);
    }
    s.speed_reference = read_steps(t, "speed_reference", "value_e_radps", speed_range_e_radps);
    s.load_torque     = read_steps(t, "load_torque", "value_Nm", torque_range_Nm);
    s.changes         = read_changes(t);
    s.measures        = read_measures(t);
    if (!s.measures.empty() && s.measures.back().time_s >= s.duration_s) {
        t.fail("measure", fmt::format("\"{}\": time_s must be before duration_s = {:g}",
                                      s.measures.back().name, s.duration_s));
    }
    s.dc_link_V = s.drive.inverter.dc_link_V;
    if (std::optional<TomlReader> inverter = t.table_if("inverter")) {
        s.dc_link_V = inverter->number_or("dc_link_V", dc_link_range_V, s.dc_link_V);
        inverter->reject_unknown_keys();
    }
    if (std::optional<TomlReader> sensors = t.table_if("sensors")) {
        if (!sensors->boolean_or("ideal", true)) {
            sensors->fail("ideal",
                          "= false is not allowed: the sensors of this simulation are ideal");
        }
        sensors->reject_unknown_keys();
    }
    t.reject_unknown_keys();
    return s;
}

} // namespace sdre
