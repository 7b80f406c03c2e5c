// SPDX-License-Identifier: MIT
/// The part of the report that a person who uses the drive asks for first.
#pragma once

#include <string>

#include "common/json.hpp"
#include "emit/report.hpp"

namespace sdre {

std::string machine_text(const Design &design, const std::optional<Prediction> &prediction);
Json        machine_json(const Design &design, const std::optional<Prediction> &prediction);

} // namespace sdre
