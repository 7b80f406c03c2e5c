// SPDX-License-Identifier: MIT
#include "sil/plant/bridge.hpp"

namespace sdre {

/// Applies the edges that are due and returns the time of the next event.
double Bridge::next_event_s(double now_s, double to_s)
{
    double event_s = to_s;
    for (Leg &leg : legs_) {
        leg.move_to(now_s);
        event_s = leg.next_event_s(now_s, event_s);
    }
    return event_s;
}

/// A switch holds the terminal at its rail.
void Bridge::switch_leg(Terminals &t, std::size_t x, double current_A, double dc_link_V) const
{
    const bool out = current_A >= 0.0;
    const bool top = legs_[x].high();
    // Outwards the upper switch or the lower diode carries the current, inwards the others.
    const double drop_V = top == out ? settings_.switch_drop_V : settings_.diode_drop_V;
    t.share[x]          = top ? 1.0 : 0.0;
    t.v_V[x]            = t.share[x] * dc_link_V - (out ? drop_V : -drop_V);
}

} // namespace sdre
