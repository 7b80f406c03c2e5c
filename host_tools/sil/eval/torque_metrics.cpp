// SPDX-License-Identifier: MIT
#include "sil/eval/torque_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "sil/eval/rows.hpp"

namespace sdre {
namespace {

using Iterator = Trace::const_iterator;

constexpr double risen      = 0.9;
constexpr double least_step = 1e-3; // chosen: of the rated torque

std::optional<double> rise_s(const TorqueWindow &w)
{
    const double step  = w.target_Nm - w.before_Nm;
    const auto   share = [&](const TraceRow &r) { return (r.torque_Nm - w.before_Nm) / step; };
    const auto   there =
        std::find_if(w.begin, w.end, [&](const TraceRow &r) { return share(r) >= risen; });
    if (there == w.end) {
        return std::nullopt;
    }
    if (there == w.begin) {
        return 0.0;
    }
    const TraceRow &before = *(there - 1);
    const double    part   = (risen - share(before)) / (share(*there) - share(before));
    return before.time_s + part * (there->time_s - before.time_s) - w.begin->time_s;
}

double overshoot_percent(const TorqueWindow &w)
{
    const double step   = w.target_Nm - w.before_Nm;
    double       beyond = 0.0;
    std::for_each(w.begin, w.end, [&](const TraceRow &r) {
        beyond = std::max(beyond, (r.torque_Nm - w.target_Nm) / step);
    });
    return 100.0 * beyond;
}

double ripple_Nm(Iterator tail, Iterator end)
{
    const double   centre = mean(tail, end, [](const TraceRow &r) { return r.torque_Nm; });
    double         square = 0.0;
    std::ptrdiff_t count  = 0;
    for (Iterator row = tail; end - row > 1; ++row, ++count) {
        square += std::pow(0.5 * (row->torque_Nm + (row + 1)->torque_Nm) - centre, 2);
    }
    return count > 0 ? std::sqrt(square / static_cast<double>(count)) : 0.0;
}

} // namespace

TorqueMetrics torque_metrics_of(const TorqueWindow &w, double rated_Nm)
{
    TorqueMetrics m;
    if (std::abs(w.target_Nm - w.before_Nm) > least_step * rated_Nm) {
        m.rise_s            = rise_s(w);
        m.overshoot_percent = overshoot_percent(w);
    }
    const double found_Nm = mean(w.tail, w.end, [](const TraceRow &r) { return r.torque_Nm; });
    m.error_percent       = 100.0 * std::abs(found_Nm - w.target_Nm) / rated_Nm;
    m.ripple_percent      = 100.0 * ripple_Nm(w.tail, w.end) / rated_Nm;
    return m;
}

} // namespace sdre
