// SPDX-License-Identifier: MIT
#include "design/board/board_constants.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/board/align_design.hpp"
#include "design/motor_model.hpp"
#include "design/sampled_model.hpp"
#include "design/trip_levels.hpp"
#include "drive/core_types.hpp"
#include "drive/pwm_frequency.hpp"

namespace sdre {
namespace {

constexpr double pi         = 3.14159265358979323846;
constexpr double same_ratio = 1e-4; // what the application takes for the same number

// Twice the 41 codes of a sensor that is off by 1 % of its range.
constexpr double zero_drift_share = 0.02;
// The mark is up to one line wide and is entered from either side.
constexpr int index_tolerance_cnt = 4;
// Chosen: costs 0.8 % of the torque.
constexpr double index_correct_e_rad = 0.126;
// Chosen: eight times the change per period by torque, an equal load and the disc. The lower bound
// is the noise of the lines in a period.
constexpr double jump_ratio = 8.0;
constexpr double disc_cnt   = 0.35;
constexpr double jump_least = 16.0;
// Chosen: a fifth of the quarter turn that alignment has to see.
constexpr double quarter_error = 0.2;
// Chosen: what is on a name plate is borne at 40 degC ambient; a tenth more at less.
constexpr double continuous_per_rated = 1.1;
// Chosen: 20 rad/s of the 390 W motor's 523.
constexpr double still_per_rated = 20.0 / 523.0;

// Times [ms]. Filters of the analog inputs have 1 ms. 256 ms average 2 codes of noise to 0.06
// codes. A pass of the background is below 1 ms, and the watchdog resets after 4.4. Five polls at
// 10 Hz may be lost.
constexpr double boot_ms       = 50.0;
constexpr double calibrate_ms  = 256.0;
constexpr double background_ms = 3.0;
constexpr double timeout_ms    = 500.0;
constexpr double gap_ms        = 1.75; // by the protocol at 115200 Bd
// Alignment: watch finds shafts that turn by more than four counts in a tenth of a second.
constexpr double watch_s     = 0.1;
constexpr double still_s     = 0.1;
constexpr double ramp_share  = 0.25; // of the time to settle
constexpr int    still_cnt   = 4;
constexpr double sweep_share = 1.0;

// The sensor's table: a point every 128 codes from 512 to 3968.
constexpr int    ntc_first_cnt = 512;
constexpr int    ntc_step_cnt  = 128;
constexpr double ntc_25_degC_K = 298.15;
constexpr double zero_degC_K   = 273.15;

[[noreturn]] void refuse(const Drive &d, const std::string &what)
{
    throw InputError(
        fmt::format("a board with the processor {} cannot have {}", processor_of(d).name, what));
}

double offset_max_cnt(const Drive &d)
{
    return d.board.file ? d.board.file->offset_max_cnt : BoardFile{}.offset_max_cnt;
}

double codes_of(const Drive &d)
{
    return std::exp2(processor_of(d).adc_bits);
}

std::uint16_t ticks16(double seconds, double pwm_Hz)
{
    return static_cast<std::uint16_t>(std::min(std::lround(seconds * pwm_Hz), 65535L));
}

std::uint32_t ticks32(double seconds, double pwm_Hz)
{
    return static_cast<std::uint32_t>(std::lround(seconds * pwm_Hz));
}

/// A drive that was read has a frequency of the counter; one that was changed since may not.
std::uint16_t full_cnt(const Drive &d)
{
    const Processor &p      = processor_of(d);
    const double     pwm_Hz = d.inverter.pwm_frequency_Hz;
    const double     full   = pwm_full_cnt(p, pwm_Hz);
    if (full < 1.0 || full > 65535.0 || counted_pwm_Hz(p, full) != pwm_Hz) {
        refuse(d, fmt::format("[inverter] pwm_frequency_Hz = {:.7g}: the nearest that its counter "
                              "has is {:.7g}",
                              pwm_Hz, counted_pwm_Hz(p, full)));
    }
    return static_cast<std::uint16_t>(full);
}

board_setup_t setup_of(const Drive &d) // EQ-BOARD-1
{
    const Processor &p = processor_of(d);
    board_setup_t    s{};
    s.duty_full_cnt = full_cnt(d);
    s.pwm_cycles    = static_cast<std::uint32_t>(p.cycles_per_cnt() * s.duty_full_cnt);
    // No less than asked for; the last digit of a product is no count.
    const double                wanted = d.inverter.dead_time_s * p.counter_Hz - same_ratio;
    const std::optional<double> dead   = p.dead_time_cnt(wanted);
    if (wanted <= 0.0 || !dead) {
        refuse(d, fmt::format("[inverter] dead_time_s = {:g}: must be {:.2g} .. {:.4g}",
                              d.inverter.dead_time_s, p.least_dead_time_cnt() / p.counter_Hz,
                              p.most_dead_time_cnt() / p.counter_Hz));
    }
    s.dead_time_cnt = static_cast<std::uint16_t>(*dead);
    if (4 * d.encoder.lines > p.most_positions) {
        refuse(d, fmt::format("[encoder] lines = {}: at most {}", d.encoder.lines,
                              p.most_positions / 4));
    }
    s.positions       = static_cast<std::uint16_t>(4 * d.encoder.lines);
    s.current_sensors = static_cast<std::uint16_t>(d.current_sensors.count);
    s.chopper         = has_chopper(d) ? 1U : 0U;
    return s;
}

app_scale_config_t scale_of(const Drive &d) // EQ-BOARD-2
{
    if (d.current_sensors.adc_bits != processor_of(d).adc_bits) {
        refuse(d, fmt::format("[current_sensors] adc_bits = {}: its converter has {}",
                              d.current_sensors.adc_bits, processor_of(d).adc_bits));
    }
    const double       codes = codes_of(d);
    app_scale_config_t s{};
    s.current_A_per_cnt = single(2.0 * d.current_sensors.range_A / codes);
    s.current_zero_cnt  = single(codes / 2.0);
    s.offset_max_cnt    = single(offset_max_cnt(d));
    s.dc_link_V_per_cnt = single(d.board.dc_link_range_V / codes);
    s.ntc_first_cnt     = ntc_first_cnt;
    s.ntc_step_cnt      = ntc_step_cnt;
    s.ntc_points        = ntc_points;
    return s;
}

/// code / codes = R / (R + divider), R = R25 exp(B (1 / T - 1 / 298.15 K)); to a hundredth of a degree. EQ-BOARD-4
std::array<float, ntc_points> temperatures(const Drive &d)
{
    const BoardDescription       &b     = d.board;
    const double                  codes = codes_of(d);
    std::array<float, ntc_points> out{};
    for (std::size_t n = 0; n < ntc_points; n++) {
        const double code  = ntc_first_cnt + ntc_step_cnt * static_cast<double>(n);
        const double r_Ohm = b.ntc_divider_Ohm * code / (codes - code);
        const double per_K =
            1.0 / ntc_25_degC_K + std::log(r_Ohm / b.ntc_resistance_Ohm) / b.ntc_beta_K;
        const double degC = 1.0 / std::max(per_K, 1e-3) - zero_degC_K;
        out.at(n)         = single(0.01 * std::round(100.0 * degC));
    }
    if (out.front() > 300.0F || out.back() < -100.0F) {
        refuse(d,
               "[board] ntc_beta_K with these resistances: its table would leave -100 .. 300 degC");
    }
    return out;
}

app_angle_config_t angle_of(const Drive &d) // EQ-BOARD-5
{
    const Motor            &m       = d.motor;
    const double            turn    = 4.0 * d.encoder.lines;
    const double            per_rad = turn / (2.0 * pi);
    const ReducedParameters l       = reduced_parameters(m);
    const double            iq_A    = mtpa_iq_A(m, l, 1e9, m.max_current_A);
    const double            ts_s    = control_period_s(d);
    const double            most    = torque_Nm(m, mtpa_id_A(l, iq_A), iq_A);
    const double            change  = 2.0 * most / m.inertia_kgm2 * ts_s * ts_s * per_rad;
    app_angle_config_t      a{};
    a.index_theta_e_rad     = single(d.encoder.index_angle_e_rad);
    a.index_tolerance_cnt   = index_tolerance_cnt;
    a.index_correct_max_cnt = static_cast<std::uint16_t>(
        std::max(std::floor(index_correct_e_rad * per_rad / m.pole_pairs),
                 static_cast<double>(index_tolerance_cnt)));
    a.jump_cnt = static_cast<std::uint16_t>(
        std::min(std::max(std::ceil(jump_ratio * (change + disc_cnt)), jump_least), 0.25 * turn));
    return a;
}

app_align_config_t align_of(const Drive &d, double pwm_Hz)
{
    const AlignDesign  design = align_design(d);
    app_align_config_t a{};
    a.current_A       = single(design.current_A);
    a.bandwidth_radps = single(design.bandwidth_radps);
    a.theta_e_rad     = single(design.theta_e_rad);
    a.watch_ticks     = ticks32(watch_s, pwm_Hz);
    a.ramp_ticks      = ticks32(ramp_share * design.settle_s, pwm_Hz);
    a.sweep_ticks     = ticks32(sweep_share * design.settle_s, pwm_Hz);
    a.settle_ticks    = ticks32(design.settle_s, pwm_Hz);
    a.still_ticks     = ticks32(still_s, pwm_Hz);
    a.still_cnt       = still_cnt;
    a.quarter_error_cnt =
        static_cast<std::uint16_t>(quarter_error * d.encoder.lines / d.motor.pole_pairs);
    return a;
}

/// Shunts carry the currents while all lower switches are on, around the instant of the samples. Before it lie the dead time
/// and the amplifiers' time to settle. EQ-BOARD-8
double most_duty_cnt(const Drive &d, const board_setup_t &s)
{
    const double of_supplies = std::floor(d.board.duty_max * s.duty_full_cnt);
    const double settle_s    = d.board.file ? d.board.file->current_settle_s : 0.0;
    if (settle_s <= 0.0) {
        return of_supplies;
    }
    const double settle = std::ceil(settle_s * processor_of(d).counter_Hz - same_ratio);
    const double most =
        std::min(of_supplies, static_cast<double>(s.duty_full_cnt - s.dead_time_cnt) - settle);
    if (most < 0.5 * s.duty_full_cnt) { // app_gate.c takes no less
        refuse(d, fmt::format("[inverter] pwm_frequency_Hz = {:.7g}: dead time and "
                              "current_settle_s leave a duty of {:.2g}, at least 0.5",
                              d.inverter.pwm_frequency_Hz, std::max(most, 0.0) / s.duty_full_cnt));
    }
    return most;
}

app_gate_config_t gate_of(const Drive &d, const board_setup_t &s, double pwm_Hz)
{
    const Motor      &m = d.motor;
    app_gate_config_t g{};
    g.precharge_ticks = ticks16(d.board.precharge_s, pwm_Hz);
    // The shorted motor's current, flux omega / R, stays within the limit.
    g.precharge_speed_e_radps = single(
        d.board.precharge_s > 0.0
            ? std::min(m.max_current_A * m.stator_resistance_Ohm / std::max(m.pm_flux_Wb, 1e-9),
                       trip_speed_e_radps(d))
            : 0.0);
    g.duty_max_cnt  = static_cast<std::uint16_t>(most_duty_cnt(d, s));
    g.pulse_min_cnt = static_cast<std::uint16_t>(
        std::min(std::ceil(d.board.pulse_min_s * processor_of(d).counter_Hz),
                 std::floor(0.25 * s.duty_full_cnt)));
    return g;
}

app_watch_heat_config_t heat_of(const Drive &d)
{
    const Motor            &m       = d.motor;
    const ReducedParameters l       = reduced_parameters(m);
    const double            iq_A    = mtpa_iq_A(m, l, m.rated_torque_Nm, m.max_current_A);
    const double            rated_A = std::hypot(iq_A, mtpa_id_A(l, iq_A));
    return {single(d.board.motor_current_A.value_or(continuous_per_rated * rated_A)),
            single(d.board.motor_time_constant_s), single(d.board.inverter_current_A),
            single(d.board.inverter_time_constant_s)};
}

/// EQ-BOARD-7.
app_chopper_config_t chopper_of(const Drive &d)
{
    app_chopper_config_t c{};
    if (!has_chopper(d)) {
        return c;
    }
    const BoardFile &b         = *d.board.file;
    const double     cnt_per_V = codes_of(d) / d.board.dc_link_range_V;
    c.on_cnt  = static_cast<std::uint16_t>(std::lround(b[BOARD_FACT_CHOPPER_ON_V] * cnt_per_V));
    c.off_cnt = static_cast<std::uint16_t>(std::lround(b[BOARD_FACT_CHOPPER_OFF_V] * cnt_per_V));
    c.per_V2 = single(1.0 / (b[BOARD_FACT_CHOPPER_RESISTANCE_Ohm] * b[BOARD_FACT_CHOPPER_POWER_W]));
    c.tau_s  = single(b[BOARD_FACT_CHOPPER_TIME_CONSTANT_s]);
    return c;
}

} // namespace

double largest_trip_current_A(const Drive &drive)
{
    // Less the zero's largest error, and a code.
    const double shown = drive.current_sensors.range_A *
                         (1.0 - 2.0 * (offset_max_cnt(drive) + 2.0) / codes_of(drive));
    return drive.board.file ? std::min(shown, (*drive.board.file)[BOARD_FACT_TRIP_CURRENT_A])
                            : shown;
}

double largest_trip_dc_link_V(const Drive &drive)
{
    const double codes = codes_of(drive);
    const double shown = drive.board.dc_link_range_V * (codes - 1.0) / codes;
    return drive.board.file ? std::min(shown, (*drive.board.file)[BOARD_FACT_RATED_DC_LINK_V])
                            : shown;
}

BoardConstants board_constants(const Drive &d)
{
    const double   pwm_Hz = d.inverter.pwm_frequency_Hz;
    BoardConstants out;
    app_config_t  &c     = out.config;
    c.board              = setup_of(d);
    c.pwm_period_s       = single(1.0 / pwm_Hz);
    c.dead_time_s        = single(d.inverter.dead_time_s);
    c.scale              = scale_of(d);
    out.ntc_degC         = temperatures(d);
    out.drive_name       = d.name;
    out.digest           = drive_digest(d);
    c.angle              = angle_of(d);
    c.align              = align_of(d, pwm_Hz);
    c.gate               = gate_of(d, c.board, pwm_Hz);
    c.stop.reaction      = d.board.stop == StopReaction::brake ? APP_STOP_RAMP : APP_STOP_COAST;
    c.stop.still_e_radps = single(still_per_rated * d.motor.rated_speed_e_radps);
    c.stop.short_circuit = true; // whatever takes the energy: it need not take that of any speed
    c.heat               = heat_of(d);
    c.chopper            = chopper_of(d);
    c.zero_drift_A       = single(zero_drift_share * 2.0 * d.current_sensors.range_A);
    c.temperature_limit_degC = single(d.board.temperature_limit_degC);
    c.temperature_trip_degC  = single(d.board.temperature_trip_degC);
    c.boot_ticks             = ticks16(1e-3 * boot_ms, pwm_Hz);
    c.calibrate_ticks        = ticks16(1e-3 * calibrate_ms, pwm_Hz);
    c.background_ticks       = ticks16(1e-3 * background_ms, pwm_Hz);
    c.modbus_address         = 1U;
    c.modbus_gap_ticks       = static_cast<std::uint16_t>(std::ceil(1e-3 * gap_ms * pwm_Hz) + 1.0);
    c.modbus_timeout_ticks   = ticks16(1e-3 * timeout_ms, pwm_Hz);
    if (const auto [key, why] = board_refusal(d); !key.empty()) {
        throw InputError(d.name + ": " + key + " " + why); // one that was changed since
    }
    return out;
}

} // namespace sdre
