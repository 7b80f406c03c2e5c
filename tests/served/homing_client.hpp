// SPDX-License-Identifier: MIT
/// A client that homes an axis with switches. The index mark is the zero of the bench's turns.
#pragma once

#include <cmath>
#include <utility>

#include "position_client.hpp"

namespace sdre {

/// An axis with its switches.
class HomingClient : public PositionClient {
protected:
    static constexpr double lower = 1.25; ///< of the home switch, turns
    static constexpr double upper = 1.9;
    static constexpr double count = 1.0 / counts_per_turn;
    /// At 60 r/min the shaft turns by ten counts in a millisecond, at 30 r/min by five.
    static constexpr double within = 7 * count;

    HomingClient()
    {
        served.switches() = {-4.3, 6.2, std::pair(lower, upper)};
    }
    void enable_homing(int inputs = 7)
    {
        pass(0.4);
        ASSERT_TRUE(write_one(APP_REGISTERS_INPUTS_USED, inputs));
        ASSERT_TRUE(write_two(APP_REGISTERS_HOMING_SPEED_SWITCH, 3000));
        ASSERT_TRUE(write_two(APP_REGISTERS_HOMING_SPEED_ZERO, 300));
        ASSERT_TRUE(write_two(APP_REGISTERS_HOMING_ACCELERATION, 2000));
        enable(APP_CONTROL_HOMING);
        talk(0.11);
        EXPECT_TRUE(has(APP_REGISTERS_REACHED));
        EXPECT_FALSE(has(APP_REGISTERS_OF_MODE));
    }
    bool home(int method, double longest_s = 20.0)
    {
        control(APP_CONTROL_ENABLE_OPERATION);
        write_one(APP_REGISTERS_HOMING_METHOD, method);
        control(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT);
        pass(0.05); // a status of before
        for (const double end_s = served.time_s() + longest_s;
             !has(APP_REGISTERS_REACHED) && served.time_s() < end_s;) {
            pass(0.05);
        }
        return has(APP_REGISTERS_OF_MODE) && has(APP_REGISTERS_REACHED) &&
               !has(APP_REGISTERS_FOLLOWING_ERROR);
    }
    /// Where the zero of positions is on the axis.
    double zero()
    {
        talk(0.11);
        return served.turns() - now() * count;
    }
    /// An edge of the home switch, and the way from it to its index mark.
    struct Edge {
        int    method; ///< with the mark; 16 more: without
        double at;
        int    way;
    };
    static constexpr Edge edges[]{{7, lower, -1}, {8, lower, 1},   {9, upper, -1}, {10, upper, 1},
                                  {11, upper, 1}, {12, upper, -1}, {13, lower, 1}, {14, lower, -1}};

    void home_at(const Edge &e)
    {
        ASSERT_TRUE(home(e.method + 16)) << e.method + 16;
        EXPECT_NEAR(zero(), e.at, within) << e.method + 16;
    }
    void home_at_its_mark(const Edge &e)
    {
        const double mark = e.way > 0 ? std::ceil(e.at + 1e-9) : std::floor(e.at - 1e-9);
        ASSERT_TRUE(home(e.method)) << e.method;
        EXPECT_NEAR(zero(), mark, 2 * count) << e.method;
    }
};

} // namespace sdre
