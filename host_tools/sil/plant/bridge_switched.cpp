// SPDX-License-Identifier: MIT
#include "sil/plant/bridge.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {

/// Takes the edges that are due and says when the next thing happens.
double Bridge::next_event_s(double now_s, double to_s)
{
    double event_s = to_s;
    for (Leg &leg : legs_) {
        leg.move_to(now_s);
        event_s = leg.next_event_s(now_s, event_s);
    }
    return event_s;
}

/// The terminal voltage that keeps a phase current where it is, as far as the diodes let it.
double Bridge::hold_voltage_V(const Plant &plant, const Terminals &t, std::size_t x,
                              double dc_link_V) const
{
    std::array<double, 3> low  = t.v_V;
    std::array<double, 3> high = t.v_V;
    low[x]                     = 0.0;
    high[x]                    = dc_link_V;
    const double at_low        = as_array(plant.phase_current_rate_Aps(clarke(low)))[x];
    const double at_high       = as_array(plant.phase_current_rate_Aps(clarke(high)))[x];
    return std::clamp(-at_low / (at_high - at_low) * dc_link_V, -settings_.diode_drop_V,
                      dc_link_V + settings_.diode_drop_V);
}

Bridge::Terminals Bridge::terminals_at(const Circuit &c, const std::array<double, 3> &i,
                                       double now_s) const
{
    const double dc_link_V = c.dc_link.voltage_V();
    Terminals    t;
    for (std::size_t x = 0; x < 3; x++) {
        const bool out = i[x] >= 0.0;
        t.off[x]       = !enabled_[x] || legs_[x].in_dead_time(now_s);
        t.any_off      = t.any_off || t.off[x];
        const bool top = t.off[x] ? !out : legs_[x].high();
        // Outwards the upper switch or the lower diode carries the current, inwards the others.
        const double drop_V =
            !t.off[x] && top == out ? settings_.switch_drop_V : settings_.diode_drop_V;
        t.share[x] = top ? 1.0 : 0.0;
        t.v_V[x]   = t.share[x] * dc_link_V - (out ? drop_V : -drop_V);
    }
    for (std::size_t x = 0; t.any_off && x < 3; x++) {
        if (t.off[x] && legs_[x].held()) {
            t.v_V[x]   = hold_voltage_V(c.plant, t, x, dc_link_V);
            t.share[x] = 0.0;
        }
    }
    return t;
}

/// Over a dead time a current is a straight line.
Bridge::Piece Bridge::piece_of(const Circuit &c, const Terminals &t, const std::array<double, 3> &i,
                               double longest_s) const
{
    const std::array<double, 3> rate = as_array(c.plant.phase_current_rate_Aps(clarke(t.v_V)));
    Piece                       piece{longest_s, -1};
    for (std::size_t x = 0; x < 3; x++) {
        const bool fades = t.off[x] && !legs_[x].held() && i[x] * rate[x] <= 0.0;
        if (fades && std::abs(i[x]) < std::abs(rate[x]) * piece.dt_s) {
            piece = {std::abs(i[x] / rate[x]), static_cast<int>(x)};
        }
    }
    return piece;
}

void Bridge::advance_switched(const Circuit &c, double now_s, double dt_s)
{
    double left_s = dt_s;
    // Each pass but the last ends at a phase current's zero: at most one per leg.
    for (int pass = 0; pass < 4 && left_s > no_time_s; pass++) {
        const std::array<double, 3> i = as_array(c.plant.phase_current_A());
        const Terminals             t = terminals_at(c, i, now_s);
        const Piece piece             = t.any_off ? piece_of(c, t, i, left_s) : Piece{left_s, -1};
        if (piece.dt_s > 0.0) {
            apply(c, t, piece.dt_s);
        }
        left_s -= piece.dt_s;
        if (piece.dying >= 0) {
            legs_[static_cast<std::size_t>(piece.dying)].hold();
        }
    }
}

} // namespace sdre
