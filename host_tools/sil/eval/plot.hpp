// SPDX-License-Identifier: MIT
/// Draws traces and spectra with matplotlib.
#pragma once

#include <filesystem>
#include <string>

#include "sil/run/trace.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// InputError when this name or this build cannot become a plot. Lets a tool refuse before it writes anything.
void require_plot(const std::filesystem::path &picture);

/// Annotations of a trace's picture, as JSON: host_tools/python/sdre_plot/draw_trace.py.
std::string trace_marks(const Scenario &scenario, const Trace &trace);

/// The bytes of a .png or .svg, as the name says, of a run with its measures, or from what spectrum_csv() gives. InputError when
/// no Python with matplotlib was found at build time or it fails.
std::string trace_picture(const Scenario &scenario, const Trace &trace, const std::string &title,
                          const std::filesystem::path &picture);
std::string spectrum_picture(const std::string &csv, const std::string &title,
                             const std::filesystem::path &picture);

} // namespace sdre
