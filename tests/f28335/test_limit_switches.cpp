// SPDX-License-Identifier: MIT
// Homing and limit switches of an axis.
#include "homing_client.hpp"

using namespace sdre;

namespace {

class LimitSwitches : public HomingClient {};

} // namespace

TEST_F(LimitSwitches, AHomeSwitchGivesEachOfItsEdges)
{
    enable_homing();
    for (const Edge &e : edges) {
        ASSERT_NO_FATAL_FAILURE(home_at(e));
        ASSERT_NO_FATAL_FAILURE(home_at_its_mark(e));
    }
    EXPECT_EQ(input(APP_REGISTERS_HOMED), 1);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(LimitSwitches, ALimitSwitchIsHomeAndAnOffsetLiesBesideIt)
{
    enable_homing();
    ASSERT_TRUE(write_two(APP_REGISTERS_HOME_OFFSET, 3 * counts_per_turn));
    ASSERT_TRUE(home(17));
    EXPECT_NEAR(zero(), -4.3 + 3.0, within);
    EXPECT_GT(served.turns(), -4.3); // it has left the switch
    ASSERT_TRUE(home(1));
    EXPECT_NEAR(zero(), -4.0 + 3.0, 2 * count);
    ASSERT_TRUE(home(18));
    EXPECT_NEAR(zero(), 6.2 + 3.0, within);
    ASSERT_TRUE(home(33));
    EXPECT_NEAR(std::remainder(zero(), 1.0), 0.0, 2 * count);
    const double before = served.turns();
    ASSERT_TRUE(home(37));
    EXPECT_NEAR(zero(), before + 3.0, 2 * count);
    EXPECT_NEAR(served.turns(), before, 5 * count);
}

TEST_F(LimitSwitches, ALimitSwitchStopsARunAndLetsItGoBack)
{
    enable_homing();
    ASSERT_TRUE(home(24));
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_VELOCITY));
    ASSERT_TRUE(write_two(APP_REGISTERS_SPEED_RPM, 6000)); // ten turns in a second
    talk(1.0);
    EXPECT_TRUE(has(APP_REGISTERS_LIMITED));
    EXPECT_NEAR(both(APP_REGISTERS_SPEED_NOW_RPM), 0, 20);
    RecordProperty("beyond_counts", static_cast<int>((served.turns() - 6.2) / count));
    EXPECT_LT(served.turns(), 6.2 + 0.2);
    EXPECT_GT(served.turns(), 6.2);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    ASSERT_TRUE(write_two(APP_REGISTERS_SPEED_RPM, -6000));
    talk(0.2);
    EXPECT_LT(served.turns(), 6.2);
    EXPECT_FALSE(has(APP_REGISTERS_LIMITED));
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_POSITION));
    talk(0.3);
    ASSERT_TRUE(write_two(APP_REGISTERS_PROFILE_VELOCITY, 1257)); // 600 r/min
    set_point(-20 * counts_per_turn, APP_CONTROL_AT_ONCE);
    talk(1.5);
    EXPECT_GT(served.turns(), -4.3 - 0.5);
    set_point(0, 0); // not at once: the one beyond the switch is given up
    talk(0.05);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
    EXPECT_NEAR(served.turns(), lower, within + 4 * count);
    EXPECT_TRUE(served.findings().empty());
}
