// SPDX-License-Identifier: MIT
/// Several drives, or several series orders of one drive, on the same scenarios, side by side.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sil/run/trace.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

struct CompareRequest {
    std::vector<std::filesystem::path> scenarios;
    std::vector<std::filesystem::path> drives; ///< empty: the one of each scenario
    std::vector<int> orders; ///< of both series, every drive with each; empty: the drive file's
    std::vector<std::string> metrics;   ///< empty: compare_default_metrics()
    int                      seeds = 1; ///< worst of the seeds 1 .. this
    bool                     equal_noise =
        false; ///< every drive's bandwidth is turned until it is as noisy (equal_noise.hpp)
    std::optional<double> noise_V =
        std::nullopt; ///< as this, in the first scenario's last measure; none: as the first drive
};

/// One metric of one measure.
struct CompareCell {
    std::optional<double> value; ///< none: never settled
    std::optional<double> paper; ///< published for this law
};

/// One drive on one scenario.
struct CompareRun {
    std::string scenario;
    std::string column; ///< the drive's name or its file's, with the order when orders were given
    int         faulted   = 0; ///< seeds in which the drive tripped
    bool        certified = true;
    std::map<std::string, std::map<std::string, CompareCell>> cells;    ///< by measure, by metric
    std::vector<std::string>                                  measures; ///< in the scenario's order
};

struct Comparison {
    std::vector<std::string> columns;
    std::vector<std::string> metrics;
    std::vector<CompareRun>  runs;   ///< scenario by scenario, columns in order
    std::vector<Scenario>    as_run; ///< of each run, with its drive
    std::vector<Trace>       traces; ///< of each run, with seed 1
    std::vector<std::string>
        missed; ///< a line for each drive that cannot be as noisy as the others
};

/// settling time, dip, overshoot, steady error, ripple, peak current.
const std::vector<std::string> &compare_default_metrics();

/// InputError on an unknown metric, a drive or a scenario given twice.
Comparison compare(const CompareRequest &request);

/// One row per scenario, measure and metric, one column per drive, "(paper x)" behind a value that was published.
std::string compare_markdown(const Comparison &comparison);
/// One row per scenario, measure, metric and drive; SI units.
std::string compare_csv(const Comparison &comparison);
std::string compare_json(const Comparison &comparison);

} // namespace sdre
