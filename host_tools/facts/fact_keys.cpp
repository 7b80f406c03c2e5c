// SPDX-License-Identifier: MIT
#include "facts/fact_keys.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "facts/fact_units.hpp"

namespace sdre {
namespace {

struct Quantity {
    Dimension                dimension;
    std::vector<std::string> names; ///< the first is the quantity's own; what else sheets call it
};

const std::vector<Quantity> &quantities()
{
    using D = Dimension;
    static const std::vector<Quantity> all{
        {D::count, {"pole_pairs", "number_of_pole_pairs", "pole_pair_number", "pp"}},
        {D::count, {"poles", "number_of_poles", "pole_number", "pole_count"}},
        {D::resistance, {"resistance", "winding_resistance", "armature_resistance", "r", "rs"}},
        {D::inductance, {"inductance", "winding_inductance", "synchronous_inductance", "l", "ls"}},
        {D::inductance, {"ld", "d_axis_inductance", "inductance_d", "d_inductance"}},
        {D::inductance, {"lq", "q_axis_inductance", "inductance_q", "q_inductance"}},
        {D::flux,
         {"pm_flux", "flux", "flux_linkage", "pm_flux_linkage", "magnet_flux", "rotor_flux",
          "psi_pm", "psi_f"}},
        {D::emf_per_speed,
         {"ke", "k_e", "back_emf", "bemf", "emf", "emf_constant", "back_emf_constant",
          "bemf_constant", "voltage_constant"}},
        {D::speed_per_volt, {"kv", "k_v", "speed_constant"}},
        {D::torque_per_current, {"kt", "k_t", "torque_constant"}},
        {D::inertia, {"inertia", "rotor_inertia", "moment_of_inertia", "j", "total_inertia"}},
        {D::inertia, {"load_inertia"}},
        {D::friction, {"viscous_friction", "friction", "damping", "viscous_damping"}},
        {D::speed, {"rated_speed", "base_speed"}},
        {D::speed, {"max_speed", "top_speed"}},
        {D::speed, {"no_load_speed", "idle_speed"}},
        {D::torque, {"rated_torque", "torque", "stall_torque"}},
        {D::torque, {"max_torque"}},
        {D::current, {"rated_current", "stall_current"}},
        {D::current, {"max_current", "current_max"}},
        {D::power, {"rated_power", "power"}},
        {D::voltage, {"rated_voltage"}},
        {D::voltage,
         {"dc_link", "dc_bus", "dc_link_voltage", "dc_bus_voltage", "bus_voltage", "dc_voltage",
          "supply", "supply_voltage", "battery", "battery_voltage"}},
        {D::frequency, {"pwm", "pwm_frequency", "switching_frequency", "carrier_frequency"}},
        {D::count, {"updates_per_period"}},
        {D::time, {"dead_time"}},
        {D::count, {"encoder_lines", "encoder_pulses", "encoder_ppr", "encoder_lines_per_turn"}},
        {D::count, {"encoder_counts", "encoder_counts_per_turn"}},
        {D::count, {"encoder_cpr"}},
        {D::count, {"encoder_bits"}},
        {D::current, {"current_range", "current_sensor_range"}},
        {D::current, {"current_noise", "current_sensor_noise"}},
        {D::count, {"adc_bits"}},
        {D::count, {"slots", "stator_slots", "number_of_slots"}},
        {D::time, {"electrical_time_constant"}},
        {D::time, {"mechanical_time_constant"}},
        {D::motor_constant, {"motor_constant", "km"}}};
    return all;
}

std::string lower(std::string s)
{
    std::transform(s.begin(), s.end(), s.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return s;
}

/// Replaces whole words; `padded` begins and ends with '_'. True when there was one.
bool replace_words(std::string &padded, const std::string &from, const std::string &to)
{
    const std::string word  = "_" + from + "_";
    bool              found = false;
    for (std::size_t at = padded.find(word); at != std::string::npos; at = padded.find(word)) {
        padded.replace(at, word.size(), to.empty() ? "_" : "_" + to + "_");
        found = true;
    }
    return found;
}

/// Different spellings of the same words.
const std::vector<std::pair<std::string, std::string>> spellings{{"r_min", "rpm"},
                                                                 {"r_per_min", "rpm"},
                                                                 {"rev_per_min", "rpm"},
                                                                 {"1_min", "rpm"},
                                                                 {"1_per_min", "rpm"},
                                                                 {"min_1", "rpm"},
                                                                 {"kr_min", "krpm"},
                                                                 {"kr_per_min", "krpm"},
                                                                 {"1000_rpm", "krpm"},
                                                                 {"1000rpm", "krpm"},
                                                                 {"rad_s", "radps"},
                                                                 {"rad_per_s", "radps"},
                                                                 {"rad_per_sec", "radps"},
                                                                 {"radpers", "radps"},
                                                                 {"rps_e", "e_radps"},
                                                                 {"ohms", "ohm"},
                                                                 {"n_m", "nm"},
                                                                 {"mn_m", "mnm"},
                                                                 {"kn_m", "knm"},
                                                                 {"n_cm", "ncm"},
                                                                 {"v_s", "vs"},
                                                                 {"mv_s", "mvs"},
                                                                 {"nm_s", "nms"},
                                                                 {"kg_m2", "kgm2"},
                                                                 {"kg_cm2", "kgcm2"},
                                                                 {"g_cm2", "gcm2"},
                                                                 {"kg_mm2", "kgmm2"},
                                                                 {"g_mm2", "gmm2"},
                                                                 {"g_m2", "gm2"},
                                                                 {"oz_in", "ozin"},
                                                                 {"oz_in2", "ozin2"},
                                                                 {"lb_in", "lbin"},
                                                                 {"lb_in2", "lbin2"},
                                                                 {"lb_ft", "lbft"},
                                                                 {"lb_ft2", "lbft2"},
                                                                 {"ozin_s2", "ozins2"},
                                                                 {"lbin_s2", "lbins2"},
                                                                 {"per_sqrt_w", "per_sqrtw"},
                                                                 {"arms", "a_rms"},
                                                                 {"apk", "a_peak"},
                                                                 {"vrms", "v_rms"},
                                                                 {"vpk", "v_peak"},
                                                                 {"pk", "peak"},
                                                                 {"amplitude", "peak"},
                                                                 {"vll", "v_line_to_line"},
                                                                 {"maximum", "max"},
                                                                 {"limit", "max"},
                                                                 {"nominal", "rated"},
                                                                 {"continuous", "rated"},
                                                                 {"cont", "rated"},
                                                                 {"standstill", "stall"},
                                                                 {"nom", "rated"},
                                                                 {"volt", "v"},
                                                                 {"volts", "v"},
                                                                 {"amps", "a"},
                                                                 {"amp", "a"}};

const std::vector<std::string> line_words{"line_to_line", "phase_to_phase", "terminal_to_terminal",
                                          "line_line",    "phase_phase",    "l_l",
                                          "ll",           "terminal",       "line"};
const std::vector<std::string> phase_words{"line_to_neutral", "phase_to_neutral", "per_phase",
                                           "phase",           "stator",           "ln"};

bool take_any(std::string &padded, const std::vector<std::string> &words)
{
    bool found = false;
    for (const std::string &word : words) {
        found = replace_words(padded, word, "") || found;
    }
    return found;
}

/// "peak" in front of a current or a torque says which one is meant; elsewhere how it is given.
void name_the_peak(std::string &padded)
{
    if (padded.find("_max_") == std::string::npos && padded.rfind("_peak_", 0) == 0) {
        padded.replace(0, 6, "_max_");
    }
}

/// The qualifier stands in front.
std::string qualifier_first(std::string name)
{
    for (const char *word : {"rated", "max"}) {
        std::string padded = "_" + name + "_";
        if (replace_words(padded, word, "")) {
            name = fmt::format("{}_{}", word, padded.substr(1, padded.size() - 2));
        }
    }
    return name;
}

struct Meaning {
    const Quantity *quantity;
    const Unit     *unit;
};

std::optional<Meaning> meaning_of(const std::string &words)
{
    std::optional<Meaning> best;
    for (const Unit &unit : fact_units()) {
        const std::string end = unit.name.empty() ? "" : "_" + unit.name;
        if (words.size() <= end.size() ||
            words.compare(words.size() - end.size(), end.size(), end) != 0) {
            continue;
        }
        const std::string name = qualifier_first(words.substr(0, words.size() - end.size()));
        for (const Quantity &q : quantities()) {
            if (q.dimension == unit.dimension &&
                std::find(q.names.begin(), q.names.end(), name) != q.names.end()) {
                best = {&q, &unit};
            }
        }
    }
    return best;
}

/// Complains of the unit when the quantity is known, else of the key.
[[noreturn]] void refuse(const std::string &source, const std::string &key,
                         const std::string &words)
{
    for (const Quantity &q : quantities()) {
        for (const std::string &name : q.names) {
            if (words == name || words.rfind(name + "_", 0) == 0) {
                throw InputError(fmt::format("{}: {} is not understood: {} ends with one of {}",
                                             source, key, q.names[0], unit_names(q.dimension)));
            }
        }
    }
    throw InputError(fmt::format("{}: {} is not understood; `sdre-gains new --keys` lists what is",
                                 source, key));
}

} // namespace

std::vector<Fact> Facts::of(const std::string &quantity) const
{
    std::vector<Fact> found;
    std::copy_if(facts.begin(), facts.end(), std::back_inserter(found),
                 [&](const Fact &f) { return f.quantity == quantity; });
    return found;
}

bool Facts::has(const std::string &quantity) const
{
    return !of(quantity).empty();
}

Fact parse_fact(const std::string &source, const std::string &key, double value)
{
    std::string padded = "_" + lower(key) + "_";
    for (const auto &[from, to] : spellings) {
        replace_words(padded, from, to);
    }
    name_the_peak(padded);
    Fact fact;
    if (take_any(padded, line_words)) {
        fact.connection = Connection::line_to_line;
    } else if (take_any(padded, phase_words)) {
        fact.connection = Connection::phase;
    }
    if (replace_words(padded, "rms", "")) {
        fact.amplitude = Amplitude::rms;
    } else if (replace_words(padded, "peak", "")) {
        fact.amplitude = Amplitude::peak;
    }
    const std::string words = padded.substr(1, std::max<std::size_t>(padded.size(), 2) - 2);
    const auto        found = meaning_of(words);
    if (!found) {
        refuse(source, key, words);
    }
    const bool zero_allowed = found->quantity->dimension == Dimension::flux ||
                              found->quantity->dimension == Dimension::friction ||
                              found->quantity->dimension == Dimension::time;
    if (!std::isfinite(value) || value < 0.0 || (value <= 0.0 && !zero_allowed)) {
        throw InputError(fmt::format("{}: {} = {:g} is not allowed: must be {}", source, key, value,
                                     zero_allowed ? "0 or more" : "above 0"));
    }
    const bool whole = found->quantity->dimension == Dimension::count;
    if (whole && value != std::floor(value)) {
        throw InputError(fmt::format("{}: {} = {:g} is not allowed: must be a whole number", source,
                                     key, value));
    }
    fact.quantity   = found->quantity->names[0];
    fact.si         = value * found->unit->si;
    fact.electrical = found->unit->electrical;
    fact.text       = fmt::format("{} = {:g}", key, value);
    return fact;
}

Facts parse_facts(const std::string &source, const toml::table &table)
{
    Facts out;
    out.source = source;
    for (const auto &[toml_key, node] : table) {
        const std::string key(toml_key.str());
        const auto        text = node.value<std::string>();
        if (key == "name" && text) {
            out.name = *text;
        } else if (key == "regeneration" && text) {
            out.regeneration = *text;
        } else if (key == "board" && text) {
            out.board = *text;
        } else if (key == "edge_times" && node.is_boolean()) {
            out.edge_times = *node.value<bool>();
        } else if (node.is_number()) {
            out.facts.push_back(parse_fact(source, key, *node.value<double>()));
        } else {
            throw InputError(fmt::format("{}: {} must be a number", source, key));
        }
    }
    return out;
}

std::string quantity_names()
{
    std::string s;
    for (const Quantity &q : quantities()) {
        const std::string units = unit_names(q.dimension);
        s += fmt::format("  {:<26} {}\n", q.names[0], units.empty() ? "whole number" : units);
    }
    return s;
}

} // namespace sdre
