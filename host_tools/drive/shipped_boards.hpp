// SPDX-License-Identifier: MIT
/// The shipped board files, compiled in: an installed tool, a wheel and a page in a browser have no source tree.
#pragma once

#include <map>
#include <string>

namespace sdre {

/// Text of firmware/config/boards/NAME.toml for each NAME.
const std::map<std::string, std::string> &shipped_board_texts();

} // namespace sdre
