// SPDX-License-Identifier: MIT
#include "emit/describe.hpp"

#include <cmath>

#include <fmt/format.h>

#include "design/board/board_constants.hpp"
#include "design/certificate.hpp"
#include "design/law_design.hpp"
#include "drive/pwm_frequency.hpp"
#include "emit/report_machine.hpp"

namespace sdre {
namespace {

std::string row(const std::string &what, const std::string &value)
{
    return fmt::format("| {} | {} |\n", what, value);
}

std::string heading(const char *title)
{
    return fmt::format("\n## {}\n\n| | |\n|---|---|\n", title);
}

std::string with_unit(double value, const char *unit)
{
    return fmt::format("{:.4g} {}", value, unit);
}

double rpm(const Drive &d, double omega_e_radps)
{
    return omega_e_radps / d.motor.pole_pairs * 30.0 / std::acos(-1.0);
}

std::string motor(const Drive &d)
{
    const Motor &m = d.motor;
    std::string  s = heading("Motor");
    s += row("pole pairs", fmt::format("{}", m.pole_pairs));
    s += row("resistance of a phase", with_unit(m.stator_resistance_Ohm, "Ohm"));
    s += row("inductance along d, q", fmt::format("{:.4g}, {:.4g} mH", 1e3 * m.d_axis_inductance_H,
                                                  1e3 * m.q_axis_inductance_H));
    s += row("flux of the magnet, peak", with_unit(m.pm_flux_Wb, "Wb"));
    s += row("inertia of motor and load", with_unit(m.inertia_kgm2, "kg m2"));
    s += row("viscous friction", with_unit(m.viscous_friction_Nms, "N m s"));
    s += row("rated", fmt::format("{:.4g} N m at {:.0f} r/min", m.rated_torque_Nm,
                                  rpm(d, m.rated_speed_e_radps)));
    return s + row("current limit, peak", with_unit(m.max_current_A, "A"));
}

std::string inverter(const Drive &d)
{
    const Inverter &i = d.inverter;
    std::string     s = heading("Inverter and sensors");
    s += row("board", d.board.file ? d.board.file->name : "none: for simulations only");
    s += row("dc link", with_unit(i.dc_link_V, "V"));
    s += row("PWM", pwm_words(i));
    s += row("control period", fmt::format("{:g} us", 1e6 * control_period_s(d)));
    s += row("dead time", with_unit(1e6 * i.dead_time_s, "us"));
    s += row("what takes energy that comes back", dc_link_sink_name(i.regeneration));
    s += row("current converter",
             fmt::format("+-{:g} A, {} bits, noise {:.3g} A rms", d.current_sensors.range_A,
                         d.current_sensors.adc_bits, d.current_sensors.noise_rms_A));
    s += row("dc-link converter", with_unit(d.board.dc_link_range_V, "V full scale"));
    return s + row("encoder", fmt::format("{} lines, {}", d.encoder.lines,
                                          d.encoder.edge_times ? "times of its edges" : "counts"));
}

std::string board(const Drive &d)
{
    const app_config_t c  = board_constants(d).config;
    const double       ts = static_cast<double>(c.pwm_period_s);
    std::string        s  = heading("What the board is set to");
    s += row("a current's code",
             with_unit(1e3 * static_cast<double>(c.scale.current_A_per_cnt), "mA"));
    s += row("a dc-link code",
             with_unit(1e3 * static_cast<double>(c.scale.dc_link_V_per_cnt), "mV"));
    s += row("compare counts of a duty of one, of the dead time",
             fmt::format("{}, {}", c.board.duty_full_cnt, c.board.dead_time_cnt));
    s += row("alignment without an index",
             fmt::format("{:.3g} A; {:.2f} s ramp, {:.2f} s sweep, {:.2f} s to rest",
                         static_cast<double>(c.align.current_A), ts * c.align.ramp_ticks,
                         ts * c.align.sweep_ticks, ts * c.align.settle_ticks));
    s += row(
        "index: mark, largest correction",
        fmt::format("{}, {} counts", c.angle.index_tolerance_cnt, c.angle.index_correct_max_cnt));
    s += row("a shaft's largest way in a PWM period", fmt::format("{} counts", c.angle.jump_cnt));
    s += row("current for ever: motor, inverter",
             fmt::format("{:.3g} A (time constant {:g} s), {:.3g} A ({:g} s)",
                         static_cast<double>(c.heat.motor_A), static_cast<double>(c.heat.motor_s),
                         static_cast<double>(c.heat.inverter_A),
                         static_cast<double>(c.heat.inverter_s)));
    s +=
        row("stop", c.stop.reaction == APP_STOP_RAMP ? "brakes to standstill" : "opens the bridge");
    return s + row("heat sink: no start above, trip",
                   fmt::format("{:g}, {:g} degC", static_cast<double>(c.temperature_limit_degC),
                               static_cast<double>(c.temperature_trip_degC)));
}

std::string fenced(const std::string &text)
{
    return "\n```\n" + text + "```\n";
}

} // namespace

std::string description(const Design &design, const std::optional<Prediction> &prediction)
{
    const Drive &d = design.drive;
    std::string  s = fmt::format(
         "# {}\n\nLaw `{}`, {}. Digest of the drive file: `{}`.\n", d.name, law_name(d.law),
        design.certificate.passed() ? "certified" : fmt::format("**{}**", verdict_words(design)),
         drive_digest(d));
    s += motor(d) + inverter(d) + "\n## What it can do\n";
    s += fenced(machine_text(design, prediction).substr(1));
    s += board(d) + "\n## Gains and certificate\n";
    return s + fenced(report_text(design));
}

} // namespace sdre
