// SPDX-License-Identifier: MIT
/// The constants of a drive by name, in the order of the walks in firmware/control/fields.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drive/core_types.hpp"

namespace sdre {

/// A number, or a structure or array with its parts.
struct NamedConstant {
    enum class Kind { parts, u16, i16, u32, flag, number };

    std::string                name; ///< of the member; empty in an array
    Kind                       kind  = Kind::parts;
    double                     value = 0.0;
    std::vector<NamedConstant> parts;

    bool is_array() const;
};

/// The constants that a walk visits, which counts words.
std::vector<NamedConstant> named_constants(const std::function<void(fields_t &)> &walk);

/// Those of the configuration's law.
std::vector<NamedConstant> law_constants(const drive_config_t &config);
/// Those that all laws share.
std::vector<NamedConstant> drive_constants(const drive_config_t &config);

/// One line for each number: its first word in an image, its full name, its value. `word` is that of the first.
std::string constants_list(const std::vector<NamedConstant> &constants, int word);

} // namespace sdre
