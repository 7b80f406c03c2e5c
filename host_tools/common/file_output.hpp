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
    /// What follows `text`, where that is too much to be kept: a piece at a call, an empty one is the end.
    std::function<std::string()> more = {};
};

/// Writes every file under a name of its own in the target's directory, then renames all of them; links are followed and a
/// file that was there keeps its mode. What is no regular file (a device, a pipe) is written to as it is, before
/// anything is renamed. InputError with the path as given when one cannot be written; no regular file has changed then.
void write_files(const std::vector<OutputFile> &files);

/// The whole file. InputError when it cannot be read.
std::string read_text_file(const std::filesystem::path &file);

} // namespace sdre
