// SPDX-License-Identifier: MIT
#include "sil/served/control.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "common/errors.hpp"
#include "common/toml_reader.hpp"
#include "design/motor_model.hpp"

namespace sdre {
namespace {

using nlohmann::json;

constexpr double rpm = 60.0 / (2.0 * 3.14159265358979323846);
constexpr Range  dc_link_range_V{1.0, 1e4};
constexpr Range  switch_range{-1e5, 1e5}; // turns
constexpr Range  brake_range_Nm{0.0, 1e5};
constexpr Range  brake_range_s{0.0, 10.0};
// Measured with the shipped drive: with less, a third of a current or none is within the noise of the model.
constexpr double telling_share = 0.1; // of the current limit
// Chosen: slower, a turn takes more than a second.
constexpr double turning_m_radps = 6.0;

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

/// "load 1.2" brakes, "load -1.2 active" drives.
void set_load(const std::string &text, Dynamometer &dynamometer)
{
    const std::size_t space  = text.find_last_of(' ');
    const std::string kind   = space == std::string::npos ? "" : text.substr(space + 1);
    const bool        active = kind == "active";
    const std::string value  = active || kind == "brake" ? text.substr(0, space) : text;
    const double      most   = dynamometer.most_Nm();
    const double      x      = number(value, {-most, most}, "load");
    if (active) {
        dynamometer.drive(x);
    } else if (x < 0.0) {
        throw InputError(fmt::format("load \"{}\" is not allowed: a brake has 0 or more; "
                                     "\"load {} active\" drives the shaft",
                                     text, value));
    } else {
        dynamometer.brake(x);
    }
}

json broken(const ServedDrive &drive)
{
    json all = json::array();
    for (const InjectedFault &f : drive.broken()) {
        const std::string phase = needs_phase(f.kind) ? fmt::format(" {}", "abc"[f.phase]) : "";
        all.push_back(fault_kind_name(f.kind) + phase);
    }
    return all;
}

double rpm_of(const ServedDrive &drive, double speed_e_radps)
{
    return speed_e_radps / drive.drive().motor.pole_pairs * rpm;
}

/// In one line what somebody at the bench has to know now; empty: nothing.
std::string note(const ServedDrive &drive)
{
    if (!drive.dynamometer().caught()) {
        return "";
    }
    return fmt::format("the bench has caught the shaft at {:.0f} r/min: the load is 0 now",
                       rpm_of(drive, drive.dynamometer().catch_speed_e_radps()));
}

struct CanFaultName {
    f28335::CanFault fault;
    const char      *name;
};
constexpr CanFaultName can_faults[] = {{f28335::CanFault::none, "none"},
                                       {f28335::CanFault::open, "open"},
                                       {f28335::CanFault::shorted, "shorted"},
                                       {f28335::CanFault::dominant, "dominant"}};

const char *can_fault(const ServedDrive &drive)
{
    for (const CanFaultName &f : can_faults) {
        if (f.fault == drive.can_bus().fault()) {
            return f.name;
        }
    }
    return "";
}

void require_connection(bool has, const char *what, const ServedDrive &drive)
{
    if (!has) {
        throw InputError(fmt::format("{}: {} has none", what, drive.board()));
    }
}

void set_can_fault(const std::string &name, ServedDrive &drive)
{
    require_connection(drive.connections().can, "a CAN bus", drive);
    for (const CanFaultName &f : can_faults) {
        if (name == f.name) {
            drive.can_bus().set_fault(f.fault);
            return;
        }
    }
    throw InputError(
        fmt::format("can \"{}\" is not allowed: must be open, shorted, dominant or none", name));
}

/// "switch negative -3", "switch positive 5.5", "switch home 1 1.2", "switch none": turns from the mark.
void set_switch(const std::string &text, ServedDrive &drive)
{
    const std::size_t space = text.find(' ');
    const std::string which = text.substr(0, space);
    const std::string rest  = space == std::string::npos ? "" : text.substr(space + 1);
    if (which == "negative" || which == "positive") {
        require_connection(drive.connections().limit_inputs, "a limit switch", drive);
    }
    if (which == "none") {
        drive.switches() = {};
    } else if (which == "negative") {
        drive.switches().negative = number(rest, switch_range, "switch negative");
    } else if (which == "positive") {
        drive.switches().positive = number(rest, switch_range, "switch positive");
    } else if (which == "home") {
        const std::size_t gap  = rest.find(' ');
        const double      from = number(rest.substr(0, gap), switch_range, "switch home");
        const double      to   = number(gap == std::string::npos ? "" : rest.substr(gap + 1),
                                 {from, switch_range.hi}, "switch home's end");
        drive.switches().home = {from, to};
    } else {
        throw InputError(fmt::format("switch \"{}\" is not known: negative TURNS, positive TURNS, "
                                     "home FROM TO, or none",
                                     which));
    }
}

/// "holding_brake 3 0.05 0.03": N m, seconds to release and to close; "holding_brake 0": none.
void set_holding_brake(const std::string &text, ServedDrive &drive)
{
    require_connection(drive.connections().holding_brake, "an output for a holding brake", drive);
    std::istringstream   in(text);
    std::string          torque;
    std::string          release;
    std::string          close;
    HoldingBrakeSettings brake;
    in >> torque >> release >> close;
    brake.torque_Nm = number(torque, brake_range_Nm, "holding_brake");
    if (brake.torque_Nm > 0.0) {
        brake.release_time_s = number(release, brake_range_s, "holding_brake's release time");
        brake.close_time_s   = number(close, brake_range_s, "holding_brake's close time");
    }
    drive.set_holding_brake(brake);
}

json state(const ServedDrive &drive, const ServerReport &server)
{
    const PlantState  &now    = drive.plant_state();
    const Dynamometer &load   = drive.dynamometer();
    json               answer = {{"drive", drive.drive().name},
                                 {"time_s", drive.time_s()},
                                 {"speed_e_radps", now.omega_e_radps},
                                 {"speed_rpm", rpm_of(drive, now.omega_e_radps)},
                                 {"pole_pairs", drive.drive().motor.pole_pairs},
                                 {"turns", drive.turns()},
                                 {"id_A", now.current_A.d},
                                 {"iq_A", now.current_A.q},
                                 {"torque_Nm", now.torque_Nm},
                                 {"load_Nm", load.torque_Nm()},
                                 {"load_kind", load.active() ? "active" : "brake"},
                                 {"load_most_Nm", load.most_Nm()},
                                 {"catch_speed_rpm", rpm_of(drive, load.catch_speed_e_radps())},
                                 {"catches", load.catches()},
                                 {"caught", load.caught()},
                                 {"dc_link_V", now.dc_link_V},
                                 {"source_V", drive.source_V()},
                                 {"bridge_on", drive.bridge_on()},
                                 {"holding_brake_closed", drive.brake_is_closed()},
                                 {"broken", broken(drive)},
                                 {"note", note(drive)},
                                 {"can_fault", can_fault(drive)},
                                 {"can_load", drive.can_bus().load()},
                                 {"resets", drive.resets()},
                                 {"speed_factor", server.pace.speed_factor()},
                                 {"real_time_factor", server.pace.real_time_factor()},
                                 {"slipped_s", server.pace.slipped_s()},
                                 {"findings", drive.findings()}};
    if (server.tcp_port) {
        answer["tcp_port"] = *server.tcp_port;
    }
    return answer;
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

/// Says when this fault can show; empty: now.
std::string needs(const InjectedFault &fault, const ServedDrive &drive)
{
    const PlantState &now      = drive.plant_state();
    const Motor      &motor    = drive.drive().motor;
    const double      telling  = telling_share * motor.max_current_A;
    const bool        currents = is_of_a_sensor(fault.kind) || fault.kind == FaultKind::phase_open;
    if (needs_processor(fault.kind)) {
        return "the watchdog resets the processor within 10 ms: see the reset cause";
    }
    if (!drive.bridge_on()) {
        return "it shows in a run: start the motor";
    }
    if (currents && fault.kind != FaultKind::current_drift &&
        std::hypot(now.current_A.d, now.current_A.q) < telling) {
        return fmt::format(
            "it shows under current: set a load that takes {:.2g} A or more, as \"load {:.2g}\"",
            telling, torque_Nm(motor, 0.0, telling));
    }
    if (!currents && std::abs(now.omega_e_radps) / motor.pole_pairs < turning_m_radps) {
        return "it shows when the shaft turns: raise the speed";
    }
    return "";
}

json break_part(const std::string &keys, ServedDrive &drive, const ServerReport &server)
{
    const InjectedFault fault = fault_of(keys);
    const std::string   wants = needs(fault, drive);
    drive.break_part(fault);
    json answer    = state(drive, server);
    answer["note"] = wants;
    return answer;
}

json answer(const std::string &word, const std::string &rest, ServedDrive &drive,
            const MotorRecord &record, const ServerReport &server)
{
    if (word == "load") {
        set_load(rest, drive.dynamometer());
    } else if (word == "dc_link") {
        drive.set_dc_link_V(number(rest, dc_link_range_V, "dc_link"));
    } else if (word == "fault") {
        return break_part(rest, drive, server);
    } else if (word == "can") {
        set_can_fault(rest, drive);
    } else if (word == "switch") {
        set_switch(rest, drive);
    } else if (word == "holding_brake") {
        set_holding_brake(rest, drive);
    } else if (word == "mend") {
        drive.mend();
    } else if (word == "power_cycle") {
        drive.power_cycle();
    } else if (word == "trace") {
        return trace(record, number(rest, {0.0, longest_record_s}, "trace"));
    } else if (word != "state") {
        throw InputError(fmt::format("\"{}\" is not a command: load, dc_link, fault, can, switch, "
                                     "holding_brake, mend, power_cycle, state, trace",
                                     word));
    }
    return state(drive, server);
}

} // namespace

std::string control_answer(const std::string &line, ServedDrive &drive, const MotorRecord &record,
                           const ServerReport &server)
{
    const std::size_t space = line.find(' ');
    const std::string word  = line.substr(0, space);
    const std::string rest  = space == std::string::npos ? "" : line.substr(space + 1);
    json              out;
    try {
        out = answer(word, rest, drive, record, server);
    } catch (const InputError &e) {
        out = {{"error", e.what()}};
    }
    return out.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

} // namespace sdre
