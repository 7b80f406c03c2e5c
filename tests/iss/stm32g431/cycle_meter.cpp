// SPDX-License-Identifier: MIT
#include "stm32g431/cycle_meter.hpp"

#include <algorithm>
#include <utility>

namespace iss::stm32g431 {

CycleMeter::CycleMeter(Core &core, const ElfImage &image, std::function<bool()> counts)
    : core_(core), counts_(std::move(counts))
{
    for (const auto &[name, address] : image.symbols) {
        if ((address & 1U) != 0U && image.sizes.count(name) != 0) { // a function in Thumb code
            names_[address & ~1U] = name;
        }
    }
    core_.watch_handlers(this);
}

void CycleMeter::begins(int exception, std::uint64_t cycle)
{
    if (exception == control_interrupt) {
        began_       = cycle;
        accelerated_ = waits_.accelerated();
        bare_        = waits_.bare();
        counting_    = counts_();
        core_.watch_blocks(true); // the flash keeps lines of every interrupt
    }
}

void CycleMeter::ends(int exception, std::uint64_t cycle)
{
    if (exception == control_interrupt) {
        core_.watch_blocks(false);
    }
    if (exception == control_interrupt && counting_) {
        runs_.push_back(
            {cycle - began_, waits_.accelerated() - accelerated_, waits_.bare() - bare_});
    }
}

void CycleMeter::block(std::uint32_t address, std::uint32_t octets, const BlockCost &cost)
{
    waits_.block(address, octets, cost);
    const auto after = names_.upper_bound(address);
    if (counting_ && after != names_.begin()) {
        spent_[std::prev(after)->first] += cost.cycles;
    }
}

std::vector<std::pair<double, std::string>> CycleMeter::functions() const
{
    std::vector<std::pair<double, std::string>> all;
    for (const auto &[address, cycles] : spent_) {
        all.emplace_back(static_cast<double>(cycles) / static_cast<double>(runs_.size()),
                         names_.at(address));
    }
    std::sort(all.rbegin(), all.rend());
    return all;
}

} // namespace iss::stm32g431
