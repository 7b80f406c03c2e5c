// SPDX-License-Identifier: MIT
// Homing of an axis that has a home switch and no other.
#include "homing_client.hpp"

using namespace sdre;

namespace {

class Homing : public HomingClient {
protected:
    void turn_to(double turns)
    {
        ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_POSITION));
        talk(0.05);
        set_point(now() + static_cast<int>(std::lround((turns - served.turns()) / count)),
                  APP_CONTROL_AT_ONCE);
        ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
        ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_HOMING));
        talk(0.11);
    }
};

} // namespace

TEST_F(Homing, EachEdgeOfTheSwitchIsFoundFromTheSideOnWhichTheShaftIs)
{
    enable_homing(4); // the home switch
    for (const Edge &e : edges) {
        const double from =
            e.method <= 10 ? 0.4 : 2.6; // these begin forwards, the others backwards
        turn_to(from);
        ASSERT_NO_FATAL_FAILURE(home_at(e));
        turn_to(from);
        ASSERT_NO_FATAL_FAILURE(home_at_its_mark(e));
    }
    EXPECT_EQ(input(APP_REGISTERS_HOMED), 1);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Homing, APositionAfterItCountsFromHome)
{
    enable_homing(4);
    ASSERT_TRUE(home(24));
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_POSITION));
    talk(0.05);
    set_point(0, APP_CONTROL_AT_ONCE);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
    EXPECT_NEAR(served.turns(), lower, within + 4 * count);
    set_point(-2 * counts_per_turn, APP_CONTROL_AT_ONCE);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
    EXPECT_NEAR(served.turns(), lower - 2.0, within + 4 * count);
}

TEST_F(Homing, APolarityTurnsDirectionsAndSwitchesRound)
{
    pass(0.4);
    ASSERT_TRUE(write_one(APP_REGISTERS_POLARITY, APP_UNITS_REVERSES_POSITION));
    // The operator's negative switch is where the motor's turns grow.
    served.switches().negative.reset();
    served.switches().positive.reset();
    enable_homing(0);
    ASSERT_TRUE(home(34));
    const double first = served.turns();
    ASSERT_TRUE(home(34));
    EXPECT_NEAR(served.turns() - first, -1.0, 0.1);
}

TEST_F(Homing, ItFailsWithoutItsSwitchAndStaysEnabled)
{
    enable_homing(3);
    EXPECT_FALSE(home(24));
    EXPECT_TRUE(has(APP_REGISTERS_FOLLOWING_ERROR));
    EXPECT_EQ(input(APP_REGISTERS_HOMING_STAGE), APP_HOMING_FAILED);
    EXPECT_EQ(input(APP_REGISTERS_HOMED), 0);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    EXPECT_TRUE(home(37));
}
