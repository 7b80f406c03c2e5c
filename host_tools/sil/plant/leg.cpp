// SPDX-License-Identifier: MIT
#include "sil/plant/leg.hpp"

#include <algorithm>

namespace sdre {

void Leg::begin_period(double period_s, double rise_delay_s, double fall_delay_s)
{
    rise_delay_s_ = rise_delay_s;
    fall_delay_s_ = fall_delay_s;
    dead_until_s_ -= period_s;
    count_ = 0;
    next_  = 0;
}

void Leg::plan_change(double time_s, bool to_high)
{
    const bool before = count_ > 0 ? changes_[count_ - 1].high : high_;
    if (before != to_high) {
        changes_[count_++] = {time_s, to_high};
    }
}

void Leg::plan_duty(double duty, double T, Carrier carrier)
{
    if (duty >= 1.0 || duty <= 0.0) {
        plan_change(0.0, duty >= 1.0);
    } else if (carrier == Carrier::full) { // a pulse of duty T in the middle
        plan_change(0.0, false);
        plan_change(0.5 * T * (1.0 - duty), true);
        plan_change(0.5 * T * (1.0 + duty), false);
    } else if (carrier == Carrier::rising_half) {
        plan_change(0.0, false);
        plan_change(T * (1.0 - duty), true);
    } else {
        plan_change(0.0, true);
        plan_change(T * duty, false);
    }
}

void Leg::plan(const LegTiming &timing)
{
    for (int n = 0; n < timing.count; n++) {
        const LegTiming::Change &change = timing.changes.at(static_cast<std::size_t>(n));
        plan_change(change.time_s, change.high);
    }
}

void Leg::move_to(double now_s)
{
    for (; next_ < count_ && changes_[next_].time_s <= now_s + no_time_s; next_++) {
        high_         = changes_[next_].high;
        dead_until_s_ = changes_[next_].time_s + (high_ ? rise_delay_s_ : fall_delay_s_);
    }
}

double Leg::next_event_s(double now_s, double to_s) const
{
    double event_s = next_ < count_ ? std::min(to_s, changes_[next_].time_s) : to_s;
    return in_dead_time(now_s) ? std::min(event_s, dead_until_s_) : event_s;
}

} // namespace sdre
