// SPDX-License-Identifier: MIT
#pragma once

namespace sdre {

/// Version of the host tools; part of every generated file.
constexpr const char *tool_version = "1.0.0";

} // namespace sdre
