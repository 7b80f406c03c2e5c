// SPDX-License-Identifier: MIT
#include "sil/plant/load.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

constexpr double time_tolerance_s = 1e-12; // a time and a tick that mean the same instant

} // namespace

LoadProfile::LoadProfile(const std::vector<Step> &steps, const std::vector<LoadRamp> &ramps,
                         const LoadSine &sine)
    : sine_(sine)
{
    for (const Step &s : steps) {
        pieces_.push_back({s.time_s, s.time_s, s.value, s.value});
    }
    for (const LoadRamp &r : ramps) {
        pieces_.push_back({r.time_s, r.until_s, 0.0, r.to_Nm});
    }
    std::stable_sort(pieces_.begin(), pieces_.end(),
                     [](const Piece &a, const Piece &b) { return a.time_s < b.time_s; });
    double torque_Nm = 0.0;
    for (std::size_t i = 0; i < pieces_.size(); i++) {
        Piece &p  = pieces_[i];
        p.from_Nm = p.until_s > p.time_s ? torque_Nm : p.to_Nm;
        torque_Nm = i + 1 < pieces_.size() ? value_of(p, pieces_[i + 1].time_s) : p.to_Nm;
    }
}

void LoadProfile::set_sine(const LoadSine &sine)
{
    sine_ = sine;
}

double LoadProfile::value_of(const Piece &p, double time_s) const
{
    if (time_s >= p.until_s) {
        return p.to_Nm;
    }
    return p.from_Nm +
           (p.to_Nm - p.from_Nm) * std::max(0.0, time_s - p.time_s) / (p.until_s - p.time_s);
}

double LoadProfile::at(double time_s, double ahead_s)
{
    while (next_ < pieces_.size() && pieces_[next_].time_s <= time_s + time_tolerance_s) {
        next_++;
    }
    double       torque_Nm = next_ == 0 ? 0.0 : value_of(pieces_[next_ - 1], time_s + ahead_s);
    const double since_s   = time_s + ahead_s - sine_.start_s;
    if (sine_.amplitude_Nm != 0.0 && since_s >= 0.0) {
        torque_Nm +=
            sine_.amplitude_Nm * std::sin(2.0 * std::acos(-1.0) * sine_.frequency_Hz * since_s);
    }
    return torque_Nm; // EQ-LOAD-1
}

PowderBrake::PowderBrake(const BrakeSettings &settings) : settings_(settings) {}

double PowderBrake::after_s(double duration_s) const // EQ-LOAD-2, the command constant
{
    const double lag_s = settings_.time_constant_s;
    const double rest  = lag_s > 0.0 ? std::exp(-duration_s / lag_s) : 0.0;
    return command_Nm_ + rest * (torque_Nm_ - command_Nm_);
}

double PowderBrake::at(double time_s, double ahead_s)
{
    const std::vector<Step> &steps = settings_.command;
    for (; next_ < steps.size() && steps[next_].time_s <= time_s + time_tolerance_s; next_++) {
        torque_Nm_  = after_s(steps[next_].time_s - since_s_);
        since_s_    = steps[next_].time_s;
        command_Nm_ = steps[next_].value;
    }
    return settings_.drag_Nm + after_s(time_s + ahead_s - since_s_);
}

} // namespace sdre
