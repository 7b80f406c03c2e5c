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

// Each structure is taken apart into all of its members. A new member does not compile until it is
// named here, above the text that it belongs to.

std::string normalised_nosc(const NoscSpec &spec)
{
    const auto &[order, Q, T] = spec;
    return fmt::format("nosc;{};", order) + listed(Q) + listed(T);
}

std::string normalised_nodo(const NodoSpec &spec)
{
    const auto &[form, order, Q, T] = spec;
    return fmt::format("nodo;{};{};", nodo_form_name(form), order) + listed(Q) + listed(T);
}

std::string normalised_position(const PositionSpec &spec)
{
    const auto &[Q, T] = spec;
    return "position;" + listed(Q) + listed(T);
}

std::string normalised_torque(const TorqueSpec &spec)
{
    const auto &[weights] = spec;
    return "torque;" + (weights ? listed(weights->Q) + listed(weights->T) : "");
}

std::string normalised_weights(const Drive &d)
{
    return normalised_nosc(d.nosc) + normalised_nodo(d.nodo) +
           (d.position ? normalised_position(*d.position) : "") +
           (d.torque ? normalised_torque(*d.torque) : "");
}

std::string normalised_harmonics(const HarmonicSpec &spec, int slots)
{
    const auto &[sensor, voltage, cogging, sensor_weight, voltage_weight, cogging_weight,
                 cogging_voltage_weight, slope_weight, weight_speed_e_radps, leak_1ps] = spec;
    return listed(sensor) + "|" + listed(voltage) + "|" + listed(cogging) + "|" +
           fmt::format("{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{};", sensor_weight,
                       voltage_weight, cogging_weight, cogging_voltage_weight, slope_weight,
                       weight_speed_e_radps, leak_1ps, slots);
}

std::string normalised_shaft(const ShaftSpec &spec, const Mechanics &m)
{
    const auto &[Q, nodo_Q] = spec;
    return listed(Q) + "|" + listed(nodo_Q) + "|" +
           fmt::format("{:.17g};{:.17g};{:.17g};", m.resonance_Hz, m.least_damping,
                       m.load_inertia_share);
}

std::string normalised_d_axis(const DAxisSpec &spec)
{
    const auto &[proportional, integral] = spec;
    return fmt::format("{:.17g};{:.17g};", proportional, integral);
}

std::string normalised_pid(const PidSpec &spec)
{
    const auto &[proportional, integral, derivative] = spec;
    return fmt::format("{:.17g};{:.17g};{:.17g};", proportional, integral, derivative);
}

std::string normalised_dobc(const DobcSpec &spec)
{
    const auto &[preset, polynomial_order, harmonics_per_turn, design_speed, controller_pole,
                 observer_pole, oscillator_damping] = spec;
    return fmt::format("{};{};{:.17g};{:.17g};{:.17g};{:.17g};",
                       preset == DobcPreset::printed ? "printed" : "repaired", polynomial_order,
                       design_speed, controller_pole, observer_pole, oscillator_damping) +
           listed(harmonics_per_turn);
}

std::string normalised_cascade(const CascadeSpec &spec)
{
    const auto &[bandwidth, optimum_a, controller, observer, load_observer] = spec;
    return fmt::format("{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};", bandwidth, optimum_a, controller,
                       observer, load_observer);
}

/// The sections that the law reads.
std::string normalised_law(const Drive &d)
{
    const std::string name = fmt::format("{};", law_name(d.law));
    if (d.law == Law::noc_h) {
        return normalised_weights(d) + name + normalised_harmonics(d.harmonics, d.motor.slots);
    }
    if (d.law == Law::noc_shaft) {
        return normalised_weights(d) + name + normalised_shaft(d.shaft, d.mechanics);
    }
    if (d.law == Law::noc_iron) {
        return normalised_weights(d) + name;
    }
    if (is_near_optimal(d.law)) {
        return normalised_weights(d);
    }
    if (is_cascade(d.law)) {
        return name + normalised_cascade(d.cascade);
    }
    return name + normalised_d_axis(d.d_axis) +
           (d.law == Law::pid ? normalised_pid(d.pid) : normalised_dobc(d.dobc));
}

std::string normalised_motor(const Motor &motor)
{
    const auto &[pole_pairs, resistance, ld, lq, flux, inertia, friction, rated_speed, rated_torque,
                 max_current, max_speed, slots, mtpa] = motor;
    static_cast<void>(mtpa);      // of the map
    static_cast<void>(max_speed); // at the end, and only when the file has it
    static_cast<void>(slots);     // for noc_h's harmonics
    return fmt::format(
        "{};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};", pole_pairs,
        resistance, ld, lq, flux, inertia, friction, rated_speed, rated_torque, max_current);
}

std::string normalised_saturation(const FluxMap &map)
{
    std::string s = "saturation;" + listed(map.id_A()) + listed(map.iq_A());
    for (const double id_A : map.id_A()) {
        for (const double iq_A : map.iq_A()) {
            const FluxAt f = map.at(id_A, iq_A);
            s += fmt::format("{:.9g};{:.9g};", f.d_Wb,
                             f.q_Wb); // nodes of a cubic, less its rounding
        }
    }
    return s;
}

std::string normalised_hardware(const Inverter &inverter, const Encoder &encoder)
{
    const auto &[dc_link, pwm, pwm_wanted, dead_time, updates, compensation, overmodulation,
                 regeneration]                         = inverter;
    const auto &[lines, edge_times, index_angle, disc] = encoder;
    static_cast<void>(disc);        // no table depends on it
    static_cast<void>(pwm_wanted);  // everything is designed for the one that the counter has
    static_cast<void>(index_angle); // beside the sensors
    std::string s =
        fmt::format("{:.17g};{:.17g};{:.17g};{};{};", dc_link, pwm, dead_time, updates, lines);
    s += compensation ? "compensated;" : "uncompensated;";
    s += overmodulation ? "hexagon;" : "circle;";
    s +=
        regeneration != DcLinkSink::none ? fmt::format("{};", dc_link_sink_name(regeneration)) : "";
    return s + (edge_times ? "edges;" : "");
}

std::string normalised_sensors(const CurrentSensors &sensors, double index_angle)
{
    const auto &[range, noise, bits, count] = sensors;
    return fmt::format("{:.17g};{:.17g};{};{:.17g};", range, noise, bits, index_angle) +
           (count == 3 ? "three sensors;" : "");
}

std::string normalised_board(const BoardDescription &board)
{
    // The board file has a sum of its own (board_identity.h).
    const auto &[file, dc_link_range, ntc, ntc_beta, ntc_divider, limit, trip, align, motor,
                 motor_time_constant, inverter, inverter_time_constant, stop, precharge, duty_max,
                 pulse_min] = board;
    std::string s = fmt::format("{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};", dc_link_range,
                                ntc, ntc_beta, ntc_divider, limit, trip);
    s += fmt::format("{:.17g};{:.17g};{:.17g};{:.17g};{:.17g};", align.value_or(0.0),
                     motor.value_or(0.0), motor_time_constant, inverter, inverter_time_constant);
    return s + fmt::format("{};{:.17g};{:.17g};{:.17g};", stop_reaction_name(stop), precharge,
                           duty_max, pulse_min);
}

std::string normalised(const Drive &drive)
{
    // reproduces changes no number
    const auto &[name, reproduces, motor, saturation, inverter, encoder, current_sensors, board,
                 law, nosc, nodo, position, torque, harmonics, shaft, dobc, pid, d_axis, cascade,
                 uncertainty, mechanics] = drive;
    static_cast<void>(uncertainty); // of the machine, not of what is computed from the file
    static_cast<void>(mechanics);   // beside the weights of noc_shaft
    std::string s = fmt::format("schema={};name={};", drive_schema, name);
    s += normalised_motor(motor) + normalised_hardware(inverter, encoder);
    s += normalised_sensors(current_sensors, encoder.index_angle_e_rad) + normalised_board(board);
    s += saturation ? normalised_saturation(*saturation) : "";
    s += motor.max_speed_e_radps > 0.0 ? fmt::format("{:.17g};", motor.max_speed_e_radps) : "";
    return s + normalised_law(drive);
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
