// SPDX-License-Identifier: MIT
/// The encoder of a data sheet.
#pragma once

#include <string>
#include <vector>

#include "facts/fact_keys.hpp"

namespace sdre {

/// Values of the drive's incremental encoder, in lines; the first is the one to use. InputError for an absolute encoder
/// alone, for none, and for a number that may be of lines or of counts.
struct EncoderLines {
    double      lines;
    std::string text;
};
std::vector<EncoderLines> encoder_lines_of(const Facts &facts);

} // namespace sdre
