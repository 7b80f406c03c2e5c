// SPDX-License-Identifier: MIT
#include "sil/board/motor_surroundings.hpp"

#include "sil/board/front_end.hpp"

namespace sdre::f28335 {
namespace {

int high_counts(const LegPeriod &leg, int period_cnt)
{
    int sum = 0;
    for (std::size_t n = 0; n < leg.a.size(); n++) {
        const int until = n + 1 < leg.a.size() ? leg.a[n + 1].time_cnt : period_cnt;
        sum += leg.a[n].level ? until - leg.a[n].time_cnt : 0;
    }
    return sum;
}

} // namespace

MotorSurroundings::MotorSurroundings(MotorBench &bench, bool ideal_inverter, double dc_link_range_V,
                                     int duty_full_cnt)
    : bench_(bench), ideal_inverter_(ideal_inverter), dc_link_range_V_(dc_link_range_V),
      duty_full_cnt_(duty_full_cnt)
{
}

void MotorSurroundings::period_begins(const ControlPeriod &period)
{
    std::array<LegTiming, 3> legs;
    for (std::size_t n = 0; n < 3; n++) {
        const LegPeriod &leg    = period.legs[n];
        LegTiming       &timing = legs[n];
        for (const SignalEdge &e : leg.a) {
            timing.changes.at(static_cast<std::size_t>(timing.count++)) = {
                period.seconds(e.time_cnt), e.level};
        }
        const int high = high_counts(leg, period.counts);
        timing.duty    = static_cast<double>(high) / period.counts;
        duty_cnt_[n]   = high * duty_full_cnt_ / period.counts;
        if (!ideal_inverter_) {
            timing.rise_delay_s = period.seconds(leg.rise_delay_cnt);
            timing.fall_delay_s = period.seconds(leg.fall_delay_cnt);
        }
    }
    bench_.begin_tick();
    bench_.begin_period(legs);
}

void MotorSurroundings::legs_change(const std::array<bool, 3> &enabled, double into_period_s)
{
    bench_.set_legs(enabled, into_period_s);
}

void MotorSurroundings::brake_changes(bool high, double into_period_s)
{
    bench_.set_brake(high, into_period_s);
}

void MotorSurroundings::chopper_changes(bool on, double into_period_s)
{
    bench_.set_chopper(on, into_period_s);
}

double MotorSurroundings::analog_V(int side, int number)
{
    const RawSample &s = bench_.sample();
    if (number == 0) {
        return voltage_V(current_code(side == 0 ? s.ia_code : s.ib_code));
    }
    if (number == 1) {
        return voltage_V(side == 0 ? dc_link_code(s.dc_link_V, dc_link_range_V_)
                                   : temperature_code);
    }
    if (number == 2 && side == 1) {
        return voltage_V(current_code(s.ic_code));
    }
    return 0.0;
}

ShaftCount MotorSurroundings::shaft(double into_period_s)
{
    const RawSample &s = bench_.sample();
    ShaftCount       now;
    now.count       = into_period_s > 0.0 ? bench_.count_after(into_period_s) : s.count;
    now.index       = into_period_s <= 0.0 && s.index;
    now.index_count = s.index_count;
    if (into_period_s <= 0.0) {
        for (const EncoderEdge &edge : bench_.edges()) {
            now.edges.push_back({bench_.period_s() - edge.time_s, edge.direction});
        }
    }
    return now;
}

} // namespace sdre::f28335
