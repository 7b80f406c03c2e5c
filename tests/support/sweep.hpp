// SPDX-License-Identifier: MIT
/// Sweeps take many machines or faults through the same code. The environment variable SDRE_SWEEP says how many of them:
///
///     not set   all: `./dev test all`, and a test by itself
///     some      `./dev test`, where a sweep says what some are; else all
///     few       `./dev test sanitized`: a sanitizer sees in a few of them what it would see in all
///
/// The assertions are the same.
#pragma once

#include <cstdlib>
#include <string_view>
#include <vector>

namespace support {

inline bool sweep_is(std::string_view size)
{
    const char *const text = std::getenv("SDRE_SWEEP");
    return text != nullptr && size == text;
}

template <typename Value> Value swept(Value whole, Value few, Value some)
{
    return sweep_is("few") ? few : sweep_is("some") ? some : whole;
}

template <typename Value> Value swept(Value whole, Value few)
{
    return swept(whole, few, whole);
}

/// All elements, or each `step`-th of them in a sanitized run.
template <typename Element>
std::vector<Element> swept_each(const std::vector<Element> &all, std::size_t step)
{
    std::vector<Element> taken;
    for (std::size_t k = 0; k < all.size(); k += swept<std::size_t>(1, step)) {
        taken.push_back(all[k]);
    }
    return taken;
}

} // namespace support
