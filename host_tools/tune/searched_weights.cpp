// SPDX-License-Identifier: MIT
#include "tune/searched_weights.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "design/law_design.hpp"

namespace sdre {
namespace {

// Chosen: the controller's weights have this unit, over the weight of a voltage.
constexpr double weight_unit = 1e3;

} // namespace

Sensors sensors_of(const Drive &drive, const TuneSpec &spec)
{
    return {std::hypot(spec.current_noise_A, spec.current_lsb_A / std::sqrt(12.0)),
            count_e_rad(drive) * spec.angle_error_cnt};
}

double written(double weight)
{
    return std::strtod(fmt::format("{:.3g}", weight).c_str(), nullptr);
}

std::vector<SearchedWeight> searched_weights(Drive &d)
{
    std::vector<SearchedWeight> all{{true, {&d.nosc.Q[0]}},  {true, {&d.nosc.Q[1]}},
                                    {false, {&d.nodo.Q[0]}}, {false, {&d.nodo.Q[1], &d.nodo.Q[2]}},
                                    {false, {&d.nodo.Q[3]}}, {false, {&d.nodo.Q[4], &d.nodo.Q[5]}}};
    if (law_design(d).shaft_states) {
        for (double &weight : d.shaft.Q) {
            all.push_back({true, {&weight}});
        }
        for (double &weight : d.shaft.nodo_Q) {
            all.push_back({false, {&weight}});
        }
    }
    return all;
}

Point point_of(Drive drive)
{
    Point x;
    for (const SearchedWeight &w : searched_weights(drive)) {
        const double unit = w.controller ? weight_unit * drive.nosc.T[0] : 1.0;
        x.push_back(std::log10(*w.values.front() / unit));
    }
    return x;
}

Drive with_weights(Drive drive, const TuneSpec &spec, const Point &x)
{
    const double  ts        = control_period_s(drive);
    const Sensors sensors   = sensors_of(drive, spec);
    const double  t_voltage = written(1.0 / (spec.voltage_V * spec.voltage_V));
    // A sampled sensor with standard deviation s is white noise of density s^2 Ts.
    const double t_current = written(sensors.current_A * sensors.current_A * ts);
    const double t_angle   = written(sensors.angle_rad * sensors.angle_rad * ts);

    drive.nosc.T    = {t_voltage, t_voltage};
    drive.nosc.Q[2] = written(1.0 / (spec.d_axis_error_A * spec.d_axis_error_A));
    drive.nodo.form = NodoForm::encoder;
    drive.nodo.T    = {t_current, t_current, t_angle};
    drive.nodo.Q.resize(7);
    drive.nodo.Q[6] = 0.0;
    std::size_t i   = 0;
    for (const SearchedWeight &w : searched_weights(drive)) {
        const double unit = w.controller ? weight_unit * t_voltage : 1.0;
        for (double *weight : w.values) {
            *weight = written(std::pow(10.0, x[i]) * unit);
        }
        i++;
    }
    return drive;
}

} // namespace sdre
