// SPDX-License-Identifier: MIT
/// Events of a scenario file stand in the order in which they happen.
#pragma once

#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "common/toml_reader.hpp"

namespace sdre {

/// `items` have a time_s each, `what` is their key.
template <typename T>
void require_sorted(const TomlReader &t, const char *what, const std::vector<T> &items)
{
    for (std::size_t i = 1; i < items.size(); i++) {
        if (items[i].time_s <= items[i - 1].time_s) {
            t.fail(what, fmt::format("number {}: time_s = {:g} must be later than the one before",
                                     i + 1, items[i].time_s));
        }
    }
}

} // namespace sdre
