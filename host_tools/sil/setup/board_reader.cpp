// SPDX-License-Identifier: MIT
#include "sil/setup/board_reader.hpp"

#include <cmath>

#include <fmt/format.h>

#include "drive/drive_file.hpp"

namespace sdre {
namespace {

// Allowed values: wide enough for any board, narrow enough that a slipped unit is caught.
constexpr Range encoder_lines{1, 1e6};
constexpr Range eccentricity_rad{0.0, 0.5};
constexpr Range edge_error_cnt{-0.9, 0.9};
constexpr Range edge_jitter_cnt{0.0, 0.28};
constexpr Range jitter_repeats{0, 1000000};
constexpr Range map_error_cnt{0.0, 0.28};
constexpr Range angle_e_rad{-3.2, 3.2};
constexpr Range count_late_s{0.0, 1e-5};
constexpr Range adc_bits{4, 24};
constexpr Range current_A{1e-3, 1e4};
constexpr Range noise_A{0.0, 1e3};
constexpr Range offset_A{-1e3, 1e3};
constexpr Range gain{0.1, 10.0};
constexpr Range dc_link_V{1.0, 1e4};
constexpr Range dead_time_s{0.0, 2e-5};
constexpr Range drop_V{0.0, 20.0};
constexpr Range duty{0.0, 1.0};
constexpr Range resistance_Ohm{0.0, 1e3};
constexpr Range hysteresis_V{0.1, 1e3};
constexpr Range chopper_Ohm{0.1, 1e4};
constexpr Range ripple_V{0.0, 1e4};
constexpr Range ripple_Hz{1.0, 1e3};
constexpr Range capacitance_F{1e-6, 10.0};
constexpr Range torque_Nm{-1e5, 1e5};
constexpr Range positive_torque_Nm{0.0, 1e5};
constexpr Range cogging_order{1.0, 1e3};
constexpr Range stribeck_speed_m_radps{1e-3, 1e3};
constexpr Range inertia_share{0.01, 0.99};
constexpr Range stiffness_Nmprad{1e-3, 1e7};
constexpr Range damping_Nms{0.0, 1e3};
constexpr Range flux_share{-0.2, 0.2};
constexpr Range drift_per_s{-10.0, 10.0};
constexpr Range map_current_A{-1e4, 1e4};
constexpr Range map_inductance_H{1e-7, 10.0};
constexpr Range frequency_Hz{0.0, 1e3};
constexpr Range time_s{0.0, 1e4};

// Chosen: at 0.5 rad the integrator takes 1e-4 of an oscillation per step, less than a shaft does.
constexpr double most_rad_per_step = 0.5;

constexpr double two_pi = 6.28318530717958647693;

/// Points per axis of a saturation map; the least makes one cell.
const std::vector<std::size_t> axis_lengths{2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};

std::vector<double> read_axis(TomlReader &t, const char *key)
{
    std::vector<double> axis = t.numbers(key, axis_lengths, map_current_A);
    for (std::size_t i = 1; i < axis.size(); i++) {
        if (axis[i] <= axis[i - 1]) {
            t.fail(key, fmt::format("= [.. {:g}, {:g} ..] is not allowed: must increase",
                                    axis[i - 1], axis[i]));
        }
    }
    return axis;
}

SaturationMap read_saturation(TomlReader &t)
{
    SaturationMap map;
    map.id_A                = read_axis(t, "id_A");
    map.iq_A                = read_axis(t, "iq_A");
    const std::size_t cells = map.id_A.size() * map.iq_A.size();
    map.ld_H                = t.numbers("ld_H", {cells}, map_inductance_H);
    map.lq_H                = t.numbers("lq_H", {cells}, map_inductance_H);
    return map;
}

EncoderDiscSettings read_disc(TomlReader &t, EncoderDiscSettings s)
{
    s.quadrature_error_cnt =
        t.number_or("encoder_quadrature_error_cnt", edge_error_cnt, s.quadrature_error_cnt);
    s.duty_error_cnt = t.number_or("encoder_duty_error_cnt", edge_error_cnt, s.duty_error_cnt);
    s.jitter_rms_cnt = t.number_or("encoder_jitter_rms_cnt", edge_jitter_cnt, s.jitter_rms_cnt);
    s.jitter_repeats = t.integer_or("encoder_jitter_repeats", jitter_repeats, s.jitter_repeats);
    if (t.has("encoder_map_error_rms_cnt")) {
        s.map_error_rms_cnt = t.number("encoder_map_error_rms_cnt", map_error_cnt);
    }
    const double most_cnt = 0.5 * (std::abs(s.quadrature_error_cnt) + std::abs(s.duty_error_cnt)) +
                            std::sqrt(3.0) * s.jitter_rms_cnt;
    if (most_cnt >= 0.5) {
        t.fail("encoder_jitter_rms_cnt",
               fmt::format("is not allowed with the other errors: an edge would be off by {:.3g} "
                           "counts, must be below 0.5",
                           most_cnt));
    }
    return s;
}

void read_chopper(TomlReader &t, InverterSettings &s, const Drive &drive)
{
    if (t.has("chopper_on_V") && has_chopper(drive)) {
        t.fail("chopper_on_V",
               fmt::format("is not allowed: board \"{}\" has a chopper", drive.board.file->name));
    }
    if (t.has("chopper_on_V")) {
        s.chopper_on_V = t.number("chopper_on_V", dc_link_V);
    }
    s.chopper_hysteresis_V =
        t.number_or("chopper_hysteresis_V", hysteresis_V, s.chopper_hysteresis_V);
    s.chopper_resistance_Ohm =
        t.number_or("chopper_resistance_Ohm", chopper_Ohm, s.chopper_resistance_Ohm);
    const double source_V = s.dc_link_V.value_or(drive.inverter.dc_link_V);
    if (s.chopper_on_V && *s.chopper_on_V - s.chopper_hysteresis_V <= source_V) {
        t.fail("chopper_on_V",
               fmt::format("= {:g} is not allowed: less chopper_hysteresis_V = {:g} it must be "
                           "above the source's {:g} V",
                           *s.chopper_on_V, s.chopper_hysteresis_V, source_V));
    }
    if (s.chopper_on_V && s.regeneration == Regeneration::sinks && s.source_resistance_Ohm <= 0.0) {
        t.fail("chopper_on_V", "is not allowed with a stiff source: it needs regeneration = "
                               "\"blocks\" or a source_resistance_Ohm");
    }
}

void read_ripple(TomlReader &t, InverterSettings &s, const Drive &drive)
{
    s.ripple_V            = t.number_or("ripple_V", ripple_V, s.ripple_V);
    s.ripple_Hz           = t.number_or("ripple_Hz", ripple_Hz, s.ripple_Hz);
    const double source_V = s.dc_link_V.value_or(drive.inverter.dc_link_V);
    if (s.ripple_V >= source_V) {
        t.fail("ripple_V", fmt::format("= {:g} is not allowed: must be below the source's {:g} V",
                                       s.ripple_V, source_V));
    }
}

void read_friction(TomlReader &t, MotorEffects &e)
{
    e.coulomb_friction_Nm = t.number_or("coulomb_friction_Nm", positive_torque_Nm, 0.0);
    if (!t.has("static_friction_Nm") && !t.has("stribeck_speed_m_radps")) {
        return;
    }
    e.static_friction_Nm     = t.number("static_friction_Nm", positive_torque_Nm);
    e.stribeck_speed_m_radps = t.number("stribeck_speed_m_radps", stribeck_speed_m_radps);
    if (e.static_friction_Nm < e.coulomb_friction_Nm) {
        t.fail("static_friction_Nm",
               fmt::format("= {:g} is not allowed: must not be below coulomb_friction_Nm = {:g}",
                           e.static_friction_Nm, e.coulomb_friction_Nm));
    }
}

void read_shaft(TomlReader &t, MotorEffects &e)
{
    if (!t.has("load_inertia_share") && !t.has("shaft_stiffness_Nmprad") &&
        !t.has("shaft_damping_Nms")) {
        return;
    }
    e.load_inertia_share     = t.number("load_inertia_share", inertia_share);
    e.shaft_stiffness_Nmprad = t.number("shaft_stiffness_Nmprad", stiffness_Nmprad);
    e.shaft_damping_Nms      = t.number_or("shaft_damping_Nms", damping_Nms, 0.0);
}

} // namespace

SensorSettings sensors_of_drive(const Drive &drive)
{
    SensorSettings s;
    s.encoder_edge_time        = drive.encoder.edge_times;
    const DiscErrors &disc     = drive.encoder.disc;
    s.encoder_disc             = {disc.pattern_cnt, disc.pattern_cnt, disc.own_rms_cnt, 0};
    s.encoder_eccentricity_rad = disc.turn_cnt * two_pi / (4.0 * drive.encoder.lines);
    s.adc_bits                 = drive.current_sensors.adc_bits;
    s.adc_full_scale_A         = drive.current_sensors.range_A;
    s.adc_noise_rms_A          = drive.current_sensors.noise_rms_A;
    s.current_sensors          = drive.current_sensors.count;
    return s;
}

SensorSettings read_sensors(TomlReader t, SensorSettings s, const Drive &drive)
{
    s.ideal = t.boolean_or("ideal", s.ideal);
    if (t.has("encoder_lines")) {
        s.encoder_lines = t.integer("encoder_lines", encoder_lines);
    }
    s.encoder_index     = t.boolean_or("encoder_index", s.encoder_index);
    s.encoder_edge_time = t.boolean_or("encoder_edge_time", s.encoder_edge_time);
    s.encoder_dead      = t.boolean_or("encoder_dead", s.encoder_dead);
    s.encoder_eccentricity_rad =
        t.number_or("encoder_eccentricity_rad", eccentricity_rad, s.encoder_eccentricity_rad);
    s.encoder_offset_e_rad =
        t.number_or("encoder_offset_e_rad", angle_e_rad, s.encoder_offset_e_rad);
    s.encoder_count_late_s =
        t.number_or("encoder_count_late_s", count_late_s, s.encoder_count_late_s);
    s.encoder_disc     = read_disc(t, s.encoder_disc);
    s.adc_bits         = t.integer_or("adc_bits", adc_bits, s.adc_bits);
    s.adc_full_scale_A = t.number_or("adc_full_scale_A", current_A, s.adc_full_scale_A);
    s.adc_noise_rms_A  = t.number_or("adc_noise_rms_A", noise_A, s.adc_noise_rms_A);
    s.adc_offset_a_A   = t.number_or("adc_offset_a_A", offset_A, s.adc_offset_a_A);
    s.adc_offset_b_A   = t.number_or("adc_offset_b_A", offset_A, s.adc_offset_b_A);
    s.adc_gain_a       = t.number_or("adc_gain_a", gain, s.adc_gain_a);
    s.adc_gain_b       = t.number_or("adc_gain_b", gain, s.adc_gain_b);
    if (s.current_sensors == 3) {
        s.adc_offset_c_A = t.number_or("adc_offset_c_A", offset_A, s.adc_offset_c_A);
        s.adc_gain_c     = t.number_or("adc_gain_c", gain, s.adc_gain_c);
    }
    const Range half_period_s{0.0, 0.5 * control_period_s(drive)};
    s.sampling_advance_s = t.number_or("sampling_advance_s", half_period_s, s.sampling_advance_s);
    t.reject_unknown_keys();
    return s;
}

InverterSettings read_board_inverter(TomlReader t, InverterSettings s, const Drive &drive)
{
    if (t.has("dc_link_V")) {
        s.dc_link_V = t.number("dc_link_V", dc_link_V);
    }
    const std::string model =
        t.text_or("model", s.model == InverterModel::switched ? "switched" : "averaged");
    if (model != "averaged" && model != "switched") {
        t.fail("model",
               fmt::format("= \"{}\" is not allowed: must be \"averaged\" or \"switched\"", model));
    }
    s.model = model == "switched" ? InverterModel::switched : InverterModel::averaged;
    if (t.has("dead_time_s")) {
        s.dead_time_s = t.number("dead_time_s", dead_time_s);
        if (*s.dead_time_s * drive.inverter.pwm_frequency_Hz > 0.1) {
            t.fail("dead_time_s", "is not allowed: must be at most a tenth of the PWM period");
        }
    }
    s.switch_drop_V = t.number_or("switch_drop_V", drop_V, s.switch_drop_V);
    s.diode_drop_V  = t.number_or("diode_drop_V", drop_V, s.diode_drop_V);
    s.duty_min      = t.number_or("duty_min", duty, s.duty_min);
    s.duty_max      = t.number_or("duty_max", duty, s.duty_max);
    if (s.duty_min >= s.duty_max) {
        t.fail("duty_min", fmt::format("= {:g} is not allowed: must be below duty_max = {:g}",
                                       s.duty_min, s.duty_max));
    }
    s.source_resistance_Ohm =
        t.number_or("source_resistance_Ohm", resistance_Ohm, s.source_resistance_Ohm);
    s.capacitance_F = t.number_or("capacitance_F", capacitance_F, s.capacitance_F);
    const std::string regeneration =
        t.text_or("regeneration", s.regeneration == Regeneration::blocks ? "blocks" : "sinks");
    if (regeneration != "blocks" && regeneration != "sinks") {
        t.fail(
            "regeneration",
            fmt::format("= \"{}\" is not allowed: must be \"blocks\" or \"sinks\"", regeneration));
    }
    s.regeneration = regeneration == "blocks" ? Regeneration::blocks : Regeneration::sinks;
    read_ripple(t, s, drive);
    read_chopper(t, s, drive);
    t.reject_unknown_keys();
    return s;
}

MotorEffects effects_of_drive(const Drive &drive, double inertia_factor)
{
    const Mechanics &m = drive.mechanics;
    MotorEffects     e;
    if (m.coupling == Coupling::known) {
        const double reduced_kgm2 = m.load_inertia_share * (1.0 - m.load_inertia_share) *
                                    inertia_factor * drive.motor.inertia_kgm2;
        const double w_r         = two_pi * m.resonance_Hz;
        e.load_inertia_share     = m.load_inertia_share;
        e.shaft_stiffness_Nmprad = w_r * w_r * reduced_kgm2;
        e.shaft_damping_Nms      = 2.0 * m.least_damping * w_r * reduced_kgm2;
    }
    return e;
}

MotorEffects read_motor_effects(TomlReader t, MotorEffects e)
{
    if (t.has("id_A") || t.has("iq_A") || t.has("ld_H") || t.has("lq_H")) {
        e.saturation = read_saturation(t);
    }
    e.cogging_amplitude_Nm = t.number_or("cogging_amplitude_Nm", positive_torque_Nm, 0.0);
    if (e.cogging_amplitude_Nm > 0.0 || t.has("cogging_order")) {
        e.cogging_order =
            t.number("cogging_order", cogging_order); // no motor-independent default exists
        e.cogging_second_Nm  = t.number_or("cogging_second_Nm", positive_torque_Nm, 0.0);
        e.cogging_second_rad = t.number_or("cogging_second_rad", angle_e_rad, 0.0);
    }
    read_friction(t, e);
    read_shaft(t, e);
    e.flux_5th           = t.number_or("flux_5th", flux_share, 0.0);
    e.flux_7th           = t.number_or("flux_7th", flux_share, 0.0);
    e.iron_hysteresis_Nm = t.number_or("iron_hysteresis_Nm", positive_torque_Nm, 0.0);
    e.iron_eddy_Nms      = t.number_or("iron_eddy_Nms", damping_Nms, 0.0);
    e.resistance_drift   = t.number_or("resistance_drift", drift_per_s, 0.0);
    e.flux_drift         = t.number_or("flux_drift", drift_per_s, 0.0);
    t.reject_unknown_keys();
    return e;
}

void require_magnet(const TomlReader &t, const MotorEffects &e, const Drive &drive)
{
    if (drive.motor.pm_flux_Wb == 0.0 && (e.iron_hysteresis_Nm != 0.0 || e.iron_eddy_Nms != 0.0)) {
        t.fail("motor_effects", "iron_hysteresis_Nm and iron_eddy_Nms are not allowed: they are "
                                "the drag at the magnet's flux, and this motor has no magnet");
    }
}

void require_slow_shaft(const TomlReader &t, const MotorEffects &e, const Drive &drive,
                        const MotorScale &scale)
{
    if (e.load_inertia_share == 0.0) {
        return;
    }
    // J_m J_l / (J_m + J_l)
    const double reduced_kgm2 = e.load_inertia_share * (1.0 - e.load_inertia_share) *
                                scaled(drive.motor, scale).inertia_kgm2;
    const double step_s  = 0.5 * control_period_s(drive); // of the plant
    const double spring  = std::sqrt(e.shaft_stiffness_Nmprad / reduced_kgm2) * step_s;
    const double damping = e.shaft_damping_Nms / reduced_kgm2 * step_s;
    if (spring > most_rad_per_step || damping > most_rad_per_step) {
        t.fail(
            "motor_effects",
            fmt::format("{} is not allowed: with {:.3g} kg m2 at both ends the shaft is too "
                        "quick for steps of {:g} s",
                        spring > most_rad_per_step ? "shaft_stiffness_Nmprad" : "shaft_damping_Nms",
                        reduced_kgm2, step_s));
    }
}

LoadSine read_load_sine(TomlReader t, LoadSine s)
{
    s.amplitude_Nm = t.number_or("amplitude_Nm", torque_Nm, s.amplitude_Nm);
    s.frequency_Hz = t.number_or("frequency_Hz", frequency_Hz, s.frequency_Hz);
    s.start_s      = t.number_or("start_s", time_s, s.start_s);
    t.reject_unknown_keys();
    return s;
}

std::vector<LoadRamp> read_load_ramps(TomlReader &t)
{
    std::vector<LoadRamp> ramps;
    for (TomlReader &entry : t.tables("load_ramp")) {
        const LoadRamp r{entry.number("time_s", time_s), entry.number("until_s", time_s),
                         entry.number("to_Nm", torque_Nm)};
        if (r.until_s <= r.time_s) {
            entry.fail("until_s",
                       fmt::format("= {:g} is not allowed: must be later than time_s = {:g}",
                                   r.until_s, r.time_s));
        }
        if (!ramps.empty() && r.time_s < ramps.back().until_s) {
            entry.fail("time_s", fmt::format("= {:g} is not allowed: the ramp before ends at {:g}",
                                             r.time_s, ramps.back().until_s));
        }
        entry.reject_unknown_keys();
        ramps.push_back(r);
    }
    return ramps;
}

} // namespace sdre
