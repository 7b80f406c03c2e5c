// SPDX-License-Identifier: MIT
/// What is said of a section that a drive file gets, or does not get.
#pragma once

#include <string>

#include "tune/added_section.hpp"

namespace sdre {

/// The section's text; without one a note on stderr, which begins "no" or "still no", and no text.
std::string text_or_note(const std::string &section, const std::string &what,
                         const AddedSection &found, const std::string &begin);

} // namespace sdre
