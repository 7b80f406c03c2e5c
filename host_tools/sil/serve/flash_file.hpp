// SPDX-License-Identifier: MIT
/// A file that keeps the flash of a served drive: the words of its sectors, low octet first.
#pragma once

#include <string>

#include "sil/f28335/flash_unit.hpp"

namespace sdre {

class FlashFile {
public:
    /// Without a path nothing is kept. Reads the file, where there is one; InputError when it is none of these, or cannot be
    /// read or made.
    explicit FlashFile(std::string path);

    /// Contents at a drive's start: as from the factory without a file.
    const f28335::FlashWords &words() const
    {
        return words_;
    }
    /// Writes the file when the flash has changed. InputError when that fails; the file is then as it was.
    void keep();

private:
    void write() const;

    std::string        path_;
    f28335::FlashWords words_;
    long               changes_ = 0;
};

} // namespace sdre
