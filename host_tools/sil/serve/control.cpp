// SPDX-License-Identifier: MIT
#include "sil/serve/control.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "common/errors.hpp"
#include "common/toml_reader.hpp"

namespace sdre {
namespace {

using nlohmann::json;

constexpr double sample_s  = 1e-3;
constexpr double longest_s = 20.0;
constexpr double rpm       = 60.0 / (2.0 * 3.14159265358979323846);
constexpr Range  load_range_Nm{-1e5, 1e5};
constexpr Range  dc_link_range_V{1.0, 1e4};

double number(const std::string &text, const Range &range, const char *what)
{
    std::istringstream in(text);
    double             x = 0.0;
    std::string        rest;
    if (!(in >> x) || (in >> rest) || !(x >= range.lo && x <= range.hi)) {
        throw InputError(fmt::format("{} \"{}\" is not allowed: must be a number in {:g} .. {:g}",
                                     what, text, range.lo, range.hi));
    }
    return x;
}

json state(const ServedDrive &drive, const PaceReport &pace)
{
    const PlantState &now = drive.plant_state();
    const double      rad = now.omega_e_radps / drive.drive().motor.pole_pairs;
    return {{"drive", drive.drive().name},
            {"time_s", drive.time_s()},
            {"speed_e_radps", now.omega_e_radps},
            {"speed_rpm", rad * rpm},
            {"pole_pairs", drive.drive().motor.pole_pairs},
            {"id_A", now.current_A.d},
            {"iq_A", now.current_A.q},
            {"torque_Nm", now.torque_Nm},
            {"load_Nm", drive.load_Nm()},
            {"dc_link_V", now.dc_link_V},
            {"bridge_on", drive.bridge_on()},
            {"resets", drive.resets()},
            {"speed_factor", pace.speed_factor},
            {"slipped_s", pace.slipped_s},
            {"findings", drive.findings()}};
}

json trace(const MotorRecord &record, double length_s)
{
    json        columns = {{"time_s", json::array()},    {"speed_e_radps", json::array()},
                           {"iq_A", json::array()},      {"id_A", json::array()},
                           {"torque_Nm", json::array()}, {"load_Nm", json::array()},
                           {"dc_link_V", json::array()}};
    const auto &all     = record.samples();
    for (const MotorRecord::Sample &x : all) {
        if (x.time_s >= all.back().time_s - length_s) {
            columns["time_s"].push_back(x.time_s);
            columns["speed_e_radps"].push_back(x.omega_e_radps);
            columns["iq_A"].push_back(x.iq_A);
            columns["id_A"].push_back(x.id_A);
            columns["torque_Nm"].push_back(x.torque_Nm);
            columns["load_Nm"].push_back(x.load_Nm);
            columns["dc_link_V"].push_back(x.dc_link_V);
        }
    }
    return columns;
}

/// Through the reader of a scenario's [[fault]] entries, so that keys and ranges are the same.
InjectedFault fault_of(const std::string &keys)
{
    const toml::table table =
        parse_toml_text(fmt::format("fault = [{{ time_s = 0.0, {} }}]", keys), "fault");
    TomlReader t("fault", "", table);
    return read_injected_faults(t).at(0);
}

json answer(const std::string &word, const std::string &rest, ServedDrive &drive,
            const MotorRecord &record, const PaceReport &pace)
{
    if (word == "load") {
        drive.set_load_Nm(number(rest, load_range_Nm, "load"));
    } else if (word == "dc_link") {
        drive.set_dc_link_V(number(rest, dc_link_range_V, "dc_link"));
    } else if (word == "fault") {
        drive.break_part(fault_of(rest));
    } else if (word == "mend") {
        drive.mend();
    } else if (word == "power_cycle") {
        drive.power_cycle();
    } else if (word == "trace") {
        return trace(record, number(rest, {0.0, longest_s}, "trace"));
    } else if (word != "state") {
        throw InputError(
            fmt::format("\"{}\" is not a command: load, dc_link, fault, mend, power_cycle, state, "
                        "trace",
                        word));
    }
    return state(drive, pace);
}

} // namespace

void MotorRecord::note(const ServedDrive &drive)
{
    if (drive.time_s() < next_s_) {
        return;
    }
    const PlantState &now = drive.plant_state();
    next_s_               = drive.time_s() + sample_s - 1e-9;
    samples_.push_back({drive.time_s(), now.omega_e_radps, now.current_A.q, now.current_A.d,
                        now.torque_Nm, now.load_Nm, now.dc_link_V});
    while (samples_.size() > static_cast<std::size_t>(longest_s / sample_s)) {
        samples_.pop_front();
    }
}

std::string control_answer(const std::string &line, ServedDrive &drive, const MotorRecord &record,
                           const PaceReport &pace)
{
    const std::size_t space = line.find(' ');
    const std::string word  = line.substr(0, space);
    const std::string rest  = space == std::string::npos ? "" : line.substr(space + 1);
    json              out;
    try {
        out = answer(word, rest, drive, record, pace);
    } catch (const InputError &e) {
        out = {{"error", e.what()}};
    }
    return out.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

} // namespace sdre
