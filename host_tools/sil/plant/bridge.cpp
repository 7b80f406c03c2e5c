// SPDX-License-Identifier: MIT
#include "sil/plant/bridge.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

// Measured: at 850 rad/s two RK4 steps of 100 us stay within 5e-6 A of steps of 5 us.
constexpr double steps_per_period = 2.0;

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

void Bridge::begin_period(const bridge_t &output)
{
    const std::array<double, 3> asked{static_cast<double>(output.duty.a),
                                      static_cast<double>(output.duty.b),
                                      static_cast<double>(output.duty.c)};
    const Carrier               carrier = !timing_.half_periods ? Carrier::full
                                          : rising_half_        ? Carrier::rising_half
                                                                : Carrier::falling_half;
    rising_half_                        = !rising_half_;
    enabled_.fill(output.gate_enable);
    volt_seconds_ = {};
    for (std::size_t x = 0; x < 3; x++) {
        duty_[x] = std::clamp(asked[x], settings_.duty_min, settings_.duty_max);
        legs_[x].begin_period(timing_.period_s, dead_time_s_, dead_time_s_);
        if (settings_.model == InverterModel::switched) {
            legs_[x].plan_duty(duty_[x], timing_.period_s, carrier);
        }
    }
}

void Bridge::begin_period(const std::array<LegTiming, 3> &legs)
{
    volt_seconds_ = {};
    for (std::size_t x = 0; x < 3; x++) {
        duty_[x] = legs[x].duty;
        legs_[x].begin_period(timing_.period_s, legs[x].rise_delay_s, legs[x].fall_delay_s);
        legs_[x].plan(legs[x]);
    }
}

bool Bridge::switched() const
{
    const bool any_enabled = enabled_[0] || enabled_[1] || enabled_[2];
    return any_enabled && settings_.model == InverterModel::switched;
}

void Bridge::advance(Plant &plant, DcLink &dc_link, const ShaftLoad &load, double from_s,
                     double to_s)
{
    const Circuit circuit{plant, dc_link, load};
    const bool    edges     = switched();
    const double  longest_s = timing_.period_s / steps_per_period;
    double        now_s     = from_s;
    while (to_s - now_s > no_time_s) {
        const double event_s = edges ? next_event_s(now_s, to_s) : to_s;
        const double all_s   = event_s - now_s;
        // 1e-9: a step that is longest_s but for rounding.
        const double pieces =
            all_s <= longest_s ? 1.0 : std::max(1.0, std::ceil(all_s / longest_s - 1e-9));
        for (int n = 0; n < static_cast<int>(pieces); n++) {
            if (edges) {
                advance_switched(circuit, now_s, all_s / pieces);
            } else {
                advance_averaged(circuit, all_s / pieces);
            }
        }
        now_s = event_s;
    }
}

void Bridge::apply(const Circuit &c, const Terminals &t, double dt_s)
{
    for (std::size_t x = 0; x < 3; x++) {
        volt_seconds_[x] += t.v_V[x] * dt_s;
    }
    if (c.dc_link.stiff()) {
        c.plant.advance(clarke(t.v_V), c.load, dt_s);
        return;
    }
    const auto bridge_A = [&] {
        const PhaseVector i = c.plant.phase_current_A();
        return t.share[0] * i.a + t.share[1] * i.b + t.share[2] * i.c;
    };
    const double before_A = bridge_A();
    c.plant.advance(clarke(t.v_V), c.load, dt_s);
    c.dc_link.advance(0.5 * (before_A + bridge_A()), dt_s);
}

} // namespace sdre
