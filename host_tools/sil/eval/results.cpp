// SPDX-License-Identifier: MIT
#include "sil/eval/results.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/json.hpp"
#include "sil/run/trace_columns.hpp"

namespace sdre {
namespace {

constexpr MetricLabel labels[] = {
    {"settling_time_s", "settling time [ms]", 1e3, "{:.1f}"},
    {"dip_e_radps", "dip [rad/s el.]", 1.0, "{:.2f}"},
    {"overshoot_e_radps", "overshoot [rad/s el.]", 1.0, "{:.2f}"},
    {"steady_state_error_e_radps", "steady error [rad/s el.]", 1.0, "{:.3f}"},
    {"ripple_e_radps", "ripple [rad/s el.]", 1.0, "{:.3f}"},
    {"peak_current_A", "peak current [A]", 1.0, "{:.2f}"},
    {"steady_current_A", "steady current [A]", 1.0, "{:.3f}"},
    {"vq_noise_V", "v_q noise [V rms]", 1.0, "{:.1f}"},
    {"vd_noise_V", "v_d noise [V rms]", 1.0, "{:.1f}"},
    {"vq_noise_percent", "v_q noise [% of circle]", 1.0, "{:.1f}"},
    {"iq_noise_A", "i_q noise [A rms]", 1.0, "{:.3f}"},
    {"torque_noise_percent", "torque noise [% rms]", 1.0, "{:.2f}"},
    {"audible_torque_percent", "above 100 Hz [% rms]", 1.0, "{:.2f}"},
    {"audible_current_A", "above 100 Hz [A rms]", 1.0, "{:.3f}"},
    {"equivalent_delay_s", "equivalent delay [ms]", 1e3, "{:.2f}"},
    {"d_omega_hat", "d_omega [rad/s^2]", 1.0, "{:.0f}"},
    {"d_q_hat", "d_q [A/s]", 1.0, "{:.1f}"},
    {"d_d_hat", "d_d [A/s]", 1.0, "{:.1f}"},
    {"iq_A", "i_q [A]", 1.0, "{:.3f}"},
    {"id_A", "i_d [A]", 1.0, "{:.3f}"},
    {"sensor_offset_hat_A", "sensor offset found [A]", 1.0, "{:.3f}"},
    {"position_off_cnt", "position off [counts]", 1.0, "{:.1f}"},
    {"position_steady_cnt", "steadily off [counts]", 1.0, "{:.2f}"},
    {"position_settled_s", "within two counts [ms]", 1e3, "{:.1f}"},
    {"position_overshoot_cnt", "passes target [counts]", 1.0, "{:.1f}"},
    {"torque_rise_s", "90 % of a torque step [ms]", 1e3, "{:.2f}"},
    {"torque_overshoot_percent", "torque overshoot [% of step]", 1.0, "{:.1f}"},
    {"torque_error_percent", "torque error [% of rated]", 1.0, "{:.2f}"},
    {"torque_ripple_percent", "torque ripple [% rms]", 1.0, "{:.2f}"},
    {"current_distortion_percent", "current distortion [%]", 1.0, "{:.2f}"},
    {"fluctuation_rpm", "fluctuation [r/min]", 1.0, "{:.2f}"},
    {"fluctuation_rate_percent", "fluctuation rate [%]", 1.0, "{:.2f}"},
    {"offset_rpm", "offset [r/min]", 1.0, "{:.2f}"},
    {"decrease_rpm", "decrease [r/min]", 1.0, "{:.1f}"},
    {"overshoot_percent", "overshoot [%]", 1.0, "{:.2f}"},
    {"within_5_percent_s", "within 5 % [ms]", 1e3, "{:.1f}"},
    {"within_2_percent_s", "within 2 % [ms]", 1e3, "{:.1f}"},
    {"within_1_percent_s", "within 1 % [ms]", 1e3, "{:.1f}"}};

std::optional<double> value_of(const std::vector<std::pair<std::string, double>> &values,
                               const MetricLabel                                 &label)
{
    for (const auto &[name, value] : values) {
        if (name == label.metric) {
            return value;
        }
    }
    return std::nullopt;
}

/// The published values of a measure; found by name, as a measure without rows has no metrics.
const std::map<std::string, double> &paper_of(const Scenario &scenario, const Metrics &metrics)
{
    static const std::map<std::string, double> none;
    for (const Measure &measure : scenario.measures) {
        if (measure.name == metrics.name) {
            return measure.paper;
        }
    }
    return none;
}

/// Metrics of a position or a torque are shown for a run to one only. All measures of a torque run have no speed to reach.
bool is_shown(const std::string &metric, const Scenario &scenario)
{
    static const char *const of_speed[] = {"settling",    "dip",        "overshoot", "steady_state",
                                           "ripple",      "equivalent", "offset",    "within",
                                           "fluctuation", "decrease"};
    const auto               is_of   = [&](const char *what) { return metric.rfind(what, 0) == 0; };
    const bool               torques = !scenario.torque_reference.empty();
    if (is_of("torque_") && metric != "torque_noise_percent") {
        return torques;
    }
    if (torques && std::any_of(std::begin(of_speed), std::end(of_speed), is_of)) {
        return false;
    }
    return !is_of("position") || !scenario.position_reference.empty();
}

constexpr std::ptrdiff_t rows_of_a_piece = 4096; // chosen: some hundred kilobytes

std::vector<TraceColumn> csv_columns()
{
    std::vector<TraceColumn> columns;
    std::copy_if(trace_columns().begin(), trace_columns().end(), std::back_inserter(columns),
                 [](const TraceColumn &column) { return column.digits > 0; });
    return columns;
}

std::string trace_head(const std::vector<TraceColumn> &columns)
{
    std::string s;
    for (const TraceColumn &column : columns) {
        s += s.empty() ? "" : ",";
        s += column.name;
    }
    return s + "\n";
}

void append_rows(std::string &s, const std::vector<TraceColumn> &columns,
                 Trace::const_iterator begin, Trace::const_iterator end)
{
    for (auto r = begin; r != end; ++r) {
        for (const TraceColumn &column : columns) {
            fmt::format_to(std::back_inserter(s), "{:.{}g},", column.of(*r), column.digits);
        }
        s.back() = '\n';
    }
}

} // namespace

const char *const no_measures = "no measures: the scenario has no [[measure]] with a row\n";

std::string metric_text(const MetricLabel &label, const std::optional<double> &value)
{
    if (value) {
        return fmt::format(fmt::runtime(label.format), label.factor * *value);
    }
    const std::string name = label.metric; // what has not come by the end, or what there is none of
    return name.rfind("settling", 0) == 0 || name.rfind("within", 0) == 0 ? "never" : "-";
}

const MetricLabel &metric_label(const std::string &metric)
{
    for (const MetricLabel &label : labels) {
        if (metric == label.metric) {
            return label;
        }
    }
    throw InputError(fmt::format("{} is not the name of a metric", metric));
}

std::string trace_csv(const Trace &trace)
{
    const std::vector<TraceColumn> columns = csv_columns();
    std::string                    s       = trace_head(columns);
    append_rows(s, columns, trace.begin(), trace.end());
    return s;
}

OutputFile trace_file(const std::filesystem::path &path, const Trace &trace)
{
    const std::vector<TraceColumn> columns = csv_columns();
    return {path, trace_head(columns), [columns, row = trace.begin(), end = trace.end()]() mutable {
                const auto  rows = std::min<std::ptrdiff_t>(rows_of_a_piece, end - row);
                std::string s;
                append_rows(s, columns, row, row + rows);
                row += rows;
                return s;
            }};
}

std::string result_json(const Scenario &scenario, const SimulationResult &result,
                        const std::vector<Metrics> &metrics)
{
    Json measures = Json::object();
    for (const Metrics &m : metrics) {
        Json entry{{"time_s", m.time_s}};
        for (const std::string &name : metric_names()) {
            if (!is_shown(name, scenario)) {
                continue;
            }
            entry[name] = nullptr; // of a time: never; otherwise it cannot be told
        }
        for (const auto &[name, value] : metric_values(m)) {
            entry[name] = value;
        }
        measures[m.name] = entry;
    }
    const Json out{{"scenario", scenario.name},
                   {"drive", scenario.drive.name},
                   {"seed", scenario.seed},
                   {"gains", result.compiled_table ? "compiled table" : "solved in process"},
                   {"uncertified", result.uncertified},
                   {"fault", fault_name(result.fault)},
                   {"fault_time_s", result.fault == 0 ? Json(nullptr) : Json(result.fault_time_s)},
                   {"measures", measures}};
    return out.text();
}

std::string result_text(const Scenario &scenario, const SimulationResult &result,
                        const std::vector<Metrics> &metrics)
{
    std::string s = fmt::format("{} on {}, gains: {}\n", scenario.name, scenario.drive.name,
                                result.compiled_table ? "compiled table" : "solved in process");
    for (const std::string &why : result.uncertified) {
        s += fmt::format("not certified: {}\n", why);
    }
    if (result.fault != 0) {
        s += fmt::format("FAULT at {:.4f} s: {}\n", result.fault_time_s, fault_name(result.fault));
    }
    if (result.ended != 0 && result.ended != result.fault) {
        s += fmt::format("the run ends at {:.4f} s: {}\n", result.trace.back().time_s,
                         fault_name(result.ended));
    }
    if (metrics.empty()) {
        return s + no_measures;
    }
    s += fmt::format("{:<26}", "");
    for (const Metrics &m : metrics) {
        s += fmt::format("{:>16}{:>10}", m.name, paper_of(scenario, m).empty() ? "" : "paper");
    }
    s += "\n";
    for (const MetricLabel &label : labels) {
        if (!is_shown(label.metric, scenario)) {
            continue;
        }
        s += fmt::format("{:<26}", label.text);
        for (const Metrics &m : metrics) {
            const auto &paper     = paper_of(scenario, m);
            const auto  published = value_of({paper.begin(), paper.end()}, label);
            s += fmt::format("{:>16}{:>10}", metric_text(label, value_of(metric_values(m), label)),
                             published ? metric_text(label, published) : "");
        }
        s += "\n";
    }
    return s;
}

} // namespace sdre
