// SPDX-License-Identifier: MIT
// Homing and limit switches of an axis. The index mark is the zero of the bench's turns.
#include <gtest/gtest.h>

#include <cmath>

#include "position_client.hpp"

using namespace sdre;

namespace {

constexpr double lower = 1.25; // of the home switch, turns
constexpr double upper = 1.9;
constexpr double count = 1.0 / counts_per_turn;
// At 60 r/min the shaft turns by ten counts in a millisecond, at 30 r/min by five.
constexpr double within = 7 * count;

class Homing : public PositionClient {
protected:
    Homing()
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
    double mark_after(double edge, int way) const
    {
        return way > 0 ? std::ceil(edge + 1e-9) : std::floor(edge - 1e-9);
    }
};

} // namespace

TEST_F(Homing, AHomeSwitchGivesEachOfItsEdges)
{
    struct Row {
        int    method;
        double edge;
        int    way;
    };
    enable_homing();
    for (const Row row : {Row{7, lower, -1},
                          {8, lower, 1},
                          {9, upper, -1},
                          {10, upper, 1},
                          {11, upper, 1},
                          {12, upper, -1},
                          {13, lower, 1},
                          {14, lower, -1}}) {
        ASSERT_TRUE(home(row.method + 16)) << row.method + 16;
        EXPECT_NEAR(zero(), row.edge, within) << row.method + 16;
        ASSERT_TRUE(home(row.method)) << row.method;
        EXPECT_NEAR(zero(), mark_after(row.edge, row.way), 2 * count) << row.method;
    }
    EXPECT_EQ(input(APP_REGISTERS_HOMED), 1);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Homing, ALimitSwitchIsHomeAndAnOffsetLiesBesideIt)
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

TEST_F(Homing, APositionAfterItCountsFromHome)
{
    enable_homing();
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

TEST_F(Homing, ALimitSwitchStopsARunAndLetsItGoBack)
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
