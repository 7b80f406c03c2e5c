// SPDX-License-Identifier: MIT
/// A motor at rest without current, at 24 V and room temperature.
#pragma once

#include "stm32g431/circuit.hpp"

namespace iss::stm32g431 {

class StillCircuit : public Circuit {
public:
    void period_begins(const PwmPeriod &period) override
    {
        last = period;
        periods++;
    }
    void gates_change(bool enabled, double /*into_period_s*/) override
    {
        gates = enabled;
    }
    Shaft shaft() override
    {
        return {};
    }
    int code(int converter, int input) override
    {
        const bool shunt = input == 3 || input == 12;
        return shunt ? 2048 : converter == 2 ? dc_link_code : temperature_code;
    }

    static constexpr int dc_link_code     = 2867; // 24 V of 34.28
    static constexpr int temperature_code = 1310; // 25 degC

    PwmPeriod last;
    long      periods = 0;
    bool      gates   = false;
};

} // namespace iss::stm32g431
