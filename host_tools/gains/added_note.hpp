// SPDX-License-Identifier: MIT
/// Says why a drive file does not get a section.
#pragma once

#include <string>

#include "tune/added_section.hpp"

namespace sdre {

/// The section's text; without one a note on stderr, which begins "no" or "still no", and no text.
std::string text_or_note(const std::string &section, const std::string &what,
                         const AddedSection &found, const std::string &begin);

} // namespace sdre
