// SPDX-License-Identifier: MIT
/// A finished run as text: CSV for plots, JSON for programs, a table for people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/file_output.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"

namespace sdre {

/// How a metric is shown to people.
struct MetricLabel {
    const char *metric;
    const char *text; ///< with the unit
    double      factor;
    const char *format;
};

/// InputError for what is not the name of a metric.
const MetricLabel &metric_label(const std::string &metric);

/// A value in the label's unit; none is "never" of a time, "-" of anything else.
std::string metric_text(const MetricLabel &label, const std::optional<double> &value);

/// Text in place of a table without columns.
extern const char *const no_measures;

/// Header line, then one row per control period.
std::string trace_csv(const Trace &trace);
/// The same piece by piece. The trace has to outlive it.
OutputFile trace_file(const std::filesystem::path &path, const Trace &trace);

std::string result_json(const Scenario &scenario, const SimulationResult &result,
                        const std::vector<Metrics> &metrics);

/// Metrics in rows, one column per measure and one for the published value where the scenario gives it.
std::string result_text(const Scenario &scenario, const SimulationResult &result,
                        const std::vector<Metrics> &metrics);

} // namespace sdre
