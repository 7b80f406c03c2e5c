// SPDX-License-Identifier: MIT
/// Board file: a board's processor, and the facts of what is around it (firmware/config/boards).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "common/toml_reader.hpp"
#include "drive/processor.hpp"

extern "C" {
#include "board_identity.h"
}

namespace sdre {

/// Without the key: converter 15 codes, half of the supply with 1 % resistors 20 codes, sensor 1 % of its range 41 codes: 76, and room.
constexpr double default_offset_max_cnt = 100.0;

struct BoardFile {
    std::string      name;
    std::string      file; ///< that it was read from
    const Processor *processor = &default_processor();
    double offset_max_cnt      = default_offset_max_cnt; ///< of a current sensor at zero current
    double current_settle_s =
        0.0; ///< of a shunt's amplifier after the lower switch is on; 0: sensors in the phases
    std::array<double, BOARD_FACT_COUNT> facts{};

    double operator[](board_fact_t fact) const
    {
        return facts.at(fact);
    }
};

constexpr int board_schema = 1;

/// InputError in one line on anything missing, unknown or out of range.
BoardFile read_board_file(const std::filesystem::path &file);

/// The board of this name: NAME.toml beside the drive file, in ../boards from there, or shipped; nothing: nowhere.
std::optional<BoardFile> named_board(const std::string &name, const std::string &drive_file);

/// The board that key `name` of [board] names.
BoardFile find_board(TomlReader &section, const std::string &drive_file);

/// "= "NAME" is not allowed: .." with the shipped boards.
std::string no_such_board(const std::string &name);

/// Names of the shipped boards, "a, b".
std::string shipped_boards();

} // namespace sdre
