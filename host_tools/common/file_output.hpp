// SPDX-License-Identifier: MIT
/// Output files that are either complete or not there: written beside their place, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sdre {

struct OutputFile {
    std::filesystem::path path;
    std::string           text;
    /// Further pieces after `text`, for output that is too large for memory: one piece per call; an
    /// empty piece is the end.
    std::function<std::string()> more = {};
};

/// Writes every file to a temporary name in the target's directory, then renames all of them. Links
/// are followed, and an existing file keeps its mode. A device or a pipe is written directly,
/// before any rename. Throws InputError with the path as given when one cannot be written; then no
/// regular file has changed.
void write_files(const std::vector<OutputFile> &files);

/// The whole file. InputError when it cannot be read.
std::string read_text_file(const std::filesystem::path &file);

} // namespace sdre
