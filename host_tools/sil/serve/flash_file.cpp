// SPDX-License-Identifier: MIT
#include "sil/serve/flash_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

constexpr std::size_t octets = 2 * f28335::flash_word_count;

[[noreturn]] void fail(const std::string &path, const std::string &what)
{
    throw InputError(fmt::format("--flash {}: {}", path, what));
}

f28335::FlashWords read(const std::string &path)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        fail(path, std::strerror(errno));
    }
    const std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (content.size() != octets) {
        fail(path, fmt::format("has {} octets, and no flash: must be {}, or a new file",
                               content.size(), octets));
    }
    f28335::FlashWords words(f28335::flash_word_count);
    for (std::size_t n = 0; n < words.size(); n++) {
        const auto low  = static_cast<unsigned char>(content[2 * n]);
        const auto high = static_cast<unsigned char>(content[2 * n + 1]);
        words[n]        = static_cast<std::uint16_t>(high << 8U | low);
    }
    return words;
}

} // namespace

FlashFile::FlashFile(std::string path)
    : path_(std::move(path)), words_(f28335::flash_word_count, f28335::erased_word)
{
    if (path_.empty()) {
        return;
    }
    if (std::filesystem::exists(path_)) {
        words_ = read(path_);
    } else {
        write();
    }
    changes_ = f28335::flash_changes();
}

/// Beside it first: a run that is killed in between leaves a whole file.
void FlashFile::write() const
{
    std::string content(octets, '\0');
    for (std::size_t n = 0; n < words_.size(); n++) {
        content[2 * n]     = static_cast<char>(words_[n] & 0xFFU);
        content[2 * n + 1] = static_cast<char>(words_[n] >> 8U);
    }
    const std::string beside = path_ + ".new";
    std::ofstream     out(beside, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out || std::rename(beside.c_str(), path_.c_str()) != 0) {
        const std::string why = std::strerror(errno);
        std::remove(beside.c_str());
        fail(path_, why);
    }
}

void FlashFile::keep()
{
    if (path_.empty() || f28335::flash_changes() == changes_) {
        return;
    }
    changes_ = f28335::flash_changes();
    words_   = f28335::flash_words();
    write();
}

} // namespace sdre
