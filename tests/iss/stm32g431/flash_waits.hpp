// SPDX-License-Identifier: MIT
/// Cycles that a program in the flash waits for it, at 170 MHz with four wait states: an estimate from each block's place.
///
/// The flash gives 64 bits in five cycles. The accelerator keeps 1 KB of such lines, those that were used last, and reads the
/// line behind the present one ahead. Loads of literals are taken to miss its data cache. Data elsewhere in the flash is not
/// counted.
#pragma once

#include <cstdint>
#include <list>
#include <unordered_map>

#include "cycle_table.hpp"

namespace iss::stm32g431 {

class FlashWaits {
public:
    void block(std::uint32_t address, std::uint32_t octets, const BlockCost &cost);

    std::uint64_t accelerated() const
    {
        return accelerated_;
    }
    /// Without caches and without reading ahead: no run takes longer.
    std::uint64_t bare() const
    {
        return bare_;
    }

private:
    bool keep(std::uint32_t line); ///< true: it was there

    std::list<std::uint32_t>                                              used_; // the last first
    std::unordered_map<std::uint32_t, std::list<std::uint32_t>::iterator> kept_;
    std::uint32_t                                                         line_  = 0; // present one
    double                                                                spent_ = 0.0; // in it
    std::uint64_t                                                         accelerated_ = 0;
    std::uint64_t                                                         bare_        = 0;
};

} // namespace iss::stm32g431
