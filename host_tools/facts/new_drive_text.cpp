// SPDX-License-Identifier: MIT
#include "facts/new_drive_text.hpp"

#include <cmath>

#include <fmt/format.h>

#include "drive/drive_file.hpp"
#include "tune/start_weights.hpp"

namespace sdre {
namespace {

/// Six digits, as a data sheet never has them.
std::string line(const char *key, const Value &v, double si)
{
    std::string number = fmt::format("{:.6g}", si);
    if (number.find_first_of(".e") == std::string::npos) {
        number += ".0";
    }
    return fmt::format("{:<21} = {:<12} # {}\n", key, number, v.origin);
}

std::string line(const char *key, const Value &v)
{
    return line(key, v, v.si);
}

std::string whole(const char *key, const Value &v)
{
    return fmt::format("{:<21} = {:<12} # {}\n", key, static_cast<long>(std::lround(v.si)),
                       v.origin);
}

std::string motor_text(const Machine &m)
{
    const double pairs = m.pole_pairs.si;
    std::string  s =
        "[motor]\n" + whole("pole_pairs", m.pole_pairs) +
        line("stator_resistance_Ohm", m.resistance_Ohm) + line("d_axis_inductance_H", m.ld_H) +
        line("q_axis_inductance_H", m.lq_H) + line("pm_flux_Wb", m.flux_Wb) +
        line("inertia_kgm2", m.inertia_kgm2) + line("viscous_friction_Nms", m.friction_Nms) +
        line("rated_speed_e_radps", m.rated_speed_radps, pairs * m.rated_speed_radps.si) +
        line("rated_torque_Nm", m.rated_torque_Nm) + line("max_current_A", m.max_current_A);
    if (m.max_speed_radps.si > 0.0) {
        s += line("max_speed_e_radps", m.max_speed_radps, pairs * m.max_speed_radps.si);
    }
    return m.slots.si > 0.0 ? s + whole("slots", m.slots) : s;
}

/// As it was wanted; beside it the one that runs.
std::string frequency(const Machine &m)
{
    Value v = m.pwm_Hz;
    if (v.si != m.pwm_wanted_Hz) {
        v.origin += fmt::format("; the counter's nearest is {:.7g}", v.si);
    }
    return line("pwm_frequency_Hz", v, m.pwm_wanted_Hz);
}

std::string inverter_text(const Machine &m)
{
    std::string s = "\n[inverter]\n" + line("dc_link_V", m.dc_link_V) + frequency(m) +
                    line("dead_time_s", m.dead_time_s) +
                    whole("updates_per_period", m.updates_per_period) +
                    "overmodulation        = true         # transients may use the corners of the "
                    "hexagon\n";
    if (!m.regeneration.empty()) {
        s += fmt::format("regeneration          = \"{}\"\n", m.regeneration);
    }
    return s;
}

std::string board_text(const Machine &m)
{
    return m.board.empty() ? "" : fmt::format("\n[board]\nname = \"{}\"\n", m.board);
}

std::string sensors_text(const Machine &m)
{
    std::string s = "\n[encoder]\n" + whole("lines", m.lines) +
                    fmt::format("edge_times            = {}\n", m.edge_times);
    if (m.range_A.si <= 0.0 && m.noise_A.si <= 0.0 && m.adc_bits.si <= 0.0) {
        return s;
    }
    s += "\n[current_sensors]\n";
    s += m.range_A.si > 0.0 ? line("range_A", m.range_A) : "";
    s += m.noise_A.si > 0.0 ? line("noise_rms_A", m.noise_A) : "";
    return s + (m.adc_bits.si > 0.0 ? whole("adc_bits", m.adc_bits) : "");
}

Drive drive_of(const Machine &m)
{
    Drive d;
    d.name                        = m.name;
    d.motor.pole_pairs            = static_cast<int>(m.pole_pairs.si);
    d.motor.stator_resistance_Ohm = m.resistance_Ohm.si;
    d.motor.d_axis_inductance_H   = m.ld_H.si;
    d.motor.q_axis_inductance_H   = m.lq_H.si;
    d.motor.pm_flux_Wb            = m.flux_Wb.si;
    d.motor.inertia_kgm2          = m.inertia_kgm2.si;
    d.motor.viscous_friction_Nms  = m.friction_Nms.si;
    d.motor.rated_speed_e_radps   = m.pole_pairs.si * m.rated_speed_radps.si;
    d.motor.rated_torque_Nm       = m.rated_torque_Nm.si;
    d.motor.max_current_A         = m.max_current_A.si;
    d.inverter.dc_link_V          = m.dc_link_V.si;
    d.inverter.pwm_frequency_Hz   = m.pwm_Hz.si;
    d.inverter.dead_time_s        = m.dead_time_s.si;
    d.inverter.updates_per_period = static_cast<int>(m.updates_per_period.si);
    d.encoder.lines               = static_cast<int>(m.lines.si);
    d.encoder.edge_times          = m.edge_times;
    d.current_sensors             = default_current_sensors(d.motor);
    d.current_sensors.range_A     = m.range_A.si > 0.0 ? m.range_A.si : d.current_sensors.range_A;
    d.current_sensors.noise_rms_A =
        m.noise_A.si > 0.0 ? m.noise_A.si : d.current_sensors.noise_rms_A;
    return d;
}

} // namespace

std::string new_drive_text(const Machine &m)
{
    return fmt::format("# Written by `sdre-gains new`; every number with the fact that it comes "
                       "from. Weights: the start of `sdre-gains tune`.\n"
                       "schema = 1\nname = \"{}\"\n\n",
                       m.name) +
           motor_text(m) + inverter_text(m) + board_text(m) + sensors_text(m) + "\n" +
           start_sections(start_weights(drive_of(m)));
}

} // namespace sdre
