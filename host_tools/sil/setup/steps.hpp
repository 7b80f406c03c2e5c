// SPDX-License-Identifier: MIT
/// Values that change at given times.
#pragma once

#include <cstddef>
#include <vector>

namespace sdre {

/// A value from a time on.
struct Step {
    double time_s = 0.0;
    double value  = 0.0;
};

/// The last step at or before a time; `before` when there is none.
double value_at(const std::vector<Step> &steps, double time_s, double before);

/// value_at() for times that rise: it goes on from where it was.
class StepCursor {
public:
    StepCursor(const std::vector<Step> &steps, double before) : steps_(steps), value_(before) {}
    double at(double time_s);

private:
    const std::vector<Step> &steps_;
    std::size_t              next_ = 0;
    double                   value_;
};

} // namespace sdre
