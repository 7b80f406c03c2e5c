// SPDX-License-Identifier: MIT
/// USART2 with the far end of its line. An octet takes its time.
#pragma once

#include <deque>

#include "stm32g431/registers.hpp"

namespace iss::stm32g431 {

class Serial : public Registers {
public:
    explicit Serial(Core &core);
    void reset() override;

    void          send(std::uint8_t octet); ///< from the far end
    int           take();                   ///< -1: nothing
    std::uint64_t due() const;
    void          step(); ///< what is due, happens
    bool          interrupts() const;

protected:
    std::uint32_t on_read(std::uint32_t offset) override;
    void          on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    std::uint64_t octet_cycles() const;
    bool          on() const;

    std::deque<std::uint8_t> coming_;
    std::deque<std::uint8_t> received_; // its FIFO
    std::deque<std::uint8_t> leaving_;
    std::deque<std::uint8_t> sent_;
    std::uint64_t            comes_  = UINT64_MAX;
    std::uint64_t            leaves_ = UINT64_MAX;
    bool                     lost_   = false;
};

} // namespace iss::stm32g431
