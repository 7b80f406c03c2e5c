// SPDX-License-Identifier: MIT
#include "emit/emit_board.hpp"

#include <fmt/format.h>

#include "common/c_text.hpp"
#include "common/version.hpp"
#include "design/board/board_constants.hpp"

namespace sdre {
namespace {

std::string c_count(const std::string &name, std::uint32_t value)
{
    return c_field(name, fmt::format("{}U{}", value, value > 65535U ? "L" : ""));
}

std::string setup_block(const board_setup_t &s)
{
    return c_block("board", c_field("pwm_cycles", fmt::format("{}UL", s.pwm_cycles)) +
                                c_count("duty_full_cnt", s.duty_full_cnt) +
                                c_count("dead_time_cnt", s.dead_time_cnt) +
                                c_count("positions", s.positions));
}

std::string scale_block(const app_scale_config_t &s)
{
    return c_block("scale", c_field("current_A_per_cnt", s.current_A_per_cnt) +
                                c_field("current_zero_cnt", s.current_zero_cnt) +
                                c_field("offset_max_cnt", s.offset_max_cnt) +
                                c_field("dc_link_V_per_cnt", s.dc_link_V_per_cnt) +
                                c_count("ntc_first_cnt", s.ntc_first_cnt) +
                                c_count("ntc_step_cnt", s.ntc_step_cnt) +
                                c_count("ntc_points", s.ntc_points) +
                                c_field("ntc_degC", std::string("ntc_degC")));
}

std::string angle_block(const app_angle_config_t &a)
{
    return c_block("angle", c_field("index_theta_e_rad", a.index_theta_e_rad) +
                                c_count("index_tolerance_cnt", a.index_tolerance_cnt) +
                                c_count("index_correct_max_cnt", a.index_correct_max_cnt) +
                                c_count("jump_cnt", a.jump_cnt));
}

std::string align_block(const app_align_config_t &a)
{
    std::string s = c_field("current_A", a.current_A) +
                    c_field("bandwidth_radps", a.bandwidth_radps) +
                    c_field("theta_e_rad", a.theta_e_rad);
    s += c_count("watch_ticks", a.watch_ticks) + c_count("ramp_ticks", a.ramp_ticks) +
         c_count("sweep_ticks", a.sweep_ticks) + c_count("settle_ticks", a.settle_ticks);
    s += c_count("still_ticks", a.still_ticks) + c_count("still_cnt", a.still_cnt) +
         c_count("quarter_error_cnt", a.quarter_error_cnt);
    return c_block("align", s);
}

std::string gate_block(const app_gate_config_t &g)
{
    return c_block("gate", c_count("precharge_ticks", g.precharge_ticks) +
                               c_field("precharge_speed_e_radps", g.precharge_speed_e_radps) +
                               c_count("duty_max_cnt", g.duty_max_cnt) +
                               c_count("pulse_min_cnt", g.pulse_min_cnt));
}

std::string stop_block(const app_stop_config_t &s)
{
    return c_block(
        "stop", c_field("reaction", std::string(s.reaction == APP_STOP_RAMP ? "APP_STOP_RAMP"
                                                                            : "APP_STOP_COAST")) +
                    c_field("still_e_radps", s.still_e_radps) +
                    c_field("short_circuit", std::string(s.short_circuit ? "true" : "false")));
}

std::string heat_block(const app_watch_heat_config_t &h)
{
    return c_block("heat", c_field("motor_A", h.motor_A) + c_field("motor_s", h.motor_s) +
                               c_field("inverter_A", h.inverter_A) +
                               c_field("inverter_s", h.inverter_s));
}

std::string fields(const app_config_t &c)
{
    std::string s = setup_block(c.board) + c_field("pwm_period_s", c.pwm_period_s) +
                    c_field("dead_time_s", c.dead_time_s) + scale_block(c.scale) +
                    angle_block(c.angle) + align_block(c.align) + gate_block(c.gate) +
                    stop_block(c.stop) + heat_block(c.heat);
    s += c_field("zero_drift_A", c.zero_drift_A) +
         c_field("temperature_limit_degC", c.temperature_limit_degC) +
         c_field("temperature_trip_degC", c.temperature_trip_degC);
    s += c_count("boot_ticks", c.boot_ticks) + c_count("calibrate_ticks", c.calibrate_ticks) +
         c_count("background_ticks", c.background_ticks);
    return s + c_count("modbus_address", c.modbus_address) +
           c_count("modbus_gap_ticks", c.modbus_gap_ticks) +
           c_count("modbus_timeout_ticks", c.modbus_timeout_ticks) +
           c_field("drive_name", fmt::format("\"{}\"", c.drive_name)) +
           c_field("digest", fmt::format("\"{}\"", c.digest));
}

std::string temperatures(const BoardConstants &b)
{
    std::string s = fmt::format("static const float ntc_degC[{}] = {{\n", ntc_points);
    for (std::size_t n = 0; n < ntc_points; n += 4) {
        s += "    ";
        for (std::size_t k = n; k < n + 4 && k < ntc_points; k++) {
            s += c_number(b.ntc_degC.at(k)) + (k == n + 3 ? ",\n" : ", ");
        }
    }
    return s + "};\n\n";
}

} // namespace

std::string board_config_text(const Drive &drive)
{
    BoardConstants b = board_constants(drive);
    b.bind();
    std::string s = "/* SPDX-License-Identifier: MIT */\n";
    s += fmt::format(
        "/* Generated by sdre-gains {}, {}. Do not edit. Derivations: docs/equations.md, "
        "EQ-BOARD. */\n",
        tool_version, drive_digest(drive));
    s += "/* clang-format off */\n#include \"board_config.h\"\n\n" + temperatures(b);
    return s + "const app_config_t board_config = {\n" + c_indented(fields(b.config)) + "};\n";
}

} // namespace sdre
