// SPDX-License-Identifier: MIT
#include "drive/drive_file.hpp"

#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/toml_reader.hpp"
#include "design/core_types.hpp"

namespace sdre {
namespace {

// Allowed values: wide enough for any drive from a model motor to a locomotive, narrow enough that a
// slipped unit (mH, rpm, g cm^2) is caught.
constexpr Range resistance_Ohm{1e-5, 1e3};
constexpr Range inductance_H{1e-7, 10.0};
constexpr Range flux_Wb{1e-5, 10.0};
constexpr Range inertia_kgm2{1e-9, 1e3};
constexpr Range friction_Nms{0.0, 1e2};
constexpr Range speed_e_radps{1.0, 1e5};
constexpr Range torque_Nm{1e-5, 1e5};
constexpr Range current_A{1e-3, 1e4};
constexpr Range dc_link_V{1.0, 1e4};
constexpr Range pwm_frequency_Hz{1e3, 1e5};
constexpr Range dead_time_s{0.0, 2e-5};
constexpr Range encoder_lines{1, 1e6};
constexpr Range slots{3, 1000};
constexpr Range sensor_order{1.0, 2.0};
constexpr Range slot_multiple{1.0, 3.0};
constexpr Range leak_1ps{1e-3, 1e2};
constexpr Range series_order{0, 8};
constexpr Range double_series_order{0, DOUBLE_SERIES_ORDER_MAX};
constexpr Range state_weight{0.0, 1e15};
constexpr Range input_weight{1e-18, 1e12};
constexpr Range polynomial_order{1, 3};
constexpr Range harmonic_order{1.0, 1e3};
constexpr Range pole_1ps{1.0, 1e5};
constexpr Range speed_gain{0.0, 1e6};
constexpr Range current_gain{0.0, 1e9};

template <std::size_t N> std::array<double, N> last_of(const std::vector<double> &values)
{
    std::array<double, N> out{};
    std::copy(values.end() - static_cast<std::ptrdiff_t>(N), values.end(), out.begin());
    return out;
}

Motor read_motor(TomlReader t)
{
    Motor m;
    m.pole_pairs            = t.integer("pole_pairs", {1, 100});
    m.stator_resistance_Ohm = t.number("stator_resistance_Ohm", resistance_Ohm);
    m.d_axis_inductance_H   = t.number("d_axis_inductance_H", inductance_H);
    m.q_axis_inductance_H   = t.number("q_axis_inductance_H", inductance_H);
    m.pm_flux_Wb            = t.number("pm_flux_Wb", flux_Wb);
    m.inertia_kgm2          = t.number("inertia_kgm2", inertia_kgm2);
    m.viscous_friction_Nms  = t.number("viscous_friction_Nms", friction_Nms);
    m.rated_speed_e_radps   = t.number("rated_speed_e_radps", speed_e_radps);
    m.rated_torque_Nm       = t.number("rated_torque_Nm", torque_Nm);
    m.max_current_A         = t.number("max_current_A", current_A);
    if (t.has("slots")) {
        m.slots = t.integer("slots", slots);
    }
    t.reject_unknown_keys();
    if (m.d_axis_inductance_H > m.q_axis_inductance_H) {
        t.fail("d_axis_inductance_H",
               fmt::format("= {:g} is not allowed: must not exceed q_axis_inductance_H = {:g} "
                           "(the reluctance torque of the law needs Ld <= Lq)",
                           m.d_axis_inductance_H, m.q_axis_inductance_H));
    }
    return m;
}

Inverter read_inverter(TomlReader t)
{
    Inverter inverter;
    inverter.dc_link_V              = t.number("dc_link_V", dc_link_V);
    inverter.pwm_frequency_Hz       = t.number("pwm_frequency_Hz", pwm_frequency_Hz);
    inverter.dead_time_s            = t.number("dead_time_s", dead_time_s);
    inverter.updates_per_period     = t.integer_or("updates_per_period", {1, 2}, 1);
    inverter.dead_time_compensation = t.boolean_or("dead_time_compensation", true);
    inverter.overmodulation         = t.boolean_or("overmodulation", false);
    t.reject_unknown_keys();
    return inverter;
}

Encoder read_encoder(TomlReader t)
{
    Encoder encoder;
    encoder.lines      = t.integer("lines", encoder_lines);
    encoder.edge_times = t.boolean_or("edge_times", false);
    t.reject_unknown_keys();
    return encoder;
}

NoscSpec read_nosc(TomlReader t, Range order)
{
    NoscSpec spec;
    spec.order = t.integer("order", order);
    spec.Q     = last_of<3>(t.numbers("Q", {3}, state_weight));
    spec.T     = last_of<2>(t.numbers("T", {2}, input_weight));
    t.reject_unknown_keys();
    return spec;
}

NodoSpec read_nodo(TomlReader t)
{
    NodoSpec          spec;
    const std::string form = t.text_or("form", "speed");
    if (form != "speed" && form != "encoder") {
        t.fail("form",
               fmt::format("= \"{}\" is not allowed: must be \"speed\" or \"encoder\"", form));
    }
    const bool speed = form == "speed";
    spec.form        = speed ? NodoForm::speed : NodoForm::encoder;
    spec.order       = t.integer("order", series_order);
    spec.Q           = t.numbers("Q", {speed ? 6U : 7U}, state_weight);
    // The paper writes six weights; its C_d is zero for the first three, so only the last three act.
    const std::vector<std::size_t> lengths =
        speed ? std::vector<std::size_t>{6, 3} : std::vector<std::size_t>{3};
    spec.T = last_of<3>(t.numbers("T", lengths, input_weight));
    t.reject_unknown_keys();
    return spec;
}

NodoSpec read_conventional_nodo(TomlReader t)
{
    NodoSpec          spec;
    const std::string disturbances = t.text("disturbances");
    if (disturbances != "load" && disturbances != "all") {
        t.fail("disturbances",
               fmt::format("= \"{}\" is not allowed: must be \"load\" or \"all\"", disturbances));
    }
    const bool load = disturbances == "load";
    spec.form       = load ? NodoForm::conventional_load : NodoForm::conventional_all;
    spec.order      = t.integer("order", double_series_order);
    spec.Q          = t.numbers("Q", {load ? 4U : 6U}, state_weight);
    spec.T          = last_of<3>(t.numbers("T", {3}, input_weight));
    t.reject_unknown_keys();
    return spec;
}

const std::map<std::string, Law> &laws()
{
    static const std::map<std::string, Law> names{
        {"noc", Law::noc},     {"conventional_noc", Law::conventional_noc},
        {"noc_h", Law::noc_h}, {"cdobc", Law::cdobc},
        {"hdobc", Law::hdobc}, {"gpiobc", Law::gpiobc},
        {"pid", Law::pid}};
    return names;
}

Law read_law(TomlReader &t)
{
    const std::string name  = t.text_or("law", "noc");
    const auto        found = laws().find(name);
    if (found == laws().end()) {
        t.fail("law",
               fmt::format("= \"{}\" is not allowed: must be \"noc\", \"noc_h\", "
                           "\"conventional_noc\", \"cdobc\", \"gpiobc\", \"hdobc\" or \"pid\"",
                           name));
    }
    return found->second;
}

void read_harmonics(TomlReader &t, DobcSpec &spec)
{
    const std::string preset = t.text("preset");
    if (preset != "printed" && preset != "repaired") {
        t.fail("preset",
               fmt::format("= \"{}\" is not allowed: must be \"printed\" or \"repaired\"", preset));
    }
    spec.preset               = preset == "printed" ? DobcPreset::printed : DobcPreset::repaired;
    spec.harmonics_per_turn   = t.numbers("harmonics_per_turn", {1, 2, 3, 4}, harmonic_order);
    spec.design_speed_e_radps = t.number("design_speed_e_radps", speed_e_radps);
    const std::vector<double> &orders = spec.harmonics_per_turn;
    for (std::size_t i = 1; i < orders.size(); i++) {
        if (orders[i] <= orders[i - 1]) {
            t.fail("harmonics_per_turn",
                   fmt::format("= [.. {:g}, {:g} ..] is not allowed: must rise", orders[i - 1],
                               orders[i]));
        }
    }
    if (spec.preset == DobcPreset::repaired) {
        spec.oscillator_damping_1ps = t.number("oscillator_damping_1ps", pole_1ps);
    }
}

DobcSpec read_dobc(TomlReader t, Law law)
{
    DobcSpec spec;
    spec.controller_pole_1ps = t.number("controller_pole_1ps", pole_1ps);
    spec.observer_pole_1ps   = t.number("observer_pole_1ps", pole_1ps);
    if (law != Law::hdobc) {
        spec.polynomial_order = t.integer("polynomial_order", polynomial_order);
    }
    if (law != Law::gpiobc) {
        read_harmonics(t, spec);
    }
    t.reject_unknown_keys();
    return spec;
}

PidSpec read_pid(TomlReader t)
{
    PidSpec spec;
    spec.proportional_Vs_per_rad = t.number("proportional_Vs_per_rad", {1e-9, speed_gain.hi});
    spec.integral_V_per_rad      = t.number("integral_V_per_rad", speed_gain);
    spec.derivative_Vs2_per_rad  = t.number("derivative_Vs2_per_rad", speed_gain);
    t.reject_unknown_keys();
    return spec;
}

DAxisSpec read_d_axis(TomlReader t)
{
    DAxisSpec spec;
    spec.proportional_V_per_A = t.number("proportional_V_per_A", {1e-9, current_gain.hi});
    spec.integral_V_per_As    = t.number("integral_V_per_As", current_gain);
    t.reject_unknown_keys();
    return spec;
}

HarmonicSpec read_harmonic_spec(TomlReader t, const Motor &motor)
{
    const auto orders = [&t](const char *key, const Range &allowed) {
        return t.has(key) ? t.numbers(key, {1, 2, 3}, allowed) : std::vector<double>{};
    };
    HarmonicSpec spec;
    spec.sensor  = orders("sensor", sensor_order);
    spec.voltage = orders("voltage", harmonic_order);
    spec.cogging = orders("cogging", slot_multiple);
    if (!spec.cogging.empty() && motor.slots == 0) {
        t.fail("cogging", "needs [motor] slots");
    }
    spec.cogging_voltage_weight   = t.number_or("cogging_voltage_weight", state_weight, 0.0);
    const std::size_t per_cogging = spec.cogging_voltage_weight > 0.0 ? 2 : 1;
    const std::size_t pairs =
        spec.sensor.size() + 2 * spec.voltage.size() + per_cogging * spec.cogging.size();
    if (pairs > NODO_HARMONIC_PAIRS_MAX) {
        t.fail(
            "voltage",
            fmt::format(
                "is not allowed: {} pairs in all, the firmware holds {}; a voltage order takes two",
                pairs, NODO_HARMONIC_PAIRS_MAX));
    }
    const auto weight = [&t](const char *key, const std::vector<double> &of) {
        return of.empty() ? 0.0 : t.number(key, state_weight);
    };
    spec.sensor_weight        = weight("sensor_weight", spec.sensor);
    spec.voltage_weight       = weight("voltage_weight", spec.voltage);
    spec.cogging_weight       = weight("cogging_weight", spec.cogging);
    spec.slope_weight         = t.number_or("slope_weight", {0.0, 1e20}, 0.0);
    spec.weight_speed_e_radps = t.number("weight_speed_e_radps", speed_e_radps);
    spec.leak_1ps             = t.number("leak_1ps", leak_1ps);
    t.reject_unknown_keys();
    return spec;
}

/// The sections that belong to the law; the sections of the others are unknown keys.
void read_law_sections(TomlReader &t, Drive &drive)
{
    if (is_near_optimal(drive.law)) {
        const bool conventional = drive.law == Law::conventional_noc;
        drive.nosc = read_nosc(t.table("nosc"), conventional ? double_series_order : series_order);
        drive.nodo =
            conventional ? read_conventional_nodo(t.table("nodo")) : read_nodo(t.table("nodo"));
        if (drive.law != Law::noc_h) {
            return;
        }
        drive.harmonics = read_harmonic_spec(t.table("harmonics"), drive.motor);
        if (drive.nodo.form != NodoForm::encoder) {
            t.fail("[nodo] form", "is not allowed: noc_h needs \"encoder\"");
        }
        if (drive.nodo.order != 1) {
            t.fail("[nodo] order",
                   fmt::format("= {} is not allowed: must be 1 with noc_h", drive.nodo.order));
        }
        return;
    }
    drive.d_axis = read_d_axis(t.table("d_axis"));
    if (drive.law == Law::pid) {
        drive.pid = read_pid(t.table("pid"));
    } else {
        drive.dobc = read_dobc(t.table("dobc"), drive.law);
    }
}

std::string normalised_weights(const Drive &d)
{
    std::string s = fmt::format("nosc;{};", d.nosc.order);
    for (double x : d.nosc.Q) {
        s += fmt::format("{:.17g};", x);
    }
    for (double x : d.nosc.T) {
        s += fmt::format("{:.17g};", x);
    }
    s += fmt::format("nodo;{};{};", nodo_form_name(d.nodo.form), d.nodo.order);
    for (double x : d.nodo.Q) {
        s += fmt::format("{:.17g};", x);
    }
    for (double x : d.nodo.T) {
        s += fmt::format("{:.17g};", x);
    }
    return s;
}

std::string normalised_harmonics(const Drive &d)
{
    const HarmonicSpec &h = d.harmonics;
    std::string         s = fmt::format("{};", law_name(d.law));
    for (const auto *orders : {&h.sensor, &h.voltage, &h.cogging}) {
        for (const double order : *orders) {
            s += fmt::format("{:.17g};", order);
        }
        s += "|";
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
    for (const double order : o.harmonics_per_turn) {
        s += fmt::format("{:.17g};", order);
    }
    return s;
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
    s += d.encoder.edge_times ? "edges;" : "";
    if (d.law == Law::noc_h) {
        return s + normalised_weights(d) + normalised_harmonics(d);
    }
    return s + (is_near_optimal(d.law) ? normalised_weights(d) : normalised_servo(d));
}

} // namespace

Drive read_drive_file(const std::filesystem::path &file)
{
    const toml::table root = parse_toml_file(file);
    TomlReader        t(file.string(), "", root);
    Drive             drive;
    const int         schema = t.integer("schema", {0, 1e6});
    if (schema != drive_schema) {
        t.fail("schema",
               fmt::format("= {} is not allowed: this tool reads schema {}", schema, drive_schema));
    }
    drive.name = t.text("name");
    if (drive.name.empty() ||
        drive.name.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") !=
            std::string::npos) {
        t.fail("name", "must be one or more of A-Z a-z 0-9 _ - .");
    }
    drive.motor    = read_motor(t.table("motor"));
    drive.inverter = read_inverter(t.table("inverter"));
    drive.encoder  = read_encoder(t.table("encoder"));
    drive.law      = read_law(t);
    read_law_sections(t, drive);
    t.reject_unknown_keys();
    if (drive.inverter.dead_time_s * drive.inverter.pwm_frequency_Hz > 0.1) {
        t.fail("[inverter] dead_time_s",
               "is not allowed: must be at most a tenth of the PWM period");
    }
    return drive;
}

bool is_near_optimal(Law law)
{
    return law == Law::noc || law == Law::noc_h || law == Law::conventional_noc;
}

const char *nodo_form_name(NodoForm form)
{
    switch (form) {
    case NodoForm::speed:
        return "speed";
    case NodoForm::encoder:
        return "encoder";
    case NodoForm::conventional_load:
        return "conventional, load";
    case NodoForm::conventional_all:
        return "conventional, all";
    }
    return "unknown";
}

bool is_law_name(const std::string &name)
{
    return laws().count(name) > 0;
}

const char *law_name(Law law)
{
    for (const auto &[name, value] : laws()) {
        if (value == law) {
            return name.c_str();
        }
    }
    return "unknown";
}

double control_period_s(const Drive &drive)
{
    return 1.0 / (drive.inverter.pwm_frequency_Hz * drive.inverter.updates_per_period);
}

std::string drive_digest(const Drive &drive)
{
    std::uint64_t hash = 0xcbf29ce484222325ULL; // FNV-1a, 64 bit
    for (char c : normalised(drive)) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    }
    return fmt::format("fnv1a64:{:016x}", hash);
}

double &motor_value(Motor &m, const std::string &key)
{
    const std::map<std::string, double *> values{
        {"stator_resistance_Ohm", &m.stator_resistance_Ohm},
        {"d_axis_inductance_H", &m.d_axis_inductance_H},
        {"q_axis_inductance_H", &m.q_axis_inductance_H},
        {"pm_flux_Wb", &m.pm_flux_Wb},
        {"inertia_kgm2", &m.inertia_kgm2},
        {"viscous_friction_Nms", &m.viscous_friction_Nms},
        {"rated_speed_e_radps", &m.rated_speed_e_radps},
        {"rated_torque_Nm", &m.rated_torque_Nm},
        {"max_current_A", &m.max_current_A}};
    const auto found = values.find(key);
    if (found == values.end()) {
        throw InputError(fmt::format("{} is not a motor key that can be scaled", key));
    }
    return *found->second;
}

} // namespace sdre
