// SPDX-License-Identifier: MIT
#include "sil/plant/inverter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sdre {
namespace {

// Chosen: below this current the diodes' rail voltage fades out, so that the averaged model comes to rest.
constexpr double diode_fade_A = 0.05;

StatorVector clarke(double a, double b, double c)
{
    return {(2.0 * a - b - c) / 3.0, (b - c) / std::sqrt(3.0)};
}

double diode_share(double current_A)
{
    return -0.5 * std::clamp(current_A / diode_fade_A, -1.0, 1.0);
}

} // namespace

StatorVector inverter_voltage(const drive_output_t &output, double dc_link_V, StatorVector i)
{
    StatorVector share;
    if (output.gate_enable) {
        share = clarke(output.duty.a, output.duty.b, output.duty.c); // EQ-INVERTER-1
    } else {
        const double half_beta = 0.5 * std::sqrt(3.0) * i.beta;
        share = clarke(diode_share(i.alpha), diode_share(half_beta - 0.5 * i.alpha),
                       diode_share(-half_beta - 0.5 * i.alpha));
    }
    return {dc_link_V * share.alpha, dc_link_V * share.beta};
}

namespace {

// Measured: at 850 rad/s two RK4 steps of 100 us stay within 5e-6 A of steps of 5 us.
constexpr double steps_per_period = 2.0;
// Chosen: an interval below this is rounding, not time.
constexpr double no_time_s = 1e-13;

std::array<double, 3> phases_of(const PhaseVector &x)
{
    return {x.a, x.b, x.c};
}

StatorVector stator_of(const std::array<double, 3> &v)
{
    static const double inv_sqrt3 = 1.0 / std::sqrt(3.0);
    return {(2.0 * v[0] - v[1] - v[2]) / 3.0, (v[1] - v[2]) * inv_sqrt3};
}

} // namespace

Bridge::Bridge(const BridgeTiming &timing, const InverterSettings &settings, double dead_time_s)
    : timing_(timing)
{
    configure(settings, dead_time_s);
}

void Bridge::configure(const InverterSettings &settings, double dead_time_s)
{
    settings_    = settings;
    dead_time_s_ = dead_time_s;
}

void Bridge::Leg::plan(double time_s, bool to_high)
{
    const bool before = count > 0 ? edges[static_cast<std::size_t>(count - 1)].high : high;
    if (before != to_high) {
        edges[static_cast<std::size_t>(count++)] = {time_s, to_high,
                                                    to_high ? rise_dead_s : fall_dead_s};
    }
}

void Bridge::plan_leg(Leg &leg, double duty) const
{
    leg.count      = 0;
    leg.next       = 0;
    const double T = timing_.period_s;
    if (duty >= 1.0 || duty <= 0.0) {
        leg.plan(0.0, duty >= 1.0);
    } else if (!timing_.half_periods) { // a pulse of duty T in the middle
        leg.plan(0.0, false);
        leg.plan(0.5 * T * (1.0 - duty), true);
        leg.plan(0.5 * T * (1.0 + duty), false);
    } else if (rising_half_) {
        leg.plan(0.0, false);
        leg.plan(T * (1.0 - duty), true);
    } else {
        leg.plan(0.0, true);
        leg.plan(T * duty, false);
    }
}

void Bridge::begin_period(const drive_output_t &output)
{
    const std::array<double, 3> asked{static_cast<double>(output.duty.a),
                                      static_cast<double>(output.duty.b),
                                      static_cast<double>(output.duty.c)};
    enabled_.fill(output.gate_enable);
    volt_seconds_ = {};
    for (std::size_t x = 0; x < 3; x++) {
        duty_[x]        = std::clamp(asked[x], settings_.duty_min, settings_.duty_max);
        Leg &leg        = legs_[x];
        leg.rise_dead_s = dead_time_s_;
        leg.fall_dead_s = dead_time_s_;
        if (settings_.model == InverterModel::switched) {
            leg.dead_until_s -= timing_.period_s;
            plan_leg(leg, duty_[x]);
        }
    }
    rising_half_ = !rising_half_;
}

void Bridge::begin_period(const std::array<LegTiming, 3> &legs)
{
    volt_seconds_ = {};
    for (std::size_t x = 0; x < 3; x++) {
        const LegTiming &timing = legs[x];
        Leg             &leg    = legs_[x];
        duty_[x]                = timing.duty;
        leg.rise_dead_s         = timing.rise_delay_s;
        leg.fall_dead_s         = timing.fall_delay_s;
        leg.dead_until_s -= timing_.period_s;
        leg.count = 0;
        leg.next  = 0;
        for (int n = 0; n < timing.count; n++) {
            const LegTiming::Change &change = timing.changes.at(static_cast<std::size_t>(n));
            leg.plan(change.time_s, change.high);
        }
    }
}

void Bridge::advance(Plant &plant, DcLink &dc_link, const ShaftLoad &load, double from_s,
                     double to_s)
{
    const double longest_s = timing_.period_s / steps_per_period;
    double       now_s     = from_s;
    while (to_s - now_s > no_time_s) {
        const bool   switched = any_enabled() && settings_.model == InverterModel::switched;
        const double event_s  = switched ? next_event_s(now_s, to_s) : to_s;
        const double pieces   = std::ceil((event_s - now_s) / longest_s - 1e-9);
        const double dt_s     = (event_s - now_s) / std::max(1.0, pieces);
        for (int n = 0; n < static_cast<int>(std::max(1.0, pieces)); n++) {
            if (switched) {
                advance_switched(plant, dc_link, load, now_s, dt_s);
            } else {
                advance_averaged(plant, dc_link, load, dt_s);
            }
        }
        now_s = event_s;
    }
}

void Bridge::apply(Plant &plant, DcLink &dc_link, const ShaftLoad &load,
                   const std::array<double, 3> &terminal_V, const std::array<double, 3> &share,
                   double dt_s)
{
    for (std::size_t x = 0; x < 3; x++) {
        volt_seconds_[x] += terminal_V[x] * dt_s;
    }
    if (dc_link.stiff()) {
        plant.advance(stator_of(terminal_V), load, dt_s);
        return;
    }
    const auto dot = [&](const PhaseVector &i) {
        return share[0] * i.a + share[1] * i.b + share[2] * i.c;
    };
    const double before_A = dot(plant.phase_current_A());
    plant.advance(stator_of(terminal_V), load, dt_s);
    dc_link.advance(0.5 * (before_A + dot(plant.phase_current_A())), dt_s);
}

void Bridge::advance_averaged(Plant &plant, DcLink &dc_link, const ShaftLoad &load, double dt_s)
{
    const std::array<double, 3> i     = phases_of(plant.phase_current_A());
    const double                vdc_V = dc_link.voltage_V();
    std::array<double, 3>       share{};
    std::array<double, 3>       v{};
    for (std::size_t x = 0; x < 3; x++) {
        const Leg   &leg    = legs_[x];
        const double dead_s = std::max(leg.rise_dead_s, leg.fall_dead_s);
        // EQ-INVERTER-4; with drops alone the width is that of a hundredth of the period.
        const double width_s = std::max(dead_s, 0.01 / timing_.pwm_frequency_Hz);
        double       width_A = width_s * vdc_V / timing_.inductance_H;
        if (!enabled_[x]) { // the diodes' rails fade so that one step cannot turn a current around
            width_A = std::max(diode_fade_A, dt_s * vdc_V / timing_.inductance_H);
        }
        const double sign = std::clamp(i[x] / width_A, -1.0, 1.0);
        if (enabled_[x]) {
            const bool edges = duty_[x] > 0.0 && duty_[x] < 1.0;
            // Outwards the upper switch comes late, inwards the lower one.
            const double lost =
                (sign > 0.0 ? leg.rise_dead_s : leg.fall_dead_s) * timing_.pwm_frequency_Hz;
            share[x] =
                std::clamp(duty_[x] - (edges ? sign * lost : 0.0), 0.0, 1.0); // EQ-INVERTER-2
            const double out =
                sign > 0.0 ? share[x] : 1.0 - share[x]; // through a switch, not a diode
            v[x] =
                share[x] * vdc_V - sign * (out * settings_.switch_drop_V +
                                           (1.0 - out) * settings_.diode_drop_V); // EQ-INVERTER-3
        } else {
            share[x] = 0.5 - 0.5 * sign;
            v[x]     = share[x] * vdc_V - sign * settings_.diode_drop_V;
        }
    }
    apply(plant, dc_link, load, v, share, dt_s);
}

/// Takes the edges that are due and says when the next thing happens.
double Bridge::next_event_s(double now_s, double to_s)
{
    double event_s = to_s;
    for (Leg &leg : legs_) {
        while (leg.next < leg.count &&
               leg.edges[static_cast<std::size_t>(leg.next)].time_s <= now_s + no_time_s) {
            const Edge &edge = leg.edges[static_cast<std::size_t>(leg.next++)];
            leg.high         = edge.high;
            leg.dead_until_s = edge.time_s + edge.dead_s;
            leg.held         = false;
        }
        if (leg.next < leg.count) {
            event_s = std::min(event_s, leg.edges[static_cast<std::size_t>(leg.next)].time_s);
        }
        if (leg.dead_until_s > now_s + no_time_s) {
            event_s = std::min(event_s, leg.dead_until_s);
        }
    }
    return event_s;
}

/// The terminal voltage that keeps a phase current where it is, as far as the diodes let it.
double Bridge::hold_voltage_V(const Plant &plant, const std::array<double, 3> &v, int phase,
                              double vdc_V) const
{
    const auto            x    = static_cast<std::size_t>(phase);
    std::array<double, 3> low  = v;
    std::array<double, 3> high = v;
    low[x]                     = 0.0;
    high[x]                    = vdc_V;
    const double at_low        = phases_of(plant.phase_current_rate_Aps(stator_of(low)))[x];
    const double at_high       = phases_of(plant.phase_current_rate_Aps(stator_of(high)))[x];
    return std::clamp(-at_low / (at_high - at_low) * vdc_V, -settings_.diode_drop_V,
                      vdc_V + settings_.diode_drop_V);
}

void Bridge::advance_switched(Plant &plant, DcLink &dc_link, const ShaftLoad &load, double now_s,
                              double dt_s)
{
    double left_s = dt_s;
    // Each pass but the last ends at a phase current's zero: at most one per leg.
    for (int pass = 0; pass < 4 && left_s > no_time_s; pass++) {
        const double                vdc_V = dc_link.voltage_V();
        const std::array<double, 3> i     = phases_of(plant.phase_current_A());
        std::array<double, 3>       v{};
        std::array<double, 3>       share{};
        std::array<bool, 3>         off{};
        bool                        any_off  = false;
        bool                        any_held = false;
        for (std::size_t x = 0; x < 3; x++) {
            const Leg &leg = legs_[x];
            const bool out = i[x] >= 0.0;
            off[x]         = !enabled_[x] || leg.dead_until_s > now_s + no_time_s;
            any_off        = any_off || off[x];
            any_held       = any_held || (off[x] && leg.held);
            const bool top = off[x] ? !out : leg.high;
            // Outwards the upper switch or the lower diode carries the current, inwards the others.
            const double drop =
                !off[x] && top == out ? settings_.switch_drop_V : settings_.diode_drop_V;
            share[x] = top ? 1.0 : 0.0;
            v[x]     = share[x] * vdc_V - (out ? drop : -drop);
        }
        for (std::size_t x = 0; any_held && x < 3; x++) {
            if (off[x] && legs_[x].held) {
                v[x]     = hold_voltage_V(plant, v, static_cast<int>(x), vdc_V);
                share[x] = 0.0;
            }
        }
        if (!any_off) {
            apply(plant, dc_link, load, v, share, left_s);
            return;
        }
        // When does a current that a diode carries die out? Over a dead time it is a straight line.
        const std::array<double, 3> rate    = phases_of(plant.phase_current_rate_Aps(stator_of(v)));
        double                      piece_s = left_s;
        int                         dying   = -1;
        for (std::size_t x = 0; x < 3; x++) {
            if (off[x] && !legs_[x].held && i[x] * rate[x] <= 0.0 &&
                std::abs(i[x]) < std::abs(rate[x]) * piece_s) {
                piece_s = std::abs(i[x] / rate[x]);
                dying   = static_cast<int>(x);
            }
        }
        if (piece_s > 0.0) {
            apply(plant, dc_link, load, v, share, piece_s);
        }
        left_s -= piece_s;
        if (dying >= 0) {
            legs_[static_cast<std::size_t>(dying)].held = true;
        }
    }
}

} // namespace sdre
