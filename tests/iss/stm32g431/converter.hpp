// SPDX-License-Identifier: MIT
/// ADC1 or ADC2 with its injected sequence.
#pragma once

#include <array>

#include "stm32g431/circuit.hpp"
#include "stm32g431/registers.hpp"

namespace iss::stm32g431 {

class Converter : public Registers {
public:
    Converter(Core &core, int number);
    void reset() override;

    /// The trigger of TIM1 in this cycle: holds and converts.
    void          start(Circuit &circuit, std::uint64_t cycle);
    std::uint64_t due() const
    {
        return due_;
    }
    void end();
    bool interrupts() const;

protected:
    std::uint32_t on_read(std::uint32_t offset) override;
    void          on_write(std::uint32_t offset, std::uint32_t value) override;

private:
    int                          number_;
    std::uint64_t                due_ = UINT64_MAX;
    std::array<std::uint32_t, 4> results_{};
};

} // namespace iss::stm32g431
