// SPDX-License-Identifier: MIT
#include "design/machine_points.hpp"

#include <algorithm>
#include <cmath>

#include "design/laws/near_optimal.hpp"
#include "design/motor_model.hpp"
#include "design/sampled_model.hpp"
#include "design/trip_levels.hpp"

namespace sdre {
namespace {

constexpr int steps = 4000; // of the d current: the torque is then good to a thousandth

MachinePoint point(const Motor &m, double id_A, double iq_A, double speed)
{
    const double T = torque_Nm(m, id_A, iq_A);
    return {speed, id_A, iq_A, T, steady_voltage_V(m, id_A, iq_A, speed), T * speed / m.pole_pairs};
}

/// The largest speed at which these currents need no more than the circle.
double base_speed(const Motor &m, double id_A, double iq_A, double circle_V, double most)
{
    double lo = 0.0;
    double hi = most;
    for (int i = 0; i < 60; i++) {
        const double w                                            = 0.5 * (lo + hi);
        (steady_voltage_V(m, id_A, iq_A, w) < circle_V ? lo : hi) = w;
    }
    return lo;
}

/// The largest q current that current limit and circle leave beside a d current; less than nothing: none.
double room_A(const Motor &m, double id_A, double speed, double circle_V)
{
    const double by_limit =
        std::sqrt(std::max(m.max_current_A * m.max_current_A - id_A * id_A, 0.0));
    if (steady_voltage_V(m, id_A, 0.0, speed) > circle_V) {
        return -1.0;
    }
    double lo = 0.0;
    double hi = by_limit;
    for (int i = 0; i < 40; i++) {
        const double iq_A                                              = 0.5 * (lo + hi);
        (steady_voltage_V(m, id_A, iq_A, speed) <= circle_V ? lo : hi) = iq_A;
    }
    return steady_voltage_V(m, id_A, by_limit, speed) <= circle_V ? by_limit : lo;
}

} // namespace

double steady_voltage_V(const Motor &m, double id_A, double iq_A, double w)
{
    return std::hypot(m.stator_resistance_Ohm * iq_A +
                          w * (m.d_axis_inductance_H * id_A + m.pm_flux_Wb),
                      m.stator_resistance_Ohm * id_A - w * m.q_axis_inductance_H * iq_A);
}

MachinePoint most_torque(const Motor &m, double speed, double circle_V)
{
    MachinePoint best{speed, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i <= steps; i++) {
        const double id_A = -m.max_current_A * i / steps;
        const double iq_A = room_A(m, id_A, speed, circle_V);
        if (iq_A > 0.0 && torque_Nm(m, id_A, iq_A) > best.torque_Nm) {
            best = point(m, id_A, iq_A, speed);
        }
    }
    return best;
}

MachinePoint limit_point(const Drive &d)
{
    const Motor &m        = d.motor;
    const auto   l        = reduced_parameters(m);
    const double circle_V = d.inverter.dc_link_V / std::sqrt(3.0);
    const double iq_A     = largest_iq_A(m, l);
    const double id_A     = mtpa_id_A(l, iq_A);
    const double highest  = 10.0 * largest_command_e_radps(d);
    return point(m, id_A, iq_A, base_speed(m, id_A, iq_A, circle_V, highest));
}

MachinePoints machine_points(const Drive &d)
{
    const Motor            &m       = d.motor;
    const ReducedParameters l       = reduced_parameters(m);
    const double            largest = largest_command_e_radps(d);
    MachinePoints           out{};
    out.circle_V              = d.inverter.dc_link_V / std::sqrt(3.0);
    out.emf_V                 = std::sqrt(3.0) * m.pm_flux_Wb * largest;
    out.current_for_no_flux_A = m.pm_flux_Wb / m.d_axis_inductance_H;
    const double rated_iq_A   = mtpa_iq_A(m, l, m.rated_torque_Nm, m.max_current_A);
    const double rated_id_A   = mtpa_id_A(l, rated_iq_A);
    out.rated =
        point(m, rated_id_A, rated_iq_A,
              std::min(m.rated_speed_e_radps,
                       base_speed(m, rated_id_A, rated_iq_A, out.circle_V, m.rated_speed_e_radps)));
    out.limit   = limit_point(d);
    out.fastest = most_torque(m, largest, out.circle_V);
    out.mtpv    = std::hypot(out.fastest.id_A, out.fastest.iq_A) < 0.999 * m.max_current_A;
    return out;
}

} // namespace sdre
