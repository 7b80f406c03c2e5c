// SPDX-License-Identifier: MIT
/// Predicted load step of a drive, from the linear model of its sampled loop.
#pragma once

#include <optional>

#include "drive/drive_file.hpp"
#include "emit/report.hpp"

namespace sdre {

/// Nothing for laws that the objective has no model of, and for a motor that cannot have its ratings.
std::optional<Prediction> predicted(const Drive &drive);

} // namespace sdre
