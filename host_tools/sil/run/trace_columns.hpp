// SPDX-License-Identifier: MIT
/// The quantities of a trace by name: the one list that CSV files and the Python package are made of.
#pragma once

#include <vector>

#include "sil/run/trace.hpp"

namespace sdre {

/// One quantity of a row, in the SI unit that its name ends with.
struct TraceColumn {
    const char *name;
    double (*of)(const TraceRow &);
    int digits; ///< significant ones in a CSV file; 0: it is not in one
};

const std::vector<TraceColumn> &trace_columns();

} // namespace sdre
