// SPDX-License-Identifier: MIT
// Profile position over Modbus; simulated time only.
#include <gtest/gtest.h>

#include <cmath>

#include "position_client.hpp"

using namespace sdre;

namespace {

constexpr int within_cnt = 4; // the window of target reached; a shaft at rest hunts by two

class Positions : public PositionClient {
protected:
    const Motor &motor = served.drive().motor;
};

} // namespace

TEST_F(Positions, TurnsToATargetAndHoldsItUnderALoad)
{
    hold();
    const int    begin = now();
    const double from  = served.turns();
    set_point(begin + 3 * counts_per_turn, 0);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 1.0));
    EXPECT_NEAR(now(), begin + 3 * counts_per_turn, within_cnt);
    EXPECT_NEAR(served.turns() - from, 3.0, 5.5 / counts_per_turn);
    served.dynamometer().drive(0.5 * motor.rated_torque_Nm);
    talk(0.3);
    EXPECT_NEAR(now(), begin + 3 * counts_per_turn, within_cnt);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Positions, SetPointsFollowEachOtherAndHaltInterruptsThem)
{
    hold();
    const int begin = now();
    set_point(2 * counts_per_turn, APP_CONTROL_RELATIVE);
    set_point(-counts_per_turn / 2, APP_CONTROL_RELATIVE); // waits
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 1.0));
    talk(0.3);
    EXPECT_NEAR(now(), begin + counts_per_turn * 3 / 2, within_cnt);

    set_point(20 * counts_per_turn, APP_CONTROL_RELATIVE);
    talk(0.1);
    ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_HALT));
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 1.0));
    const int halted = now();
    EXPECT_GT(halted, begin + 2 * counts_per_turn);
    EXPECT_LT(halted, begin + 20 * counts_per_turn);
    ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION));
    talk(0.1);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 3.0));
    EXPECT_NEAR(now(), begin + counts_per_turn * 43 / 2, within_cnt);
}

TEST_F(Positions, AShaftThatIsHeldBackIsWaitedForAndDoesNotJumpWhenItIsLetGo)
{
    hold();
    const int begin = now();
    // below what the load takes
    ASSERT_TRUE(
        write_two(APP_REGISTERS_MAX_CURRENT, static_cast<int>(375.0 * motor.max_current_A)));
    served.dynamometer().drive(-0.8 * motor.rated_torque_Nm);
    set_point(4 * counts_per_turn, APP_CONTROL_RELATIVE);
    EXPECT_TRUE(wait_for(APP_REGISTERS_FOLLOWING_ERROR, 0.2));
    served.dynamometer().drive(0.0);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 3.0));
    EXPECT_NEAR(now(), begin + 4 * counts_per_turn, within_cnt);
}

TEST_F(Positions, TheZeroIsTheIndexMark)
{
    hold();
    set_point(2 * counts_per_turn, APP_CONTROL_RELATIVE); // past the mark
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 1.0));
    ASSERT_TRUE(control(APP_CONTROL_DISABLE_VOLTAGE));
    talk(0.5);
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_FIND_ANGLE));
    ASSERT_TRUE(control(APP_CONTROL_SHUT_DOWN));
    ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION));
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, align_s));
    talk(0.1);
    const double from = static_cast<double>(now()) / counts_per_turn;
    // The mark is the shaft's zero, and a count is named by its middle.
    EXPECT_NEAR(std::remainder(served.turns() - from, 1.0) * counts_per_turn, 0.5, 2.0);
}
