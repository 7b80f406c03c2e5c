// SPDX-License-Identifier: MIT
/// Output files that are either complete or not there: written beside their place, then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sdre {

struct OutputFile {
    std::filesystem::path path;
    std::string           text;
};

/// Writes every file under a temporary name in its own directory, then renames all of them. InputError when
/// one cannot be written; no target has changed then.
void write_files(const std::vector<OutputFile> &files);

/// The whole file. InputError when it cannot be read.
std::string read_text_file(const std::filesystem::path &file);

} // namespace sdre
