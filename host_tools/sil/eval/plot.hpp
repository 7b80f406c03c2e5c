// SPDX-License-Identifier: MIT
/// Draws traces, spectra and comparisons with matplotlib.
#pragma once

#include <filesystem>
#include <string>

#include "sil/eval/compare.hpp"
#include "sil/run/trace.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// InputError when this name cannot become a plot, or Python has no matplotlib. A tool asks before it runs anything.
void require_plot(const std::filesystem::path &picture);

/// Annotations of a trace's picture, as JSON: host_tools/python/sdre_plot/draw_trace.py.
std::string trace_marks(const Scenario &scenario, const Trace &trace);

/// The bytes of a .png or .svg, as the name says, of a run with its measures, or from what spectrum_csv() gives. require_plot()
/// has been asked; InputError when drawing fails.
std::string trace_picture(const Scenario &scenario, const Trace &trace, const std::string &title,
                          const std::filesystem::path &picture);
std::string spectrum_picture(const std::string &csv, const std::string &title,
                             const std::filesystem::path &picture);
/// The same of all drives of a comparison, one line each.
std::string comparison_picture(const Comparison &comparison, const std::string &title,
                               const std::filesystem::path &picture);

} // namespace sdre
