// SPDX-License-Identifier: MIT
/// One leg of the bridge: its commands in a control period, and its state.
#pragma once

#include <array>
#include <cstddef>

namespace sdre {

// Chosen: an interval below this is rounding, not time.
constexpr double no_time_s = 1e-13;

/// Switching times of a leg in one control period. A change turns one switch off at once and the
/// other on after the delay.
struct LegTiming {
    struct Change {
        double time_s = 0.0;
        bool   high   = false;
    };
    std::array<Change, 4> changes{}; ///< in order of time, the first at 0
    int                   count        = 0;
    double                duty         = 0.0; ///< share of the period that is high
    double                rise_delay_s = 0.0; ///< upper switch
    double                fall_delay_s = 0.0; ///< lower switch
};

/// The shape of the control period that pulses are planned in.
enum class Carrier { full, rising_half, falling_half };

class Leg {
public:
    /// The coming period; the time of the last dead time's end moves with it.
    void begin_period(double period_s, double rise_delay_s, double fall_delay_s);
    /// The changes of the period from its duty ratio: a centred pulse, or the half of one.
    void plan_duty(double duty, double period_s, Carrier carrier);
    /// The changes as they are.
    void plan(const LegTiming &timing);

    /// Takes the changes that are due.
    void move_to(double now_s);
    /// The next change or end of a dead time after now, at most to_s.
    double next_event_s(double now_s, double to_s) const;

    bool high() const ///< commanded
    {
        return high_;
    }
    bool in_dead_time(double now_s) const
    {
        return dead_until_s_ > now_s + no_time_s;
    }
    double rise_delay_s() const
    {
        return rise_delay_s_;
    }
    double fall_delay_s() const
    {
        return fall_delay_s_;
    }

private:
    void                             plan_change(double time_s, bool to_high);
    std::array<LegTiming::Change, 4> changes_{};
    std::size_t                      count_        = 0;
    std::size_t                      next_         = 0;
    bool                             high_         = false;
    double                           dead_until_s_ = 0.0;
    double                           rise_delay_s_ = 0.0;
    double                           fall_delay_s_ = 0.0;
};

} // namespace sdre
