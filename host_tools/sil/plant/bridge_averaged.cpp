// SPDX-License-Identifier: MIT
#include "sil/plant/bridge.hpp"

#include <algorithm>

namespace sdre {

void Bridge::average_leg(Terminals &t, std::size_t x, double current_A, double dc_link_V) const
{
    const Leg   &leg     = legs_[x];
    const double width_A = width_s_[x] * dc_link_V / timing_.inductance_H; // EQ-INVERTER-4
    const double sign    = std::clamp(current_A / width_A, -1.0, 1.0);
    const bool   edges   = duty_[x] > 0.0 && duty_[x] < 1.0;
    // Outwards the upper switch comes late, inwards the lower one.
    const double late_s = sign > 0.0 ? leg.rise_delay_s() : leg.fall_delay_s();
    const double lost   = edges ? sign * late_s * timing_.pwm_frequency_Hz : 0.0;
    const double share  = std::clamp(duty_[x] - lost, 0.0, 1.0); // EQ-INVERTER-2
    const double out    = sign > 0.0 ? share : 1.0 - share;      // through a switch, not a diode
    const double drop_V = out * settings_.switch_drop_V + (1.0 - out) * settings_.diode_drop_V;
    t.share[x]          = share;
    t.v_V[x]            = share * dc_link_V - sign * drop_V; // EQ-INVERTER-3
}

} // namespace sdre
