// SPDX-License-Identifier: MIT
/// Common part of the two forms of the report.
#pragma once

#include <Eigen/Core>

#include "design/design.hpp"

namespace sdre {

/// An entry as the tables have it: what is zero in exact arithmetic is zero, not the solver's rounding.
double report_entry(const Eigen::MatrixXd &M, Eigen::Index row, Eigen::Index column);

const char *report_channel_name(nodo_harmonic_channel_t channel);

} // namespace sdre
