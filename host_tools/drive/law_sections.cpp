// SPDX-License-Identifier: MIT
#include "drive/law_sections.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "drive/core_types.hpp"

namespace sdre {
namespace {

constexpr Range sensor_order{1.0, 2.0};
constexpr Range slot_multiple{1.0, 3.0};
constexpr Range leak_1ps{1e-3, 1e2};
constexpr Range series_order{0, 8};
constexpr Range sampled_order{0, 1};
constexpr Range double_series_order{0, DOUBLE_SERIES_ORDER_MAX};
constexpr Range state_weight{0.0, 1e15};
constexpr Range input_weight{1e-18, 1e12};
constexpr Range polynomial_order{1, 3};
constexpr Range harmonic_order{1.0, 1e3};
constexpr Range pole_1ps{1.0, 1e5};
constexpr Range speed_gain{0.0, 1e6};
constexpr Range current_gain{0.0, 1e9};
constexpr Range bandwidth_Hz{1.0, 1e4};
constexpr Range optimum_a{1.05, 20.0};

template <std::size_t N> std::array<double, N> last_of(const std::vector<double> &values)
{
    std::array<double, N> out{};
    std::copy(values.end() - static_cast<std::ptrdiff_t>(N), values.end(), out.begin());
    return out;
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

PositionSpec read_position(TomlReader t)
{
    constexpr Range acts{input_weight.lo, state_weight.hi}; // without it nothing holds the angle
    PositionSpec    spec;
    spec.Q = last_of<4>(t.numbers("Q", {4}, state_weight));
    spec.T = last_of<2>(t.numbers("T", {2}, input_weight));
    if (!(spec.Q[0] >= acts.lo)) {
        t.fail("Q[0]", fmt::format("= {:g} is not allowed: must be {:g} .. {:g}", spec.Q[0],
                                   acts.lo, acts.hi));
    }
    t.reject_unknown_keys();
    return spec;
}

void read_position_if(TomlReader &t, Drive &drive)
{
    if (std::optional<TomlReader> section = t.table_if("position")) {
        if (!takes_positions(drive.law) || drive.nodo.form != NodoForm::encoder) {
            t.fail("[position]", "is not allowed: only laws noc and noc_h with [nodo] form = "
                                 "\"encoder\" take positions");
        }
        drive.position = read_position(*section);
    }
}

void read_torque_if(TomlReader &t, Drive &drive)
{
    std::optional<TomlReader> section = t.table_if("torque");
    if (!section) {
        return;
    }
    if (!takes_torque(drive)) {
        t.fail(
            "[torque]",
            "is not allowed: only pi_foc, and noc with [nodo] form = \"encoder\", follow a torque");
    }
    constexpr Range acts{input_weight.lo, state_weight.hi}; // without it nothing holds a current
    drive.torque.emplace();
    if (drive.law == Law::noc && (section->has("Q") || section->has("T"))) {
        TorqueWeights w;
        w.Q                   = last_of<2>(section->numbers("Q", {2}, acts));
        w.T                   = last_of<2>(section->numbers("T", {2}, input_weight));
        drive.torque->weights = w;
    }
    section->reject_unknown_keys();
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
    spec.order       = t.integer("order", speed ? series_order : sampled_order);
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
        {"noc", Law::noc},           {"conventional_noc", Law::conventional_noc},
        {"noc_h", Law::noc_h},       {"noc_shaft", Law::noc_shaft},
        {"noc_iron", Law::noc_iron}, {"cdobc", Law::cdobc},
        {"hdobc", Law::hdobc},       {"gpiobc", Law::gpiobc},
        {"pid", Law::pid},           {"pi_foc", Law::pi_foc},
        {"ladrc", Law::ladrc}};
    return names;
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
    spec.design_speed_e_radps = t.number("design_speed_e_radps", allowed_speed_e_radps);
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

CascadeSpec read_cascade(TomlReader t, Law law)
{
    CascadeSpec spec;
    spec.current_bandwidth_Hz = t.number("current_bandwidth_Hz", bandwidth_Hz);
    if (law == Law::pi_foc) {
        spec.symmetrical_optimum_a = t.number("symmetrical_optimum_a", optimum_a);
        spec.load_observer_radps   = t.number_or("load_observer_radps", pole_1ps, 0.0);
    } else {
        spec.controller_radps = t.number("controller_radps", pole_1ps);
        spec.observer_radps   = t.number("observer_radps", pole_1ps);
    }
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
    spec.weight_speed_e_radps = t.number("weight_speed_e_radps", allowed_speed_e_radps);
    spec.leak_1ps             = t.number("leak_1ps", leak_1ps);
    t.reject_unknown_keys();
    return spec;
}

ShaftSpec read_shaft(TomlReader t)
{
    ShaftSpec spec;
    spec.Q      = last_of<2>(t.numbers("Q", {2}, state_weight));
    spec.nodo_Q = last_of<2>(t.numbers("nodo_Q", {2}, state_weight));
    t.reject_unknown_keys();
    return spec;
}

/// The laws beside noc need the encoder form and order 1.
void need_sampled_series(TomlReader &t, const Drive &drive)
{
    const char *name = law_name(drive.law);
    if (drive.nodo.form != NodoForm::encoder) {
        t.fail("[nodo] form", fmt::format("is not allowed: {} needs \"encoder\"", name));
    }
    if (drive.nodo.order != 1) {
        t.fail("[nodo] order",
               fmt::format("= {} is not allowed: must be 1 with {}", drive.nodo.order, name));
    }
}

} // namespace

Law read_law(TomlReader &t)
{
    const std::string name  = t.text_or("law", "noc");
    const auto        found = laws().find(name);
    if (found == laws().end()) {
        t.fail("law",
               fmt::format(
                   "= \"{}\" is not allowed: must be \"noc\", \"noc_h\", \"noc_shaft\", "
                   "\"noc_iron\", \"conventional_noc\", \"cdobc\", \"gpiobc\", \"hdobc\", \"pid\", "
                   "\"pi_foc\" or \"ladrc\"",
                   name));
    }
    return found->second;
}

void read_law_sections(TomlReader &t, Drive &drive)
{
    if (is_near_optimal(drive.law)) {
        const bool conventional = drive.law == Law::conventional_noc;
        drive.nosc = read_nosc(t.table("nosc"), conventional ? double_series_order : series_order);
        drive.nodo =
            conventional ? read_conventional_nodo(t.table("nodo")) : read_nodo(t.table("nodo"));
        read_position_if(t, drive);
        read_torque_if(t, drive);
        if (drive.law == Law::noc_h) {
            drive.harmonics = read_harmonic_spec(t.table("harmonics"), drive.motor);
            need_sampled_series(t, drive);
        } else if (drive.law == Law::noc_shaft) {
            drive.shaft = read_shaft(t.table("shaft"));
            need_sampled_series(t, drive);
        } else if (drive.law == Law::noc_iron) {
            need_sampled_series(t, drive);
            if (!drive.saturation) {
                t.fail("[saturation]", "is missing: noc_iron is for a map of the iron");
            }
        }
        return;
    }
    if (is_cascade(drive.law)) {
        drive.cascade = read_cascade(t.table(law_name(drive.law)), drive.law);
        read_torque_if(t, drive);
        return;
    }
    drive.d_axis = read_d_axis(t.table("d_axis"));
    if (drive.law == Law::pid) {
        drive.pid = read_pid(t.table("pid"));
    } else {
        drive.dobc = read_dobc(t.table("dobc"), drive.law);
    }
}

bool is_near_optimal(Law law)
{
    return law == Law::noc || law == Law::noc_h || law == Law::noc_shaft || law == Law::noc_iron ||
           law == Law::conventional_noc;
}

bool takes_positions(Law law)
{
    return law == Law::noc || law == Law::noc_h;
}

bool takes_torque(const Drive &drive)
{
    return drive.law == Law::pi_foc ||
           (drive.law == Law::noc && drive.nodo.form == NodoForm::encoder);
}

bool is_cascade(Law law)
{
    return law == Law::pi_foc || law == Law::ladrc;
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

} // namespace sdre
