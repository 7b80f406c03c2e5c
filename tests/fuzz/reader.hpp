// SPDX-License-Identifier: MIT
/// Common part of the fuzzed readers: the input as a file, and the allowed answers of a reader.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "common/errors.hpp"
#include "temp_dir.hpp"

namespace fuzz {

/// Gives the input to a reader of files. It may accept it or refuse it in one line; anything else ends the program.
template <typename Reader>
int read(const std::uint8_t *data, std::size_t size, const Reader &reader)
{
    static const support::TempDir dir;
    static const auto             file = dir / "input";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
    try {
        reader(file);
    } catch (const sdre::InputError &e) {
        if (std::string(e.what()).find('\n') != std::string::npos) {
            std::abort(); // more than one line
        }
    } catch (const sdre::DesignError &) {
    }
    return 0;
}

} // namespace fuzz
