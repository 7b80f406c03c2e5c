// SPDX-License-Identifier: MIT
/// The table [saturation] of a drive file.
#pragma once

#include <memory>
#include <optional>

#include "common/toml_reader.hpp"
#include "drive/flux_map.hpp"

namespace sdre {

struct Motor;

/// InputError in one line on anything missing, unknown, out of range, or that no iron can be. `motor` has the current limit, and the
/// magnet's flux where the table has inductances.
std::shared_ptr<const FluxMap> read_saturation(std::optional<TomlReader> t, const Motor &motor);

} // namespace sdre
