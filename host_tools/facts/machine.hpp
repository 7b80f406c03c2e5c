// SPDX-License-Identifier: MIT
/// A machine with its inverter and sensors in SI units, from its data sheet.
#pragma once

#include <string>
#include <vector>

#include "facts/fact_keys.hpp"

namespace sdre {

/// A number and where it comes from: "line_to_line_resistance_Ohm = 3.72", or "chosen: ..".
struct Value {
    double      si = 0.0;
    std::string origin;
};

/// Peak values of a phase; speeds of the shaft.
struct Machine {
    std::string name;
    Value       pole_pairs;
    Value       resistance_Ohm;
    Value       ld_H;
    Value       lq_H;
    Value       flux_Wb;
    Value       inertia_kgm2;
    Value       friction_Nms;
    Value       rated_speed_radps;
    Value       max_speed_radps; ///< 0: not given
    Value       rated_torque_Nm;
    Value       max_current_A;
    Value       dc_link_V;
    Value       pwm_Hz; ///< that the counter has
    double      pwm_wanted_Hz = 0.0;
    Value       updates_per_period;
    Value       dead_time_s;
    Value       lines;
    Value       range_A; ///< 0: not given, as the next three
    Value       noise_A;
    Value       adc_bits;
    Value       slots;
    std::string regeneration;
    std::string board; ///< name of its file, "": none
    bool        edge_times = true;
};

/// Contradictions and assumptions; one line each.
struct Findings {
    std::vector<std::string> contradictions;
    std::vector<std::string> notes;
};

/// InputError when something is missing that nothing stands in for.
Machine machine_of(const Facts &facts, const std::string &default_name, Findings &findings);

/// Peak flux of a phase from a fact about flux, EMF or torque per current.
double flux_of(const Fact &fact, double pole_pairs);
/// Peak of the phase current.
double peak_A(const Fact &fact);
/// "; the factor is near 1.41: rms and peak?" for a classic mistake, else "".
std::string usual_mistake(double ratio);

/// Largest torque at this peak current, and the smallest voltage (peak of a phase) that turns it.
double mtpa_torque_Nm(const Machine &m, double current_A);
double needed_voltage_V(const Machine &m, double torque_Nm, double speed_radps);

} // namespace sdre
