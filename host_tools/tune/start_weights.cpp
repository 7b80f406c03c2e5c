// SPDX-License-Identifier: MIT
#include "tune/start_weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "design/law_design.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/motor_model.hpp"
#include "design/sampled_model.hpp"
#include "tune/objective.hpp"

namespace sdre {
namespace {

// The weights of ipmsm_390w.toml in motor_units() with pace 1.
constexpr double speed_weight      = 1.73e-2;
constexpr double q_current_weight  = 1.90e-5;
constexpr double d_current_weight  = 0.99;
constexpr double voltage_weight    = 29.0;
constexpr double load_drift        = 6.0e-2;
constexpr double voltage_drift     = 5.7e-5;
constexpr double speed_noise       = 0.13;
constexpr double current_noise     = 3.7e-3;
constexpr double angle_error_units = 0.38;
// Chosen: those of the speed for the load's; a twist hardly weighs.
constexpr double slip_weight      = speed_weight;
constexpr double twist_weight     = 1e-6;
constexpr double load_speed_noise = speed_noise;
constexpr double twist_noise      = 1e-6;

// Chosen: of nine, the starts whose searches end in the best certified weights at 80, 220 and 400 Hz, and of four with saturated iron.
struct PlantStart {
    double pace; ///< relative to that of the sensors
    double slip; ///< factor on the weight of the slip
};
constexpr std::array shaft_starts{PlantStart{0.8, 0.1}, PlantStart{0.8, 1.0}, PlantStart{1.3, 0.1}};
constexpr std::array iron_starts{PlantStart{0.5, 1.0}, PlantStart{1.0, 1.0}};

// Edges that differ from their learned places, and the error of the learning. On a real disc the
// noise of v_q is then that of the linear model, on every motor of docs/motors.md: 0.025 counts.
constexpr double edge_error_per_own = 1.25;
// Chosen: time resolution and vibration; a perfect disc needs finite weights too.
constexpr double least_edge_error_cnt = 0.005;

// Chosen: the standard deviation that stands for an edge in n periods is n^(4/3) that of an edge. The density of the noise would
// be n^(1/2). The rest makes the loops slower with n, as the sampled model has no edge that comes late.
constexpr double rare_edges_exponent = 4.0 / 3.0;

/// Acceleration per ampere, with the reluctance torque of the largest current.
double accel_per_A(const Drive &d, const ReducedParameters &l)
{
    const double iq_A = largest_iq_A(d.motor, l);
    return l[3] * torque_Nm(d.motor, mtpa_id_A(l, iq_A), iq_A) / d.motor.max_current_A;
}

} // namespace

MotorUnits motor_units(const Drive &d, double pace)
{
    const ReducedParameters l = reduced_parameters(d.motor);
    MotorUnits              u{};
    u.time_s        = pace * control_period_s(d);
    u.voltage_V     = d.inverter.dc_link_V / std::sqrt(3.0);
    u.current_A     = u.voltage_V * u.time_s / d.motor.q_axis_inductance_H;
    u.speed_e_radps = accel_per_A(d, l) * u.current_A * u.time_s;
    return u;
}

double periods_per_edge(const Drive &d)
{
    const double turned_rad = 0.5 * d.motor.rated_speed_e_radps * control_period_s(d);
    return std::max(1.0, count_e_rad(d) / turned_rad);
}

SampleNoise sample_noise(const Drive &d)
{
    const CurrentSensors &s     = d.current_sensors;
    const double          lsb_A = 2.0 * s.range_A / std::exp2(s.adc_bits);
    const double          whole = 1.0 / std::sqrt(12.0); // standard deviation of a rounded number
    const double          own =
        std::max(edge_error_per_own * d.encoder.disc.own_rms_cnt, least_edge_error_cnt);
    const double edge = count_e_rad(d) * (d.encoder.edge_times ? own : whole);
    return {std::hypot(s.noise_rms_A, lsb_A * whole),
            edge * std::pow(periods_per_edge(d), rare_edges_exponent)};
}

double pace_of_sensors(const Drive &d)
{
    const MotorUnits u     = motor_units(d, 1.0);
    const double     units = sample_noise(d).angle_rad / (u.speed_e_radps * u.time_s);
    return std::max(1.0, std::cbrt(units / angle_error_units)); // an angle unit grows with pace^3
}

Drive start_weights(Drive d, double pace)
{
    const MotorUnits  u          = motor_units(d, pace);
    const SampleNoise n          = sample_noise(d);
    const double      ts         = control_period_s(d);
    const auto        per_square = [](double weight, double unit) {
        return written(weight / (unit * unit));
    };
    const auto drift = [&](double weight, double unit) {
        return written(weight * unit * unit / u.time_s);
    };
    const double t_voltage = per_square(voltage_weight, u.voltage_V);
    const double d_iq      = drift(voltage_drift, u.current_A / u.time_s);
    const double i         = drift(current_noise, u.current_A);
    const double t_current = written(n.current_A * n.current_A * ts);

    if (!law_design(d).loop) {
        d.law = Law::noc;
    }
    d.nosc.order       = 2;
    d.nosc.Q           = {per_square(speed_weight, u.speed_e_radps),
                          per_square(q_current_weight, u.current_A),
                          per_square(d_current_weight, u.current_A)};
    d.nosc.T           = {t_voltage, t_voltage};
    d.nodo.form        = NodoForm::encoder;
    d.nodo.order       = 1;
    d.nodo.Q           = {drift(load_drift, u.speed_e_radps / u.time_s),
                          d_iq,
                          d_iq,
                          drift(speed_noise, u.speed_e_radps),
                          i,
                          i,
                          0.0};
    d.nodo.T           = {t_current, t_current, written(n.angle_rad * n.angle_rad * ts)};
    const double twist = u.speed_e_radps * u.time_s;
    d.shaft.Q      = {per_square(slip_weight, u.speed_e_radps), per_square(twist_weight, twist)};
    d.shaft.nodo_Q = {drift(load_speed_noise, u.speed_e_radps), drift(twist_noise, twist)};
    return d;
}

Drive start_weights(const Drive &d)
{
    return start_weights(d, pace_of_sensors(d));
}

bool has_own_plant(const Drive &d)
{
    const LawDesign &law = law_design(d);
    return law.shaft_states || (law.loop && law.loop->believe != nullptr);
}

std::vector<Drive> own_plant_starts(const Drive &d)
{
    std::vector<Drive> starts;
    const auto         add = [&](const PlantStart &s) {
        starts.push_back(start_weights(d, s.pace * pace_of_sensors(d)));
        starts.back().shaft.Q[0] = written(s.slip * starts.back().shaft.Q[0]);
    };
    if (law_design(d).shaft_states) {
        std::for_each(shaft_starts.begin(), shaft_starts.end(), add);
    } else {
        std::for_each(iron_starts.begin(), iron_starts.end(), add);
    }
    return starts;
}

std::string start_sections(const Drive &d)
{
    return fmt::format(
        "[nosc]\norder = {}\nQ = [{:.3g}, {:.3g}, {:.3g}] # speed, i_q, i_d\nT = [{:.3g}, {:.3g}] "
        "# v_q, v_d\n\n"
        "[nodo]\nform = \"encoder\"\norder = {}\n"
        "# drift of d_w, d_q, d_d; noise of w, i_q, i_d; theta' = w is exact: 0\n"
        "Q = [{:.3g}, {:.3g}, {:.3g}, {:.3g}, {:.3g}, {:.3g}, 0.0]\n"
        "T = [{:.3g}, {:.3g}, {:.3g}] # variance x period of a sample: currents, angle\n",
        d.nosc.order, d.nosc.Q[0], d.nosc.Q[1], d.nosc.Q[2], d.nosc.T[0], d.nosc.T[1], d.nodo.order,
        d.nodo.Q[0], d.nodo.Q[1], d.nodo.Q[2], d.nodo.Q[3], d.nodo.Q[4], d.nodo.Q[5], d.nodo.T[0],
        d.nodo.T[1], d.nodo.T[2]);
}

} // namespace sdre
