// SPDX-License-Identifier: MIT
#include "design/board/identity.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/board/board_constants.hpp"
#include "drive/core_types.hpp"

namespace sdre {
namespace {

BoardFile simulated(const Drive &d)
{
    const BoardDescription &b = d.board;
    BoardFile               s;
    s.name                                       = "simulated";
    s.facts[BOARD_FACT_PWM_CLOCK_Hz]             = default_processor().counter_Hz;
    s.facts[BOARD_FACT_GATE_ON_LEVEL]            = 1.0;
    s.facts[BOARD_FACT_DEAD_TIME_MIN_s]          = d.inverter.dead_time_s;
    s.facts[BOARD_FACT_PRECHARGE_s]              = b.precharge_s;
    s.facts[BOARD_FACT_DUTY_MAX]                 = b.duty_max;
    s.facts[BOARD_FACT_PULSE_MIN_s]              = b.pulse_min_s;
    s.facts[BOARD_FACT_CURRENT_RANGE_A]          = d.current_sensors.range_A;
    s.facts[BOARD_FACT_CURRENT_SENSORS]          = d.current_sensors.count;
    s.facts[BOARD_FACT_RATED_CURRENT_A]          = d.motor.max_current_A;
    s.facts[BOARD_FACT_TRIP_CURRENT_A]           = d.current_sensors.range_A;
    s.facts[BOARD_FACT_DC_LINK_RANGE_V]          = b.dc_link_range_V;
    s.facts[BOARD_FACT_RATED_DC_LINK_V]          = b.dc_link_range_V;
    s.facts[BOARD_FACT_NTC_RESISTANCE_Ohm]       = b.ntc_resistance_Ohm;
    s.facts[BOARD_FACT_NTC_BETA_K]               = b.ntc_beta_K;
    s.facts[BOARD_FACT_NTC_DIVIDER_Ohm]          = b.ntc_divider_Ohm;
    s.facts[BOARD_FACT_TEMPERATURE_LIMIT_degC]   = b.temperature_limit_degC;
    s.facts[BOARD_FACT_TEMPERATURE_TRIP_degC]    = b.temperature_trip_degC;
    s.facts[BOARD_FACT_INVERTER_CURRENT_A]       = b.inverter_current_A;
    s.facts[BOARD_FACT_INVERTER_TIME_CONSTANT_s] = b.inverter_time_constant_s;
    s.facts[BOARD_FACT_ENCODER_EDGES_Hz]         = encoder_edges_Hz(d);
    return s;
}

} // namespace

board_identity_t board_identity_of(const Drive &drive)
{
    const BoardFile  board = drive.board.file ? *drive.board.file : simulated(drive);
    board_identity_t b{};
    board.name.copy(b.name, 2U * BOARD_NAME_WORDS);
    for (std::size_t fact = 0; fact < board.facts.size(); fact++) {
        b.fact[fact] = single(board.facts[fact]);
    }
    b.sum = board_identity_sum(&b);
    return b;
}

void require_board(const Drive &drive, const std::string &source)
{
    if (!drive.board.file) {
        throw InputError(fmt::format("{}: [board] name is missing: tables and images are made for "
                                     "one board; shipped boards: {} (docs/files.md)",
                                     source, shipped_boards()));
    }
}

} // namespace sdre
