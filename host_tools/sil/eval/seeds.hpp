// SPDX-License-Identifier: MIT
/// One scenario under many noise seeds.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"

namespace sdre {

/// One metric over all seeds. A seed without a value ("never" of a time) leaves worst and mean empty.
struct SeedSpread {
    std::string metric;
    std::optional<double>
        worst; ///< the value furthest from zero; of estimates and axis currents: from the mean
    std::optional<double> mean;
    std::optional<double> median;
    std::optional<double> q95; ///< 95 % of the seeds are nearer to zero, or to the mean
    std::optional<double> q99;
    std::optional<double> best; ///< nearest to zero, or to the mean
};

struct SeedMeasure {
    std::string             name;
    double                  time_s = 0.0;
    std::vector<SeedSpread> spread;

    /// The worst value of a metric; none without the metric, or when a seed has no value.
    std::optional<double> worst(const std::string &metric) const
    {
        for (const SeedSpread &s : spread) {
            if (s.metric == metric) {
                return s.worst;
            }
        }
        return {};
    }
};

struct SeedRuns {
    int                      seeds  = 0;
    int                      faults = 0;        ///< seeds in which the drive tripped
    std::set<int>            fault_codes;       ///< of their trips, as SimulationResult::fault
    double                   last_trip_s = 0.0; ///< the latest of them; 0 without any
    SimulationResult         first;             ///< of seed 1
    std::vector<Metrics>     first_metrics;
    std::vector<SeedMeasure> measures;
};

/// Seeds 1 .. count, in parallel; the result does not depend on the number of threads.
SeedRuns run_seeds(const Scenario &scenario, int count);
/// The same of many scenarios at once.
std::vector<SeedRuns> run_seeds(const std::vector<Scenario> &scenarios, int count);

/// How one seeded scenario is run.
using SeededRun = std::function<SimulationResult(const Scenario &, const Controller &)>;
/// Seeds 1 .. count one after the other, for what must not run twice at a time.
SeedRuns run_seeds_in_turn(const Scenario &scenario, int count, const SeededRun &run_once);

/// Like result_json() and result_text(), with worst and mean in place of one run's values.
std::string seeds_json(const Scenario &scenario, const SeedRuns &runs);
std::string seeds_text(const Scenario &scenario, const SeedRuns &runs);

} // namespace sdre
