// SPDX-License-Identifier: MIT
/// The quantities of a trace by name.
#pragma once

#include <vector>

#include "sil/run/trace.hpp"

namespace sdre {

struct TraceColumn {
    const char *name;
    double (*of)(const TraceRow &);
};

const std::vector<TraceColumn> &trace_columns();

} // namespace sdre
