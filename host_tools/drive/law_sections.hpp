// SPDX-License-Identifier: MIT
/// The part of a drive file that depends on its law.
#pragma once

#include "common/toml_reader.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

/// Range of every electrical speed in a drive file: wide, but narrow enough to find a wrong unit.
constexpr Range allowed_speed_e_radps{1.0, 1e5};

/// The key `law`; paper A's when it is not there.
Law read_law(TomlReader &file);

/// The sections that belong to drive.law; the sections of the others are unknown keys. The motor is read already.
void read_law_sections(TomlReader &file, Drive &drive);

} // namespace sdre
