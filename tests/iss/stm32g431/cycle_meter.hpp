// SPDX-License-Identifier: MIT
/// Cycles of the control interrupt, one count for each of its runs, and in which functions they are spent.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "stm32g431/chip.hpp"
#include "stm32g431/flash_waits.hpp"

namespace iss::stm32g431 {

constexpr int control_interrupt = first_interrupt + 18; // ADC1 and ADC2

class CycleMeter : public HandlerWatch {
public:
    /// Watches from now on.
    /// @param counts Asked at the beginning of each interrupt.
    CycleMeter(Core &core, const ElfImage &image, std::function<bool()> counts);

    void begins(int exception, std::uint64_t cycle) override;
    void ends(int exception, std::uint64_t cycle) override;
    void block(std::uint32_t address, std::uint32_t octets, const BlockCost &cost) override;

    struct Run {
        std::uint64_t cycles      = 0; ///< by the table of instructions
        std::uint64_t accelerated = 0; ///< waits of the flash besides, FlashWaits
        std::uint64_t bare        = 0;

        std::uint64_t estimate() const
        {
            return cycles + accelerated;
        }
        std::uint64_t bound() const
        {
            return cycles + bare;
        }
    };
    const std::vector<Run> &runs() const
    {
        return runs_;
    }
    /// Table cycles of a function in a run of the interrupt, on the mean; the largest first.
    std::vector<std::pair<double, std::string>> functions() const;

private:
    Core                                  &core_;
    std::map<std::uint32_t, std::string>   names_; // by address
    std::map<std::uint32_t, std::uint64_t> spent_; // by address of a function
    std::vector<Run>                       runs_;
    FlashWaits                             waits_;
    std::function<bool()>                  counts_;
    bool                                   counting_    = false;
    std::uint64_t                          began_       = 0;
    std::uint64_t                          accelerated_ = 0;
    std::uint64_t                          bare_        = 0;
};

} // namespace iss::stm32g431
