// SPDX-License-Identifier: MIT
#include "stm32g431/flash_waits.hpp"

#include <cmath>

#include "stm32g431/flash.hpp"

namespace iss::stm32g431 {
namespace {

constexpr std::uint32_t line_octets = 8;
constexpr std::size_t   lines_kept  = 1024 / line_octets;
constexpr double        read_cycles = 5.0;
constexpr std::uint64_t waits       = 4;

} // namespace

bool FlashWaits::keep(std::uint32_t line)
{
    const auto at    = kept_.find(line);
    const bool known = at != kept_.end();
    if (known) {
        used_.splice(used_.begin(), used_, at->second);
    } else {
        used_.push_front(line);
        kept_[line] = used_.begin();
        if (used_.size() > lines_kept) {
            kept_.erase(used_.back());
            used_.pop_back();
        }
    }
    return known;
}

void FlashWaits::block(std::uint32_t address, std::uint32_t octets, const BlockCost &cost)
{
    if (address < flash_base || address - flash_base >= flash_octets) {
        return; // code in the CCM SRAM
    }
    const std::uint32_t first = address / line_octets;
    const std::uint32_t last  = (address + octets - 1U) / line_octets;
    const double        each  = static_cast<double>(cost.cycles) / (last - first + 1U);
    for (std::uint32_t line = first; line <= last; line++) {
        if (line != line_) {
            bare_ += waits;
            const bool ahead = line == line_ + 1U;
            if (!keep(line)) {
                const double left = ahead ? std::max(0.0, read_cycles - spent_) : double{waits};
                accelerated_ += static_cast<std::uint64_t>(std::lround(left));
            }
            line_  = line;
            spent_ = 0.0;
        }
        spent_ += each;
    }
    accelerated_ += waits * cost.literals;
    bare_ += waits * cost.literals;
}

} // namespace iss::stm32g431
