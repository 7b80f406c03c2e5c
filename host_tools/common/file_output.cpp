// SPDX-License-Identifier: MIT
#include "common/file_output.hpp"

#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

std::filesystem::path temporary_name(const std::filesystem::path &path)
{
    return path.parent_path() / fmt::format(".{}.tmp", path.filename().string());
}

void remove_temporaries(const std::vector<OutputFile> &files)
{
    std::error_code ignored;
    for (const OutputFile &file : files) {
        std::filesystem::remove(temporary_name(file.path), ignored);
    }
}

} // namespace

void write_files(const std::vector<OutputFile> &files)
{
    for (const OutputFile &file : files) {
        std::error_code error;
        if (std::filesystem::is_directory(file.path,
                                          error)) { // rename would fail after earlier ones worked
            throw InputError(fmt::format("{}: cannot write: is a directory", file.path.string()));
        }
    }
    for (const OutputFile &file : files) {
        std::ofstream stream(temporary_name(file.path), std::ios::binary | std::ios::trunc);
        stream << file.text;
        stream.close();
        if (!stream) {
            remove_temporaries(files);
            throw InputError(fmt::format("{}: cannot write", file.path.string()));
        }
    }
    for (const OutputFile &file : files) {
        std::error_code error;
        std::filesystem::rename(temporary_name(file.path), file.path, error);
        if (error) {
            remove_temporaries(files);
            throw InputError(
                fmt::format("{}: cannot write: {}", file.path.string(), error.message()));
        }
    }
}

std::string read_text_file(const std::filesystem::path &file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) { // a directory opens, and reads as empty
        throw InputError(fmt::format("{}: cannot read", file.string()));
    }
    std::ifstream      stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) {
        throw InputError(fmt::format("{}: cannot read", file.string()));
    }
    return text.str();
}

} // namespace sdre
