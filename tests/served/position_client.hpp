// SPDX-License-Identifier: MIT
/// A client that moves the served drive to positions, with the handshake of profile position.
#pragma once

#include "running_client.hpp"

namespace sdre {

class PositionClient : public RunningClient {
protected:
    int both(unsigned number)
    {
        const Octets answer = ask({4, 0, static_cast<std::uint8_t>(number), 0, 2});
        if (answer.size() != 6) {
            return INT32_MIN;
        }
        std::uint32_t x = 0;
        for (std::size_t i = 2; i < 6; i++) {
            x = x << 8U | answer[i];
        }
        return static_cast<std::int32_t>(x);
    }
    int now()
    {
        return both(APP_REGISTERS_POSITION_NOW);
    }
    bool control(int word)
    {
        return write_one(APP_REGISTERS_CONTROLWORD, word);
    }
    /// Asks ten times a second, so that the drive goes on.
    bool wait_for(int bit, double longest_s)
    {
        const double end_s = served.time_s() + longest_s;
        bool         found = has(bit);
        while (!found && served.time_s() < end_s) {
            pass(0.05);
            found = has(bit);
        }
        return found;
    }
    void hold()
    {
        pass(0.4);
        ASSERT_TRUE(write(APP_REGISTERS_MODE_OF_OPERATION, {APP_CONTROL_PROFILE_POSITION}));
        ASSERT_TRUE(control(APP_CONTROL_SHUT_DOWN));
        ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION));
        ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, align_s)); // holds where it is
    }
    void set_point(int counts, int bits)
    {
        ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION));
        ASSERT_TRUE(write_two(APP_REGISTERS_TARGET_POSITION, counts));
        ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT | bits));
        ASSERT_TRUE(has(APP_REGISTERS_OF_MODE));
        ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION));
    }
};

} // namespace sdre
