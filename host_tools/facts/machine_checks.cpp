// SPDX-License-Identifier: MIT
#include <cmath>

#include <fmt/format.h>

#include "facts/cross_checks.hpp"

namespace sdre {
namespace {

const double pi = std::acos(-1.0);

// Chosen: voltage that the motor needs at its rating, over what the dc link gives. Weak field and rounding on one side; a
// motor of a much higher voltage on the other.
constexpr double most_voltage  = 1.35;
constexpr double low_voltage   = 0.4;
constexpr double least_voltage = 0.12;
// Chosen: time from rest to the rated speed with the rated torque. Direct drives with small rotors take some ms, pumps and
// flywheels many seconds.
constexpr double least_start_s = 1e-3;
constexpr double long_start_s  = 20.0;
constexpr double most_start_s  = 100.0;
// Chosen: current that a period at full voltage adds, over the limit. One-step limits hold it below 1.
constexpr double quick_slope = 0.5;
constexpr double most_slope  = 2.0;
// Chosen: L / R grows with the square of a machine's size. A small outrunner has 0.1 ms, a machine of 100 kW some 60 ms.
constexpr double most_winding_s = 0.5;
// Chosen: the angle of commutation is not known better than a count.
constexpr double most_count_rad = 0.2;
// Chosen: flux of the q axis at the largest current over what the rated voltage carries at the rated speed.
constexpr double saturated_ratio = 1.5;

double r_min(double radps)
{
    return 30.0 / pi * radps;
}

void check_voltage(const Machine &m, Findings &out)
{
    const double      circle_V = m.dc_link_V.si / std::sqrt(3.0);
    const double      need_V   = needed_voltage_V(m, m.rated_torque_Nm.si, m.rated_speed_radps.si);
    const double      share    = need_V / circle_V;
    const std::string both     = fmt::format(
            "{} with {} ({:.4g} rad/s electrical) and {} needs {:.4g} V peak of a phase, {} gives "
                "{:.4g} V",
            m.rated_speed_radps.origin, m.pole_pairs.origin, m.pole_pairs.si * m.rated_speed_radps.si,
            m.flux_Wb.origin, need_V, m.dc_link_V.origin, circle_V);
    if (share > most_voltage || share < least_voltage) {
        out.contradictions.push_back(both +
                                     ": poles and pole pairs, r/min and rad/s, rms and peak?");
    } else if (share < low_voltage) {
        out.notes.push_back(both);
    }
    const double drop_V = m.resistance_Ohm.si * m.max_current_A.si;
    if (drop_V > circle_V) {
        out.contradictions.push_back(fmt::format("{} cannot flow through {}: {:.4g} V of {:.4g} V",
                                                 m.max_current_A.origin, m.resistance_Ohm.origin,
                                                 drop_V, circle_V));
    }
}

void check_speeds(const Machine &m, Findings &out)
{
    if (m.max_speed_radps.si > 0.0 && m.max_speed_radps.si < 0.999 * m.rated_speed_radps.si) {
        out.contradictions.push_back(
            fmt::format("{} is below {}: {:.4g} and {:.4g} r/min", m.max_speed_radps.origin,
                        m.rated_speed_radps.origin, r_min(m.max_speed_radps.si),
                        r_min(m.rated_speed_radps.si)));
    }
    const double      start_s = m.inertia_kgm2.si * m.rated_speed_radps.si / m.rated_torque_Nm.si;
    const std::string text =
        fmt::format("{} with {} takes {:.3g} s to {:.4g} r/min", m.inertia_kgm2.origin,
                    m.rated_torque_Nm.origin, start_s, r_min(m.rated_speed_radps.si));
    if (start_s < least_start_s || start_s > most_start_s) {
        out.contradictions.push_back(text + ": gcm2, kgcm2 and kgm2, or r/min and rad/s?");
    } else if (start_s > long_start_s) {
        out.notes.push_back(text);
    }
}

void check_period(const Machine &m, Findings &out)
{
    const double      ts_s    = 1.0 / (m.pwm_Hz.si * m.updates_per_period.si);
    const double      slope_A = m.dc_link_V.si / std::sqrt(3.0) * ts_s / m.ld_H.si;
    const double      slope   = slope_A / m.max_current_A.si;
    const std::string text =
        fmt::format("{} lets {} add {:.4g} A in a period of {:.4g} us, {} is the limit",
                    m.ld_H.origin, m.dc_link_V.origin, slope_A, 1e6 * ts_s, m.max_current_A.origin);
    if (slope > most_slope) {
        out.contradictions.push_back(text);
    } else if (slope > quick_slope) {
        out.notes.push_back(text + ": a higher PWM frequency would control it better");
    }
    if (m.dead_time_s.si * m.pwm_Hz.si > 0.1) {
        out.contradictions.push_back(fmt::format("{} is more than a tenth of the period of {}",
                                                 m.dead_time_s.origin, m.pwm_Hz.origin));
    }
    const double slow_s = m.lq_H.si / m.resistance_Ohm.si;
    if (slow_s > most_winding_s) {
        out.contradictions.push_back(
            fmt::format("{} and {}: L / R = {:.3g} s is above {:g} s: mH and H, or mOhm and Ohm?",
                        m.lq_H.origin, m.resistance_Ohm.origin, slow_s, most_winding_s));
    }
    const double tau_s = m.ld_H.si / m.resistance_Ohm.si;
    if (tau_s < 0.5 * ts_s) {
        out.contradictions.push_back(fmt::format("{} and {}: L / R = {:.3g} s is below half of a "
                                                 "period of {:.3g} s",
                                                 m.ld_H.origin, m.resistance_Ohm.origin, tau_s,
                                                 ts_s));
    }
}

void check_encoder(const Machine &m, Findings &out)
{
    const double count_e_rad = 2.0 * pi * m.pole_pairs.si / (4.0 * m.lines.si);
    if (count_e_rad > most_count_rad) {
        out.contradictions.push_back(
            fmt::format("{} with {}: a count is {:.2g} rad electrical, at most {:g} can be used",
                        m.lines.origin, m.pole_pairs.origin, count_e_rad, most_count_rad));
    }
    const double per_period = m.rated_speed_radps.si / (2.0 * pi) * 4.0 * m.lines.si /
                              (m.pwm_Hz.si * m.updates_per_period.si);
    if (per_period < 1.0) {
        out.notes.push_back(fmt::format("{}: {:.2g} counts a period at {:.4g} r/min, the speed is "
                                        "known late",
                                        m.lines.origin, per_period, r_min(m.rated_speed_radps.si)));
    }
}

void check_flux(const Machine &m, Findings &out)
{
    const double rated_Wb =
        m.dc_link_V.si / std::sqrt(3.0) / (m.pole_pairs.si * m.rated_speed_radps.si);
    const double q_Wb = m.lq_H.si * m.max_current_A.si;
    if (q_Wb > saturated_ratio * rated_Wb) {
        out.notes.push_back(fmt::format(
            "{} at {}: {:.3g} Wb, the dc link carries {:.3g} Wb at the rated speed; iron saturates "
            "before that, so that less torque comes",
            m.lq_H.origin, m.max_current_A.origin, q_Wb, rated_Wb));
    }
}

} // namespace

void check_machine(const Machine &m, Findings &findings)
{
    check_voltage(m, findings);
    check_speeds(m, findings);
    check_period(m, findings);
    check_encoder(m, findings);
    check_flux(m, findings);
}

} // namespace sdre
