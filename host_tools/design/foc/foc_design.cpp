// SPDX-License-Identifier: MIT
#include "design/foc/foc_design.hpp"

#include <algorithm>
#include <cmath>

#include "design/laws/near_optimal.hpp"
#include "design/trip_levels.hpp"

namespace sdre {
namespace {

const double pi = std::acos(-1.0);

// Chosen: 5 % of the voltage circle stay free for the current loops.
constexpr double voltage_share = 0.95;
// Chosen by simulation of speed steps into flux weakening and of loads that drive: slower is worse in both.
constexpr double weakening_1ps = 300.0;
// Chosen: the speed has no alias up to the trip speed, with a tenth to spare.
constexpr double half_turn_share = 0.9;
// Chosen: with an edge in every period two of them are at most two periods apart.
constexpr double edge_gap_periods = 2.0;

foc_axis_t axis(double bandwidth_radps, double L_H, double R_Ohm, double ts_s)
{
    const double kp = bandwidth_radps * L_H; // EQ-FOC-7
    const double ki = bandwidth_radps * R_Ohm * ts_s;
    return {single(kp), single(ki), single(ki / kp)};
}

double bandwidth_radps(const Drive &d)
{
    return 2.0 * pi * d.cascade.current_bandwidth_Hz;
}

} // namespace

foc_config_t foc_constants(const Drive &d, const ReducedParameters &l)
{
    const Motor &m  = d.motor;
    const double ts = control_period_s(d);
    const double w  = bandwidth_radps(d);
    const double k  = mtpa_A(l);

    foc_config_t c{};
    c.d             = axis(w, m.d_axis_inductance_H, m.stator_resistance_Ohm, ts);
    c.q             = axis(w, m.q_axis_inductance_H, m.stator_resistance_Ohm, ts);
    c.current_max_A = single(m.max_current_A);
    c.iq_max_A      = single(largest_iq_A(m, k, true));
    c.mtpa_A        = single(k);
    // Beyond the current that cancels the magnet's flux, more of it raises the voltage again.
    c.id_min_A      = single(-std::min(m.max_current_A, m.pm_flux_Wb / m.d_axis_inductance_H));
    c.voltage_share = single(voltage_share);
    c.weakening_A_per_V =
        single(weakening_1ps * ts / (m.rated_speed_e_radps * m.d_axis_inductance_H));
    return c;
}

speed_difference_config_t speed_difference_constants(const Drive &d, double window_s)
{
    const double ts   = control_period_s(d);
    const double most = half_turn_share * pi / (trip_speed_e_radps(d) * ts);
    const double n    = std::min({std::round(window_s / ts), std::floor(most),
                                  static_cast<double>(SPEED_DIFFERENCE_PERIODS_MAX)});

    speed_difference_config_t c{};
    c.periods        = static_cast<int16_t>(std::max(n, 1.0));
    c.inv_span_1ps   = single(1.0 / (c.periods * ts));
    c.edge_gap_max_s = single(edge_gap_periods * ts);
    c.count_rad      = single(count_e_rad(d));
    return c;
}

speed_observer_gains_t speed_observer_gains(double pole_1ps, double ts_s)
{
    const double beta = std::exp(-pole_1ps * ts_s);
    return {single(1.0 - beta * beta), single((1.0 - beta) * (1.0 - beta) / ts_s)};
}

int speed_periods(const Drive &d, const speed_difference_config_t &c, speed_difference_mode_t mode)
{
    return mode == SPEED_DIFFERENCE_TIMED && d.encoder.edge_times ? 1 : c.periods;
}

double small_time_s(const Drive &d, const speed_difference_config_t &c,
                    speed_difference_mode_t mode)
{
    const double window_s = control_period_s(d) * speed_periods(d, c, mode);
    return 1.0 / bandwidth_radps(d) + 0.5 * window_s; // EQ-FOC-8
}

} // namespace sdre
