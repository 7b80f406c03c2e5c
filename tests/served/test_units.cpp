// SPDX-License-Identifier: MIT
// Position units, polarity and limits of position.
#include <gtest/gtest.h>

#include <cmath>

#include "position_client.hpp"

using namespace sdre;

namespace {

constexpr double turn_e_rad = 2 * 2 * 3.14159265358979; // two pole pairs
constexpr int    spindle_um = 5000;

/// A gear of 46 : 9 and a spindle of 5 mm; positions count micrometres.
class Units : public PositionClient {
protected:
    void set(int polarity)
    {
        pass(0.4);
        ASSERT_TRUE(write_one(APP_REGISTERS_GEAR_MOTOR, 46));
        ASSERT_TRUE(write_one(APP_REGISTERS_GEAR_SHAFT, 9));
        ASSERT_TRUE(write_two(APP_REGISTERS_FEED, spindle_um));
        ASSERT_TRUE(write_one(APP_REGISTERS_POLARITY, polarity));
        ASSERT_TRUE(write_one(APP_REGISTERS_POSITION_WINDOW, 1));
    }
    double turned() const
    {
        return served.plant_state().theta_e_rad / turn_e_rad;
    }
    void expect_a_way_of_ten_millimetres(double turns)
    {
        hold();
        const int    begin_um = now();
        const double start    = turned();
        set_point(begin_um + 2 * spindle_um, 0);
        ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
        EXPECT_NEAR(now(), begin_um + 2 * spindle_um, 1);
        EXPECT_NEAR(both(APP_REGISTERS_POSITION_TARGET), begin_um + 2 * spindle_um, 0);
        EXPECT_NEAR(turned() - start, turns, 46.0 / 9 / spindle_um); // POSITION_WINDOW
    }
};

} // namespace

TEST_F(Units, AGearAndASpindleMakeMicrometres)
{
    set(0);
    expect_a_way_of_ten_millimetres(2.0 * 46 / 9);
    EXPECT_FALSE(write_one(APP_REGISTERS_GEAR_MOTOR, 47)); // not in a run
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(Units, ThePolarityTurnsPositionAndSpeedRound)
{
    set(APP_UNITS_REVERSES_POSITION | APP_UNITS_REVERSES_SPEED | APP_UNITS_REVERSES_TORQUE);
    expect_a_way_of_ten_millimetres(-2.0 * 46 / 9);
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_VELOCITY));
    ASSERT_TRUE(write_two(APP_REGISTERS_SPEED_RPM, 3000));
    talk(0.5);
    EXPECT_NEAR(both(APP_REGISTERS_SPEED_NOW_RPM), 3000, 30);
    EXPECT_NEAR(served.plant_state().omega_e_radps, -2 * 300 * 2 * 3.14159265 / 60, 1.0);
    const int from = now();
    talk(0.1);
    EXPECT_GT(now(), from);
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_TORQUE));
    ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE, 200));
    pass(0.02);
    EXPECT_GT(static_cast<std::int16_t>(input(APP_REGISTERS_TORQUE_NOW)), 150);
    EXPECT_LT(served.plant_state().omega_e_radps, -2 * 310 * 2 * 3.14159265 / 60);
}

TEST_F(Units, TargetsStayWithinTheLimits)
{
    set(0);
    hold();
    const int begin_um = now();
    ASSERT_TRUE(write_two(APP_REGISTERS_POSITION_LEAST, begin_um - 2000));
    ASSERT_TRUE(write_two(APP_REGISTERS_POSITION_MOST, begin_um + 3000));
    set_point(begin_um + 3001, APP_CONTROL_AT_ONCE);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
    EXPECT_NEAR(now(), begin_um + 3000, 1);
    EXPECT_TRUE(has(APP_REGISTERS_LIMITED));
    set_point(-9000, APP_CONTROL_AT_ONCE | APP_CONTROL_RELATIVE);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
    EXPECT_NEAR(now(), begin_um - 2000, 1);
    set_point(begin_um + 2999, APP_CONTROL_AT_ONCE);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, 2.0));
    EXPECT_NEAR(now(), begin_um + 2999, 1);
    EXPECT_FALSE(has(APP_REGISTERS_LIMITED));
}

TEST_F(Units, SetPointsOfAMasterStayWithinTheLimits)
{
    set(0);
    hold();
    const int begin_um = now();
    ASSERT_TRUE(write_two(APP_REGISTERS_POSITION_LEAST, begin_um - 1000));
    ASSERT_TRUE(write_two(APP_REGISTERS_POSITION_MOST, begin_um + 1000));
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_CYCLIC_POSITION));
    for (int n = 0; n <= 100; n++) { // 10 mm/s
        pass(0.01);
        ASSERT_TRUE(write_two(APP_REGISTERS_TARGET_POSITION, begin_um + n * 100));
        EXPECT_LT(now(), begin_um + 1100);
    }
    EXPECT_NEAR(now(), begin_um + 1000, 1);
    EXPECT_TRUE(has(APP_REGISTERS_LIMITED));
}
