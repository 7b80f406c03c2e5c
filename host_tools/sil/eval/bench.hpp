// SPDX-License-Identifier: MIT
/// How fast the simulation runs, and what of it is the control core.
#pragma once

#include <filesystem>
#include <string>

namespace sdre {

/// Runs the scenario on ideal signals and on the shipped board with both inverter models, on one core.
std::string bench_text(const std::filesystem::path &scenario);

/// The scenario that is measured when none is given.
std::filesystem::path default_bench_scenario();

} // namespace sdre
