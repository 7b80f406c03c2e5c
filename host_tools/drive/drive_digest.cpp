// SPDX-License-Identifier: MIT
#include <cstdint>

#include <fmt/format.h>

#include "drive/drive_file.hpp"

namespace sdre {
namespace {

template <typename Numbers> std::string listed(const Numbers &numbers)
{
    std::string s;
    for (double x : numbers) {
        s += fmt::format("{:.17g};", x);
    }
    return s;
}

std::string normalised_weights(const Drive &d)
{
    std::string s = fmt::format("nosc;{};", d.nosc.order) + listed(d.nosc.Q) + listed(d.nosc.T) +
                    fmt::format("nodo;{};{};", nodo_form_name(d.nodo.form), d.nodo.order) +
                    listed(d.nodo.Q) + listed(d.nodo.T);
    if (d.position) {
        s += "position;" + listed(d.position->Q) + listed(d.position->T);
    }
    return s;
}

std::string normalised_harmonics(const Drive &d)
{
    const HarmonicSpec &h = d.harmonics;
    std::string         s = fmt::format("{};", law_name(d.law));
    for (const auto *orders : {&h.sensor, &h.voltage, &h.cogging}) {
        s += listed(*orders) + "|";
    }
    return s + fmt::format("{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{};",
                           h.sensor_weight, h.voltage_weight, h.cogging_weight,
                           h.cogging_voltage_weight, h.slope_weight, h.weight_speed_e_radps,
                           h.leak_1ps, d.motor.slots);
}

std::string normalised_servo(const Drive &d)
{
    const DobcSpec &o = d.dobc;
    std::string     s = fmt::format("{};{:.17g};{:.17g};", law_name(d.law),
                                    d.d_axis.proportional_V_per_A, d.d_axis.integral_V_per_As);
    if (d.law == Law::pid) {
        return s + fmt::format("{:.17g};{:.17g};{:.17g};", d.pid.proportional_Vs_per_rad,
                               d.pid.integral_V_per_rad, d.pid.derivative_Vs2_per_rad);
    }
    s += fmt::format("{};{};{:.17g};{:.17g};{:.17g};{:.17g};",
                     o.preset == DobcPreset::printed ? "printed" : "repaired", o.polynomial_order,
                     o.design_speed_e_radps, o.controller_pole_1ps, o.observer_pole_1ps,
                     o.oscillator_damping_1ps);
    return s + listed(o.harmonics_per_turn);
}

std::string normalised_cascade(const Drive &d)
{
    const CascadeSpec &c = d.cascade;
    return fmt::format("{};{:.17g};{:.17g};{:.17g};{:.17g};", law_name(d.law),
                       c.current_bandwidth_Hz, c.symmetrical_optimum_a, c.controller_radps,
                       c.observer_radps);
}

std::string normalised_sensors(const Drive &d)
{
    const CurrentSensors   &s = d.current_sensors;
    const BoardDescription &b = d.board;
    std::string text = fmt::format("{:.17g};{:.17g};{};{:.17g};{:.17g};", s.range_A, s.noise_rms_A,
                                   s.adc_bits, d.encoder.index_angle_e_rad, b.dc_link_range_V);
    text +=
        fmt::format("{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};", b.ntc_resistance_Ohm, b.ntc_beta_K,
                    b.ntc_divider_Ohm, b.temperature_limit_degC, b.temperature_trip_degC);
    text += fmt::format("{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};", b.align_current_A.value_or(0.0),
                        b.motor_current_A.value_or(0.0), b.motor_time_constant_s,
                        b.inverter_current_A, b.inverter_time_constant_s);
    return text + fmt::format("{};{:.17g};{:.17g};{:.17g};", stop_reaction_name(b.stop),
                              b.precharge_s, b.duty_max, b.pulse_min_s);
}

std::string normalised(const Drive &d)
{
    const Motor    &m = d.motor;
    const Inverter &i = d.inverter;
    std::string     s = fmt::format("schema={};name={};", drive_schema, d.name);
    s += fmt::format("{};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};",
                     m.pole_pairs, m.stator_resistance_Ohm, m.d_axis_inductance_H,
                     m.q_axis_inductance_H, m.pm_flux_Wb, m.inertia_kgm2, m.viscous_friction_Nms,
                     m.rated_speed_e_radps, m.rated_torque_Nm, m.max_current_A);
    s += fmt::format("{:.17g};{:.17g};{:.17g};{};{};", i.dc_link_V, i.pwm_frequency_Hz,
                     i.dead_time_s, i.updates_per_period, d.encoder.lines);
    s += i.dead_time_compensation ? "compensated;" : "uncompensated;";
    s += i.overmodulation ? "hexagon;" : "circle;";
    s += i.regeneration != DcLinkSink::none ? fmt::format("{};", dc_link_sink_name(i.regeneration))
                                            : "";
    s += d.encoder.edge_times ? "edges;" : "";
    s += normalised_sensors(d);
    s += m.max_speed_e_radps > 0.0 ? fmt::format("{:.17g};", m.max_speed_e_radps) : "";
    if (d.law == Law::noc_h) {
        return s + normalised_weights(d) + normalised_harmonics(d);
    }
    if (is_cascade(d.law)) {
        return s + normalised_cascade(d);
    }
    return s + (is_near_optimal(d.law) ? normalised_weights(d) : normalised_servo(d));
}

} // namespace

std::string drive_digest(const Drive &drive)
{
    std::uint64_t hash = 0xcbf29ce484222325ULL; // FNV-1a, 64 bit
    for (char c : normalised(drive)) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    }
    return fmt::format("fnv1a64:{:016x}", hash);
}

} // namespace sdre
