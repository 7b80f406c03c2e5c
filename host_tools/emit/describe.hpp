// SPDX-License-Identifier: MIT
/// A page about one drive: what it is, can do and trips at, what the board is set to, what the certificate says.
#pragma once

#include <string>

#include "emit/report.hpp"

namespace sdre {

/// Markdown. InputError when the board cannot have the drive.
std::string description(const Design &design, const std::optional<Prediction> &prediction);

} // namespace sdre
