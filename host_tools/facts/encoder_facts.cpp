// SPDX-License-Identifier: MIT
#include "facts/encoder_facts.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

constexpr int counts_per_line = 4;

} // namespace

std::vector<EncoderLines> encoder_lines_of(const Facts &facts)
{
    std::vector<EncoderLines> values;
    for (const Fact &f : facts.of("encoder_lines")) {
        values.push_back({f.si, f.text});
    }
    for (const Fact &f : facts.of("encoder_counts")) {
        values.push_back({std::floor(f.si / counts_per_line), f.text});
    }
    for (const Fact &f : facts.of("encoder_cpr")) {
        throw InputError(
            fmt::format("{}: {} may be cycles or counts of a turn: write encoder_lines = {:g} or "
                        "encoder_counts = {:g} (four a line)",
                        facts.source, f.text, f.si, f.si));
    }
    for (const Fact &f : facts.of("encoder_bits")) {
        if (values.empty()) {
            throw InputError(
                fmt::format("{}: {} is of an absolute encoder, which the drive does not read: give "
                            "encoder_lines of its incremental output (A, B)",
                            facts.source, f.text));
        }
    }
    if (values.empty()) {
        throw InputError(fmt::format(
            "{}: encoder_lines is missing: the drive needs an incremental encoder (A, B); it does "
            "not run without one",
            facts.source));
    }
    return values;
}

} // namespace sdre
