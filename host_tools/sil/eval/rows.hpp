// SPDX-License-Identifier: MIT
/// Statistics over the rows of a trace.
#pragma once

#include <cmath>
#include <vector>

#include "sil/run/trace.hpp"

namespace sdre {

/// Mean of a value of the rows, of which there is one at least.
template <typename Value>
double mean(Trace::const_iterator begin, Trace::const_iterator end, const Value &value)
{
    double sum = 0.0;
    for (auto row = begin; row != end; ++row) {
        sum += value(*row);
    }
    return sum / static_cast<double>(end - begin);
}

/// Mean square of the deviation from the mean.
template <typename Value>
double variance(Trace::const_iterator begin, Trace::const_iterator end, const Value &value)
{
    const double middle = mean(begin, end, value);
    return mean(begin, end, [&](const TraceRow &r) { return std::pow(value(r) - middle, 2); });
}

} // namespace sdre
