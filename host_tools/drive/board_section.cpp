// SPDX-License-Identifier: MIT
#include "drive/board_section.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "drive/dc_link_levels.hpp"
#include "drive/drive_file.hpp"

namespace sdre {
namespace {

// Allowed values: wide enough for any drive, narrow enough that a slipped unit is caught.
constexpr Range range_V{1.0, 2e4};
constexpr Range resistance_Ohm{10.0, 1e7};
constexpr Range beta_K{1e3, 1e4};
constexpr Range temperature_degC{-40.0, 200.0};
constexpr Range current_A{1e-3, 1e4};
constexpr Range time_s{1e-2, 1e5};
constexpr Range precharge_s{0.0, 0.5};
constexpr Range duty{0.5, 1.0};
constexpr Range pulse_s{0.0, 2e-5};

// Chosen: an eighth above the largest dc link that the drive accepts, 1.35 times the nominal.
constexpr double range_per_dc_link = 1.525;
// Chosen: modules for a quarter more than the limit.
constexpr double inverter_per_limit = 1.25;

StopReaction read_stop(TomlReader &t)
{
    const std::string name = t.text_or("stop", stop_reaction_name(StopReaction::coast));
    if (name != "coast" && name != "brake") {
        t.fail("stop",
               fmt::format("= \"{}\" is not allowed: must be \"coast\" or \"brake\"", name));
    }
    return name == "brake" ? StopReaction::brake : StopReaction::coast;
}

void read_supply(TomlReader &t, BoardDescription &b)
{
    b.precharge_s =
        board_number(t, "precharge_s", precharge_s, b.file, BOARD_FACT_PRECHARGE_s, b.precharge_s);
    b.duty_max = board_number(t, "duty_max", duty, b.file, BOARD_FACT_DUTY_MAX, b.duty_max);
    b.pulse_min_s =
        board_number(t, "pulse_min_s", pulse_s, b.file, BOARD_FACT_PULSE_MIN_s, b.pulse_min_s);
}

void read_heat(TomlReader &t, BoardDescription &b)
{
    if (t.has("motor_current_A")) {
        b.motor_current_A = t.number("motor_current_A", current_A);
    }
    b.motor_time_constant_s = t.number_or("motor_time_constant_s", time_s, b.motor_time_constant_s);
    b.inverter_current_A    = board_number(t, "inverter_current_A", current_A, b.file,
                                           BOARD_FACT_INVERTER_CURRENT_A, b.inverter_current_A);
    b.inverter_time_constant_s =
        board_number(t, "inverter_time_constant_s", time_s, b.file,
                     BOARD_FACT_INVERTER_TIME_CONSTANT_s, b.inverter_time_constant_s);
}

void read_temperature(TomlReader &t, BoardDescription &b)
{
    b.ntc_resistance_Ohm = board_number(t, "ntc_resistance_Ohm", resistance_Ohm, b.file,
                                        BOARD_FACT_NTC_RESISTANCE_Ohm, b.ntc_resistance_Ohm);
    b.ntc_beta_K =
        board_number(t, "ntc_beta_K", beta_K, b.file, BOARD_FACT_NTC_BETA_K, b.ntc_beta_K);
    b.ntc_divider_Ohm = board_number(t, "ntc_divider_Ohm", resistance_Ohm, b.file,
                                     BOARD_FACT_NTC_DIVIDER_Ohm, b.ntc_divider_Ohm);
    b.temperature_limit_degC =
        board_number(t, "temperature_limit_degC", temperature_degC, b.file,
                     BOARD_FACT_TEMPERATURE_LIMIT_degC, b.temperature_limit_degC);
    b.temperature_trip_degC =
        board_number(t, "temperature_trip_degC", temperature_degC, b.file,
                     BOARD_FACT_TEMPERATURE_TRIP_degC, b.temperature_trip_degC);
    if (b.temperature_limit_degC >= b.temperature_trip_degC) {
        t.fail("temperature_limit_degC",
               fmt::format("= {:g} is not allowed: must be below temperature_trip_degC = {:g}",
                           b.temperature_limit_degC, b.temperature_trip_degC));
    }
}

BoardDescription default_board(const Motor &motor, const Inverter &inverter)
{
    BoardDescription b;
    b.dc_link_range_V    = range_per_dc_link * inverter.dc_link_V;
    b.inverter_current_A = inverter_per_limit * motor.max_current_A;
    return b;
}

std::string beyond(double value, const BoardFile &board, const char *bound, board_fact_t fact)
{
    return fmt::format("= {:g} is not allowed: must be {} {} = {:g} of board \"{}\"", value, bound,
                       board_field_name(static_cast<std::uint16_t>(fact + 1)), board[fact],
                       board.name);
}

/// The chopper's levels have to suit the dc link of the drive. The line names the board file's key.
std::pair<std::string, std::string> chopper_refusal(const Drive &d)
{
    const BoardFile &b       = *d.board.file;
    const double     on_V    = b[BOARD_FACT_CHOPPER_ON_V];
    const double     off_V   = b[BOARD_FACT_CHOPPER_OFF_V];
    const double     v_dc    = d.inverter.dc_link_V;
    const double     trip_V  = std::min(dc_link_max_ratio * v_dc, b[BOARD_FACT_RATED_DC_LINK_V]);
    const auto       refused = [&](double value, double above_V, const char *why, double below_V,
                             const char *bound) {
        return fmt::format("= {:g} of {} is not allowed with a dc link of {:g} V: must be above "
                                       "{:g}, {}, and below {:g}, {}",
                                 value, b.file, v_dc, above_V, why, below_V, bound);
    };
    if (on_V <= regen_end_ratio * v_dc || on_V >= trip_V) {
        return {"chopper_on_V", refused(on_V, regen_end_ratio * v_dc,
                                        "the end of the regeneration limit", trip_V, "the trip")};
    }
    if (off_V <= regen_start_ratio * v_dc) {
        return {"chopper_off_V", refused(off_V, regen_start_ratio * v_dc, "what a supply may reach",
                                         on_V, "chopper_on_V")};
    }
    return {};
}

} // namespace

double board_number(TomlReader &t, const std::string &key, Range allowed,
                    const std::optional<BoardFile> &board, board_fact_t fact, double fallback)
{
    const double of_board = board ? (*board)[fact] : fallback;
    const double value    = t.number_or(key, allowed, of_board);
    if (board && value != of_board) {
        t.fail(key,
               fmt::format("= {:g} is not allowed: board \"{}\" has {:g}; leave the key out, or "
                           "change {}",
                           value, board->name, of_board, board->file));
    }
    return value;
}

BoardDescription read_board(std::optional<TomlReader> t, const Motor &motor,
                            const Inverter &inverter, const std::string &file)
{
    BoardDescription b = default_board(motor, inverter);
    if (!t) {
        return b;
    }
    if (t->has("name")) {
        b.file = find_board(*t, file);
    }
    b.dc_link_range_V = board_number(*t, "dc_link_range_V", range_V, b.file,
                                     BOARD_FACT_DC_LINK_RANGE_V, b.dc_link_range_V);
    if (t->has("align_current_A")) {
        b.align_current_A = t->number("align_current_A", {1e-3, 0.5 * motor.max_current_A});
    }
    read_temperature(*t, b);
    read_heat(*t, b);
    b.stop = read_stop(*t);
    read_supply(*t, b);
    t->reject_unknown_keys();
    return b;
}

std::pair<std::string, std::string> board_refusal(const Drive &d)
{
    if (!d.board.file) {
        return {};
    }
    const BoardFile &b = *d.board.file;
    if (d.inverter.updates_per_period > b.processor->most_updates) {
        return {"[inverter] updates_per_period",
                fmt::format("= {} is not allowed: must be {} on the processor {} of board \"{}\"",
                            d.inverter.updates_per_period, b.processor->most_updates,
                            b.processor->name, b.name)};
    }
    if (d.inverter.dead_time_s < b[BOARD_FACT_DEAD_TIME_MIN_s]) {
        return {"[inverter] dead_time_s",
                beyond(d.inverter.dead_time_s, b, "at least", BOARD_FACT_DEAD_TIME_MIN_s)};
    }
    if (d.motor.max_current_A > b[BOARD_FACT_RATED_CURRENT_A]) {
        return {"[motor] max_current_A",
                beyond(d.motor.max_current_A, b, "at most", BOARD_FACT_RATED_CURRENT_A)};
    }
    if (d.inverter.dc_link_V > b[BOARD_FACT_RATED_DC_LINK_V]) {
        return {"[inverter] dc_link_V",
                beyond(d.inverter.dc_link_V, b, "at most", BOARD_FACT_RATED_DC_LINK_V)};
    }
    if (encoder_edges_Hz(d) > b[BOARD_FACT_ENCODER_EDGES_Hz]) {
        return {"[encoder] lines",
                fmt::format("= {} is not allowed: {:.3g} edges a second at the trip speed of "
                            "{:g} rad/s, at most encoder_edges_Hz = {:g} of board \"{}\"",
                            d.encoder.lines, encoder_edges_Hz(d), trip_speed_e_radps(d),
                            b[BOARD_FACT_ENCODER_EDGES_Hz], b.name)};
    }
    return has_chopper(d) ? chopper_refusal(d) : std::pair<std::string, std::string>{};
}

bool has_chopper(const Drive &d)
{
    return d.board.file && (*d.board.file)[BOARD_FACT_CHOPPER_ON_V] > 0.0;
}

const char *stop_reaction_name(StopReaction reaction)
{
    return reaction == StopReaction::brake ? "brake" : "coast";
}

} // namespace sdre
