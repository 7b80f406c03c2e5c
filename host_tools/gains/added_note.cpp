// SPDX-License-Identifier: MIT
#include "gains/added_note.hpp"

#include <fmt/format.h>

namespace sdre {

std::string text_or_note(const std::string &section, const std::string &what,
                         const AddedSection &found, const std::string &begin)
{
    if (!found.why_not.empty()) {
        fmt::print(stderr, "note: {} [{}], so the drive takes no {}: {}\n", begin, section, what,
                   found.why_not);
    }
    return found.text;
}

} // namespace sdre
