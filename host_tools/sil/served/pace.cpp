// SPDX-License-Identifier: MIT
#include "sil/served/pace.hpp"

namespace sdre {
namespace {

constexpr double window_s   = 1.0; // chosen: a person sees a change, and one late round is no alarm
constexpr double slow_share = 0.9; // of what was asked for: chosen; a person notices no less
constexpr double quick_share = 0.97; // above which the next time counts as another one

} // namespace

void Pace::note(double wall_s, double simulated_s)
{
    if (!from_wall_s_) {
        from_wall_s_      = wall_s;
        from_simulated_s_ = simulated_s;
        return;
    }
    const double passed_s = wall_s - *from_wall_s_;
    if (passed_s < window_s) {
        return;
    }
    real_time_factor_ = (simulated_s - from_simulated_s_) / passed_s;
    from_wall_s_      = wall_s;
    from_simulated_s_ = simulated_s;
}

bool Pace::has_become_slow()
{
    const double share = real_time_factor() / speed_factor_;
    const bool   news  = !slow_ && share < slow_share;
    slow_              = share < slow_share || (slow_ && share < quick_share);
    return news;
}

} // namespace sdre
