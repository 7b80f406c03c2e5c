// SPDX-License-Identifier: MIT
/// [board] of the drive file: the board's name, and what a drive asks of its board. Without a name every key has a
/// default from physics, for simulations.
#pragma once

#include <optional>
#include <string>

#include "common/toml_reader.hpp"
#include "drive/board_file.hpp"

namespace sdre {

struct Drive;
struct Motor;
struct Inverter;

/// Reaction when a run ends (firmware/app/operate/app_stop.h).
enum class StopReaction { coast, brake };

struct BoardDescription {
    std::optional<BoardFile> file; ///< without it no image can be made

    double dc_link_range_V        = 0.0;    ///< gives the converter's full scale
    double ntc_resistance_Ohm     = 10e3;   ///< of the heat sink's sensor at 25 degC
    double ntc_beta_K             = 3435.0; ///< its B value
    double ntc_divider_Ohm        = 2.2e3;  ///< from the converter's full scale to the sensor
    double temperature_limit_degC = 80.0;   ///< no start above; chosen: modules for 125 degC
    double temperature_trip_degC  = 90.0;
    std::optional<double> align_current_A; ///< of the vector that finds the angle without an index
    std::optional<double> motor_current_A; ///< continuous current of the winding, peak of a phase
    double                motor_time_constant_s = 30.0; ///< of the winding; chosen: a small frame's
    double                inverter_current_A    = 0.0;
    double                inverter_time_constant_s = 2.0; ///< of the modules' bases; chosen
    StopReaction          stop                     = StopReaction::coast;
    double                precharge_s =
        0.0; ///< bootstrap supplies: all lower switches on before a run; 0: isolated
    double duty_max    = 1.0; ///< largest duty below full that the drivers' supplies bear
    double pulse_min_s = 0.0; ///< shortest pulse that the drivers pass
};

/// The table, or the defaults without one. Keys of the board that the table repeats must agree with the board file.
/// @param file The drive file; board files are looked for beside it.
BoardDescription read_board(std::optional<TomlReader> t, const Motor &motor,
                            const Inverter &inverter, const std::string &file);

/// The board's fact, else `fallback`; a key that repeats the fact must agree with it.
double board_number(TomlReader &t, const std::string &key, Range allowed,
                    const std::optional<BoardFile> &board, board_fact_t fact, double fallback);

/// A limit of the drive that the board does not allow: "[motor] max_current_A", "= 7 is not allowed: ..". Empty: none.
std::pair<std::string, std::string> board_refusal(const Drive &drive);

/// The board has a brake chopper.
bool has_chopper(const Drive &drive);

/// "coast", "brake".
const char *stop_reaction_name(StopReaction reaction);

} // namespace sdre
