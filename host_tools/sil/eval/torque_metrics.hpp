// SPDX-License-Identifier: MIT
/// Metrics of a torque run.
#pragma once

#include <optional>

#include "sil/run/trace.hpp"

namespace sdre {

struct TorqueMetrics {
    std::optional<double>
                          rise_s; ///< from the command to 0.9 of its step, between rows by a straight line; none without a step
    std::optional<double> overshoot_percent;   ///< largest torque beyond the target, of the step
    double                error_percent = 0.0; ///< |mean in the tail - target|, of the rated torque
    double                ripple_percent =
        0.0; ///< rms deviation of the period means in the tail, of the rated torque
};

/// The rows of a measure with what was commanded before and in it [N m].
struct TorqueWindow {
    Trace::const_iterator begin;
    Trace::const_iterator tail;
    Trace::const_iterator end;
    double                before_Nm;
    double                target_Nm;
};

/// A row has the torque at the middle of the voltage pulses, where the ripple of the pulses crosses zero. The mean of a period is
/// that of its two rows.
TorqueMetrics torque_metrics_of(const TorqueWindow &window, double rated_Nm);

} // namespace sdre
