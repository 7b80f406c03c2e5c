// SPDX-License-Identifier: MIT
#include "drive/drive_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/toml_reader.hpp"
#include "drive/law_sections.hpp"
#include "drive/mtpa_fit.hpp"
#include "drive/pwm_frequency.hpp"
#include "drive/saturation_section.hpp"

namespace sdre {
namespace {

// Allowed values. They are wide enough for any drive from a model motor to a locomotive. They are
// narrow enough to find a wrong unit (mH, rpm, g cm^2).
constexpr Range resistance_Ohm{1e-5, 1e3};
constexpr Range inductance_H{1e-7, 10.0};
constexpr Range flux_Wb{0.0, 10.0};
constexpr Range inertia_kgm2{1e-9, 1e3};
constexpr Range friction_Nms{0.0, 1e2};
constexpr Range torque_Nm{1e-5, 1e5};
constexpr Range current_A{1e-3, 1e4};
constexpr Range dc_link_V{1.0, 1e4};
constexpr Range dead_time_s{0.0, 2e-5};
constexpr Range encoder_lines{1, 1e6};
constexpr Range pattern_cnt{0.0, 0.8};
constexpr Range own_rms_cnt{0.0, 0.28};
constexpr Range state_width_deg{0.0, 80.0};
constexpr Range turn_cnt{0.0, 100.0};
constexpr Range slots{3, 1000};
constexpr Range angle_e_rad{0.0, 6.283185};
constexpr Range adc_bits{8, 16};
constexpr Range sensor_count{2, 3};
constexpr Range noise_A{0.0, 1e2};

// Chosen: a trip at twice the limit is then seen. The 390 W motor's board has +-10 A.
constexpr double range_per_limit = 2.5;
// Chosen: two codes of 12 bits, a Hall sensor with its amplifier.
constexpr double noise_per_range = 1e-3;
// Chosen: room for what the speed does beyond a reference that is the largest command.
constexpr double trip_per_max_speed = 1.2;
// Chosen: the flux-weakening range of the shipped motors ends below twice the rated speed.
constexpr double trip_per_rated_speed = 3.0;

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
    m.rated_speed_e_radps   = t.number("rated_speed_e_radps", allowed_speed_e_radps);
    m.rated_torque_Nm       = t.number("rated_torque_Nm", torque_Nm);
    m.max_current_A         = t.number("max_current_A", current_A);
    if (t.has("max_speed_e_radps")) {
        m.max_speed_e_radps = t.number("max_speed_e_radps", allowed_speed_e_radps);
    }
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

DcLinkSink read_regeneration(TomlReader &t)
{
    constexpr std::array all{DcLinkSink::none, DcLinkSink::brake_chopper, DcLinkSink::supply};
    const std::string    name = t.text_or("regeneration", dc_link_sink_name(DcLinkSink::none));
    for (const DcLinkSink sink : all) {
        if (name == dc_link_sink_name(sink)) {
            return sink;
        }
    }
    t.fail("regeneration", fmt::format("= \"{}\" is not allowed: must be \"none\", "
                                       "\"brake_chopper\" or \"supply\"",
                                       name));
}

Inverter read_inverter(TomlReader t)
{
    Inverter inverter;
    inverter.dc_link_V              = t.number("dc_link_V", dc_link_V);
    inverter.pwm_wanted_Hz          = t.number("pwm_frequency_Hz");
    inverter.dead_time_s            = t.number("dead_time_s", dead_time_s);
    inverter.updates_per_period     = t.integer_or("updates_per_period", {1, 2}, 1);
    inverter.dead_time_compensation = t.boolean_or("dead_time_compensation", true);
    inverter.overmodulation         = t.boolean_or("overmodulation", false);
    inverter.regeneration           = read_regeneration(t);
    t.reject_unknown_keys();
    return inverter;
}

// A state of 90 degrees lies between two edges, each evenly distributed over +- sqrt(3) own_rms_cnt.
// Its width is off by twice that at most.
double own_rms_of_state_width_cnt(double state_width_error_deg)
{
    return state_width_error_deg / 90.0 / (2.0 * std::sqrt(3.0));
}

DiscErrors read_disc_errors(std::optional<TomlReader> t)
{
    DiscErrors disc;
    if (!t) {
        return disc;
    }
    disc.pattern_cnt = t->number_or("pattern_cnt", pattern_cnt, disc.pattern_cnt);
    if (t->has("state_width_error_deg")) {
        if (t->has("own_rms_cnt")) {
            t->fail("own_rms_cnt", "is not allowed beside state_width_error_deg: give one of them");
        }
        disc.own_rms_cnt =
            own_rms_of_state_width_cnt(t->number("state_width_error_deg", state_width_deg));
    } else {
        disc.own_rms_cnt = t->number_or("own_rms_cnt", own_rms_cnt, disc.own_rms_cnt);
    }
    disc.turn_cnt         = t->number_or("turn_cnt", turn_cnt, disc.turn_cnt);
    const double most_cnt = disc.pattern_cnt + std::sqrt(3.0) * disc.own_rms_cnt;
    if (most_cnt >= 0.5) {
        t->fail("pattern_cnt", fmt::format("is not allowed with these own errors: an edge would be "
                                           "off by {:.3g} counts, must be below 0.5",
                                           most_cnt));
    }
    t->reject_unknown_keys();
    return disc;
}

Encoder read_encoder(TomlReader t)
{
    Encoder encoder;
    encoder.lines             = t.integer("lines", encoder_lines);
    encoder.edge_times        = t.boolean_or("edge_times", false);
    encoder.index_angle_e_rad = t.number_or("index_angle_e_rad", angle_e_rad, 0.0);
    encoder.disc              = read_disc_errors(t.table_if("disc"));
    t.reject_unknown_keys();
    return encoder;
}

CurrentSensors read_current_sensors(std::optional<TomlReader> t, const Motor &motor,
                                    const std::optional<BoardFile> &board)
{
    CurrentSensors s = default_current_sensors(motor);
    s.range_A        = board ? (*board)[BOARD_FACT_CURRENT_RANGE_A] : s.range_A;
    s.count          = board ? static_cast<int>((*board)[BOARD_FACT_CURRENT_SENSORS]) : s.count;
    if (t) {
        s.range_A =
            board_number(*t, "range_A", current_A, board, BOARD_FACT_CURRENT_RANGE_A, s.range_A);
        s.adc_bits = t->integer_or("adc_bits", adc_bits, s.adc_bits);
        const double count =
            board_number(*t, "count", sensor_count, board, BOARD_FACT_CURRENT_SENSORS, s.count);
        if (count != std::floor(count)) {
            t->fail("count", fmt::format("= {:g} is not allowed: must be 2 or 3", count));
        }
        s.count = static_cast<int>(count);
    }
    s.noise_rms_A = noise_per_range * s.range_A;
    if (t) {
        s.noise_rms_A = t->number_or("noise_rms_A", noise_A, s.noise_rms_A);
        t->reject_unknown_keys();
        if (s.range_A < motor.max_current_A) {
            t->fail("range_A", fmt::format("= {:g} is not allowed: must not be below [motor] "
                                           "max_current_A = {:g}",
                                           s.range_A, motor.max_current_A));
        }
    }
    return s;
}

/// Its law says how many cycles a control period takes.
void settle_pwm_frequency(const TomlReader &t, Drive &drive) // EQ-BOARD-1
{
    const Processor  &p       = processor_of(drive);
    Inverter         &i       = drive.inverter;
    const std::string refusal = pwm_refusal(drive, i.pwm_wanted_Hz);
    if (!refusal.empty()) {
        t.fail("[inverter] pwm_frequency_Hz", refusal);
    }
    i.pwm_frequency_Hz = counted_pwm_Hz(p, pwm_full_cnt(p, i.pwm_wanted_Hz));
    if (i.dead_time_s * i.pwm_frequency_Hz > 0.1) {
        t.fail("[inverter] dead_time_s",
               "is not allowed: must be at most a tenth of the PWM period");
    }
}

/// A law with a d-current reference gets the curve of the map.
void fit_to_iron(Drive &drive)
{
    if (drive.saturation && is_near_optimal(drive.law)) {
        const bool printed = drive.law == Law::conventional_noc ||
                             (drive.law == Law::noc && drive.nodo.form == NodoForm::speed);
        drive.motor.mtpa = fit_mtpa(*drive.saturation, drive.motor,
                                    printed ? MtpaForms::second_order : MtpaForms::both);
    } else if (drive.saturation && is_cascade(drive.law)) {
        drive.motor.mtpa = fit_mtpa(*drive.saturation, drive.motor, MtpaForms::exact);
    }
}

/// It stands in generated comments: one line of plain text.
std::string read_reproduces(TomlReader &t)
{
    constexpr std::size_t longest = 60; // chosen: a source and a place in it
    const std::string     text    = t.text_or("reproduces", "");
    const bool            plain   = std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == ' ' || c == '.' || c == ',' || c == '-';
    });
    if (!plain || text.size() > longest) {
        t.fail("reproduces",
               fmt::format("must be at most {} letters, digits, spaces, '.', ',' or '-'", longest));
    }
    return text;
}

Drive read_drive(const toml::table &root, const std::string &source, const std::string &file)
{
    TomlReader t(source, "", root);
    Drive      drive;
    const int  schema = t.integer("schema", {0, 1e6});
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
    drive.reproduces = read_reproduces(t);
    drive.motor      = read_motor(t.table("motor"));
    drive.saturation = read_saturation(t.table_if("saturation"), drive.motor);
    drive.inverter   = read_inverter(t.table("inverter"));
    drive.encoder    = read_encoder(t.table("encoder"));
    drive.board      = read_board(t.table_if("board"), drive.motor, drive.inverter, file);
    drive.current_sensors =
        read_current_sensors(t.table_if("current_sensors"), drive.motor, drive.board.file);
    drive.law = read_law(t);
    read_law_sections(t, drive);
    fit_to_iron(drive);
    drive.uncertainty = read_uncertainty(t.table_if("uncertainty"));
    drive.mechanics   = read_mechanics(t.table_if("mechanics"));
    if (drive.law == Law::noc_shaft && drive.mechanics.coupling != Coupling::known) {
        t.fail("[mechanics]", "needs resonance_Hz: noc_shaft is for a known one");
    }
    t.reject_unknown_keys();
    settle_pwm_frequency(t, drive);
    if (const auto [key, why] = board_refusal(drive); !key.empty()) {
        t.fail(key, why);
    }
    return drive;
}

} // namespace

Drive read_drive_file(const std::filesystem::path &file)
{
    return read_drive(parse_toml_file(file), file.string(), file.string());
}

Drive read_drive_text(const std::string &text, const std::string &source, const std::string &file)
{
    return read_drive(parse_toml_text(text, source), source, file.empty() ? source : file);
}

CurrentSensors default_current_sensors(const Motor &motor)
{
    const double range_A = range_per_limit * motor.max_current_A;
    return {range_A, noise_per_range * range_A};
}

FluxScale flux_scale(const Motor &from, const Motor &to)
{
    return {from.pm_flux_Wb > 0.0 ? to.pm_flux_Wb / from.pm_flux_Wb : 1.0,
            to.d_axis_inductance_H / from.d_axis_inductance_H,
            to.q_axis_inductance_H / from.q_axis_inductance_H};
}

SaturatedMotor saturated_motor(const Drive &drive, const Motor &now)
{
    return {drive.saturation, flux_scale(drive.motor, now)};
}

const char *dc_link_sink_name(DcLinkSink sink)
{
    return sink == DcLinkSink::brake_chopper ? "brake_chopper"
           : sink == DcLinkSink::supply      ? "supply"
                                             : "none";
}

double control_period_s(const Drive &drive)
{
    return 1.0 / (drive.inverter.pwm_frequency_Hz * drive.inverter.updates_per_period);
}

double count_e_rad(const Drive &drive)
{
    return 4.0 * std::acos(0.0) * drive.motor.pole_pairs / (4.0 * drive.encoder.lines);
}

double trip_speed_e_radps(const Drive &drive)
{
    const Motor &m = drive.motor;
    return m.max_speed_e_radps > 0.0 ? trip_per_max_speed * m.max_speed_e_radps
                                     : trip_per_rated_speed * m.rated_speed_e_radps;
}

double encoder_edges_Hz(const Drive &drive)
{
    return trip_speed_e_radps(drive) / count_e_rad(drive);
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
