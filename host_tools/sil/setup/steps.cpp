// SPDX-License-Identifier: MIT
#include "sil/setup/steps.hpp"

namespace sdre {

namespace {

constexpr double time_tolerance_s = 1e-12; // a time and a tick that mean the same instant

} // namespace

double value_at(const std::vector<Step> &steps, double time_s, double before)
{
    double value = before;
    for (const Step &step : steps) {
        if (step.time_s > time_s + time_tolerance_s) {
            break;
        }
        value = step.value;
    }
    return value;
}

double StepCursor::at(double time_s)
{
    for (; next_ < steps_.size() && steps_[next_].time_s <= time_s + time_tolerance_s; next_++) {
        value_ = steps_[next_].value;
    }
    return value_;
}

} // namespace sdre
