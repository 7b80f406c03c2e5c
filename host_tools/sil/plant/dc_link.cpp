// SPDX-License-Identifier: MIT
#include "sil/plant/dc_link.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

// Chosen: the chopper's current is constant over this share of R C; 1e-7 of a voltage's change is lost.
constexpr double chopper_step = 1e-3;

constexpr double two_pi = 6.28318530717958647693;

} // namespace

DcLink::DcLink(const InverterSettings &settings, double source_V) : v_V_(source_V)
{
    configure(settings, source_V);
}

void DcLink::configure(const InverterSettings &s, double source_V)
{
    mean_V_         = source_V;
    ripple_V_       = s.ripple_V;
    ripple_radps_   = two_pi * s.ripple_Hz;
    resistance_Ohm_ = s.source_resistance_Ohm;
    capacitance_F_  = s.capacitance_F;
    blocks_         = s.regeneration == Regeneration::blocks;
    stiff_          = !blocks_ && resistance_Ohm_ <= 0.0;
    chopper_Ohm_    = s.chopper_on_V ? s.chopper_resistance_Ohm : 0.0;
    chopper_on_V_   = s.chopper_on_V.value_or(0.0);
    chopper_off_V_  = chopper_on_V_ - s.chopper_hysteresis_V;
    chopping_       = chopping_ && chopper_Ohm_ > 0.0;
    of_board_       = s.chopper_of_board;
    ripple(0.0);
}

/// EQ-DC-LINK-3.
void DcLink::ripple(double dt_s)
{
    ripple_rad_ = std::fmod(ripple_rad_ + ripple_radps_ * dt_s, two_pi);
    source_V_   = mean_V_ + ripple_V_ * std::sin(ripple_rad_);
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

void DcLink::command_chopper(bool on)
{
    if (of_board_) {
        commanded_ = true;
        chopping_  = on;
    }
}

void DcLink::advance(double bridge_A, double dt_s)
{
    if (chopper_Ohm_ > 0.0) {
        chop(bridge_A, dt_s);
    } else if (!stiff_) {
        charge(bridge_A, dt_s);
    }
    if (ripple_V_ > 0.0) {
        ripple(dt_s);
    }
}

void DcLink::chop(double bridge_A, double dt_s)
{
    double left_s = dt_s;
    while (left_s > 0.0) {
        if (!commanded_) {
            chopping_ = v_V_ >= chopper_on_V_ || (chopping_ && v_V_ > chopper_off_V_);
        }
        const double piece_s = std::min(left_s, chopper_step * chopper_Ohm_ * capacitance_F_);
        const double before  = v_V_;
        double       load_V  = chopping_ ? before : 0.0;
        if (chopping_) { // the mean of the voltages at both ends
            charge(bridge_A + load_V / chopper_Ohm_, piece_s);
            load_V = 0.5 * (before + v_V_);
            v_V_   = before;
        }
        charge(bridge_A + load_V / chopper_Ohm_, piece_s); // EQ-DC-LINK-2
        const double level_V = chopping_ ? chopper_off_V_ : chopper_on_V_;
        double       used_s  = piece_s;
        if (!commanded_ &&
            (chopping_ ? v_V_ < level_V : v_V_ > level_V)) { // over a piece a straight line
            used_s *= (level_V - before) / (v_V_ - before);
            v_V_ = level_V;
        }
        chopper_J_ += load_V * load_V / chopper_Ohm_ * used_s;
        left_s -= used_s;
    }
}

void DcLink::charge(double bridge_A, double dt_s)
{
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
