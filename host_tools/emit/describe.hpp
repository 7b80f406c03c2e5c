// SPDX-License-Identifier: MIT
/// A page about one drive: its data, limits, trip levels, board settings and certificate.
#pragma once

#include <string>

#include "emit/report.hpp"

namespace sdre {

/// Markdown. InputError when the board cannot have the drive.
std::string description(const Design &design, const std::optional<Prediction> &prediction);

} // namespace sdre
