// SPDX-License-Identifier: MIT
/// A client that runs the served drive in a mode of operation.
#pragma once

#include <algorithm>
#include <cstdint>

#include "served_client.hpp"

extern "C" {
#include "app_control.h"
#include "app_registers.h"
}

namespace sdre {

class RunningClient : public ServedClient {
protected:
    static constexpr double align_s = 4.0; ///< an alignment takes less

    bool write_one(unsigned number, int value)
    {
        return write(number, {static_cast<std::uint16_t>(value)});
    }
    bool write_two(unsigned number, int value)
    {
        const auto x = static_cast<std::uint32_t>(value);
        return write(number, {static_cast<std::uint16_t>(x >> 16U), static_cast<std::uint16_t>(x)});
    }
    /// Whether the status word has this bit.
    bool has(int bit)
    {
        return (input(APP_REGISTERS_STATUSWORD) & bit) != 0;
    }
    /// Asks ten times a second and more, so that the drive goes on.
    void talk(double length_s)
    {
        for (const double end_s = served.time_s() + length_s; served.time_s() < end_s;) {
            pass(std::min(0.05, end_s - served.time_s()));
            input(APP_REGISTERS_MODE);
        }
    }
    /// From power-up to a run.
    void enable(int mode_of_operation)
    {
        pass(0.4);
        ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, mode_of_operation));
        ASSERT_TRUE(write_one(APP_REGISTERS_CONTROLWORD, APP_CONTROL_SHUT_DOWN));
        ASSERT_TRUE(write_one(APP_REGISTERS_CONTROLWORD, APP_CONTROL_ENABLE_OPERATION));
        for (const double end_s = served.time_s() + align_s;
             input(APP_REGISTERS_MODE) != APP_MODE_RUN && served.time_s() < end_s;) {
            pass(0.05);
        }
        ASSERT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    }
};

} // namespace sdre
