// SPDX-License-Identifier: MIT
/// Weights into the text of a drive file, the rest of it byte for byte.
#pragma once

#include <filesystem>
#include <string>

#include "tune/tune.hpp"

namespace sdre {

/// The [nosc] and [nodo] sections, and [shaft] of noc_shaft, with every choice explained, ready for a drive file.
std::string tuned_sections(const TuneResult &result, const TuneSpec &spec);

/// InputError unless these sections begin with their header at the start of a line; call before the search.
void require_rewritable(const std::filesystem::path &file, const std::string &drive_text,
                        const Drive &drive);

/// A drive file's text with those sections in place of its own, the rest byte for byte.
std::string with_sections(const std::string &drive_text, const std::string &sections);

} // namespace sdre
