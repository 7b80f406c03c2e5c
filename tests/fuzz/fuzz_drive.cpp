// SPDX-License-Identifier: MIT
/// Drive files.
#include "drive/drive_file.hpp"
#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    return fuzz::read(data, size, [](const auto &file) {
        static_cast<void>(sdre::drive_digest(sdre::read_drive_file(file)));
    });
}
