// SPDX-License-Identifier: MIT
#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Whether a change of this key changes the constants that the core runs on.
bool is_of_controller(const KeyPath &path)
{
    return path.front() == "controller" || path.front() == "controller_scale" ||
           path.front() == "max_current_A" ||
           (path.front() == "inverter" && path.back() == "updates_per_period");
}

bool is_of_motor(const KeyPath &path)
{
    return path.front() == "plant_scale";
}

void set_value(CaseBase &base, const CaseVariable &variable, double value)
{
    for (const KeyPath &path : variable.keys) {
        toml::table &table = table_of(base.root, path, base.source);
        if (variable.whole) {
            table.insert_or_assign(path.back(), std::llround(value));
        } else {
            table.insert_or_assign(path.back(), value);
        }
    }
}

double current_margin(const Scenario &s, const SimulationResult &result)
{
    double peak_A = 0.0;
    for (const TraceRow &row : result.trace) {
        peak_A = std::max(peak_A, row.peak_current_A);
    }
    return 1.0 - peak_A / (allowed_current_ratio * s.drive.motor.max_current_A);
}

double speed_margin(const Scenario &s, const SimulationResult &result)
{
    double margin = 1.0;
    for (const Window &w : windows_of(s, result.trace)) {
        const double target = (w.end - 1)->omega_ref_e_radps;
        for (auto row = w.tail; row != w.end; ++row) {
            margin = std::min(margin,
                              1.0 - std::abs(row->omega_e_radps - target) / w.measure.band_e_radps);
        }
    }
    return margin;
}

std::vector<double> values_of(const std::vector<Metrics> &found, const Scenario &s,
                              const std::vector<std::string> &names)
{
    std::vector<double> values(s.measures.size() * names.size(), no_value);
    for (const Metrics &m : found) {
        const auto of_name = [&](const Measure &x) { return x.name == m.name; };
        const auto measure = std::find_if(s.measures.begin(), s.measures.end(), of_name);
        const auto first   = static_cast<std::size_t>(measure - s.measures.begin()) * names.size();
        for (const auto &[name, value] : metric_values(m)) {
            const auto at = std::find(names.begin(), names.end(), name);
            if (at != names.end()) {
                values[first + static_cast<std::size_t>(at - names.begin())] = value;
            }
        }
    }
    return values;
}

} // namespace

CaseRunner::CaseRunner(CaseBase base, std::vector<CaseVariable> variables,
                       std::vector<std::string> metrics)
    : base_(std::move(base)), variables_(std::move(variables)), metrics_(std::move(metrics))
{
    base_.root.erase("motor_ranges"); // what varies is what the variables say
    first_ = read_scenario_table(base_.root, base_.source, base_.name, base_.drive, base_.own);
    other_controllers_ = false;
    other_motors_only_ = !variables_.empty();
    for (const CaseVariable &variable : variables_) {
        for (const KeyPath &path : variable.keys) {
            table_of(base_.root, path, base_.source);
            other_controllers_ = other_controllers_ || is_of_controller(path);
            other_motors_only_ = other_motors_only_ && is_of_motor(path);
        }
    }
    for (const std::string &name : metrics_) {
        if (!is_metric_name(name)) {
            throw InputError(fmt::format("metrics: \"{}\" is not the name of a metric", name));
        }
    }
    if (!other_controllers_) {
        controller_ = prepare_controller(first_);
    }
}

std::vector<std::string> CaseRunner::measures() const
{
    std::vector<std::string> names;
    for (const Measure &m : first_.measures) {
        names.push_back(m.name);
    }
    return names;
}

Scenario CaseRunner::scenario_of(const double *values, std::uint64_t seed)
{
    for (std::size_t i = 0; i < variables_.size(); i++) {
        set_value(base_, variables_[i], values[i]);
    }
    Scenario s = read_scenario_table(base_.root, base_.source, base_.name, base_.drive, base_.own);
    s.seed     = seed;
    return s;
}

CaseResult CaseRunner::run(const double *values, std::uint64_t seed)
{
    const Scenario             s      = scenario_of(values, seed);
    const SimulationResult     result = other_controllers_ ? simulate(s) : simulate(s, controller_);
    const std::vector<Metrics> metrics = measure(s, result.trace);
    if (other_motors_only_ && !limits_) {
        limits_ = noise_limits(first_, controller_);
    }
    CaseResult out;
    out.fault  = result.fault;
    out.failed = !judge(s, result, metrics, limits_.value_or(std::vector<NoiseLimit>{})).empty();
    out.current_margin = result.fault == 0 ? current_margin(s, result) : -1.0;
    out.speed_margin   = result.fault == 0 ? speed_margin(s, result) : -1.0;
    out.metrics        = values_of(metrics, s, metrics_);
    return out;
}

} // namespace sdre
