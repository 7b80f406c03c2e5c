// SPDX-License-Identifier: MIT
/// A finished run as text: CSV for plots, JSON for programs, a table for people.
#pragma once

#include <string>
#include <vector>

#include "metrics.hpp"
#include "simulation.hpp"

namespace sdre {

/// Header line, then one row per control period.
std::string trace_csv(const std::vector<TraceRow> &trace);

std::string result_json(const Scenario &scenario, const SimulationResult &result,
                        const std::vector<Metrics> &metrics);

/// Metrics in rows, one column per measure and one for the published value where the scenario gives it.
std::string result_text(const Scenario &scenario, const SimulationResult &result,
                        const std::vector<Metrics> &metrics);

} // namespace sdre
