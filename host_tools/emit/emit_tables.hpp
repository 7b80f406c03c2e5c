// SPDX-License-Identifier: MIT
/// gain_tables.h, gain_tables.c and board_config.c: data for the firmware, deterministic, written all or nothing.
#pragma once

#include <filesystem>
#include <string>

#include "design/design.hpp"

namespace sdre {

struct TableText {
    std::string header;
    std::string source;
    std::string board;
};

/// The files as text. Same design, same bytes. InputError when the board cannot have the drive.
TableText table_text(const Design &design);

/// Writes them into an existing or new directory; InputError when that fails, with earlier files untouched.
void write_tables(const TableText &text, const std::filesystem::path &directory);

/// Compares the files in a directory with freshly solved text: numbers to 1e-6 relative, all else exactly.
/// Returns "" when equal, otherwise one line that names the file and the first difference.
std::string compare_tables(const TableText &text, const std::filesystem::path &directory);

} // namespace sdre
