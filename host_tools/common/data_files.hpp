// SPDX-License-Identifier: MIT
/// Files that a tool reads besides those on its command line: scenarios, drives, the scripts that draw.
#pragma once

#include <filesystem>
#include <string>

namespace sdre {

/// A file of the project by its path in the source tree, for example "host_tools/sil/scenarios/fig5_load_step.toml".
/// An installed tool finds it in share/sdre-drive beside its bin/, a built one in the sources that it was built of.
std::filesystem::path data_file(const std::string &path);

/// Where the running program is.
std::filesystem::path program_directory();

} // namespace sdre
