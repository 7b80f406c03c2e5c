// SPDX-License-Identifier: MIT
#include "sil/plant/dc_link.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {

DcLink::DcLink(const InverterSettings &settings, double source_V) : v_V_(source_V)
{
    configure(settings, source_V);
}

void DcLink::configure(const InverterSettings &s, double source_V)
{
    source_V_       = source_V;
    resistance_Ohm_ = s.source_resistance_Ohm;
    capacitance_F_  = s.capacitance_F;
    blocks_         = s.regeneration == Regeneration::blocks;
    stiff_          = !blocks_ && resistance_Ohm_ <= 0.0;
    settle();
}

void DcLink::settle()
{
    if (stiff_) {
        v_V_ = source_V_;
    } else if (resistance_Ohm_ <= 0.0) {
        v_V_ = std::max(v_V_, source_V_);
    }
}

void DcLink::advance(double bridge_A, double dt_s)
{
    if (stiff_) {
        return;
    }
    const double slope_Vps = -bridge_A / capacitance_F_;
    double       left_s    = dt_s;
    if (blocks_ && v_V_ >= source_V_) { // the rectifier is off
        const double fall_s = slope_Vps < 0.0 ? (source_V_ - v_V_) / slope_Vps : left_s;
        const double off_s  = std::min(left_s, fall_s);
        v_V_ += slope_Vps * off_s;
        left_s -= off_s;
        if (left_s <= 0.0) {
            return;
        }
        v_V_ = source_V_;
    }
    if (resistance_Ohm_ <= 0.0) {
        settle();
        return;
    }
    const double final_V = source_V_ - resistance_Ohm_ * bridge_A;
    const double tau_s   = resistance_Ohm_ * capacitance_F_;
    if (blocks_ && final_V > source_V_) { // charging from below: on until the source is reached
        const double on_s = tau_s * std::log((final_V - v_V_) / (final_V - source_V_));
        if (on_s < left_s) {
            v_V_ = source_V_ + slope_Vps * (left_s - on_s);
            return;
        }
    }
    v_V_ = final_V + (v_V_ - final_V) * std::exp(-left_s / tau_s);
}

} // namespace sdre
