// SPDX-License-Identifier: MIT
/// The part of the report with the usual figures of a drive.
#pragma once

#include <string>

#include "common/json.hpp"
#include "emit/report.hpp"

namespace sdre {

std::string machine_text(const Design &design, const std::optional<Prediction> &prediction);
Json        machine_json(const Design &design, const std::optional<Prediction> &prediction);

} // namespace sdre
