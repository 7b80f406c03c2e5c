// SPDX-License-Identifier: MIT
/// The board whose image runs on an instruction-set simulator. The program sdre-iss of the tests has the simulator, which
/// is under the GPL. sdre-sil starts it and links none of it.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "common/command_line.hpp"

namespace sdre {

constexpr const char *board_with_image = "stm32g431";

struct BoardOption {
    std::string name;
    std::string image; ///< empty: as sdre-iss finds it
    /// The other options, as they were given.
    std::function<std::vector<std::string>()> others;
};

/// --board and --image.
void declare_board(OptionList &list, BoardOption &board, const std::set<std::string> &names,
                   const std::string &help);

/// InputError: --image is given, and the board has none.
void require_no_image(const BoardOption &board);

/// sdre-iss takes the place of this process, with its exit code. InputError: there is none, or it does not start.
[[noreturn]] void run_image_program(const std::string              &command,
                                    const std::vector<std::string> &arguments);

} // namespace sdre
