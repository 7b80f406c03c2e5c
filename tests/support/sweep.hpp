// SPDX-License-Identifier: MIT
/// Sweeps take many machines or faults through the same code. `./dev test sanitized` sets SDRE_SWEEP=few: a sanitizer sees in
/// a few of them what it would see in all. Every other run takes the whole sweep. The assertions are the same.
#pragma once

#include <cstdlib>
#include <string_view>
#include <vector>

namespace support {

inline bool few_of_a_sweep()
{
    const char *const text = std::getenv("SDRE_SWEEP");
    return text != nullptr && std::string_view(text) == "few";
}

/// `whole`, or `few` in a sanitized run.
template <typename Value> Value swept(Value whole, Value few)
{
    return few_of_a_sweep() ? few : whole;
}

/// All elements, or each `step`-th of them in a sanitized run.
template <typename Element>
std::vector<Element> swept_each(const std::vector<Element> &all, std::size_t step)
{
    std::vector<Element> some;
    for (std::size_t k = 0; k < all.size(); k += swept<std::size_t>(1, step)) {
        some.push_back(all[k]);
    }
    return some;
}

} // namespace support
