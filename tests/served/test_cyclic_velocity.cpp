// SPDX-License-Identifier: MIT
// Cyclic velocity over Modbus; simulated time only. A master sends set-points
// of a sine; the speed is the shaft's own.
#include <gtest/gtest.h>

#include <cmath>

#include "cyclic_client.hpp"

using namespace sdre;

namespace {

constexpr double most_e_radps = 200.0; // of the sine, which has 1 Hz
const double     circle       = 2.0 * std::acos(-1.0);

double sine_e_radps(double time_s)
{
    return most_e_radps * std::sin(circle * time_s);
}

class CyclicVelocity : public CyclicClient {
protected:
    CyclicVelocity() : CyclicClient(sine_e_radps, 0.5) {}

    void after_period() override
    {
        note(served.plant_state().omega_e_radps);
    }
    bool write_speed(unsigned number, double tenths)
    {
        return write_two(number, static_cast<int>(std::lround(tenths)));
    }
    void begin(int period_ms)
    {
        CyclicClient::begin(APP_CONTROL_CYCLIC_VELOCITY, period_ms);
    }
    void send(double period_s, double jitter, int lost_each, double length_s)
    {
        send_each(period_s, jitter, lost_each, length_s, [this](double time_s) {
            return write_speed(APP_REGISTERS_SPEED, 10.0 * sine_e_radps(time_s));
        });
    }
    /// The delay that brings them nearest.
    double delay_s() const
    {
        double best_s = 0.0;
        for (double s = 0.0; s < 0.1; s += 1e-4) {
            best_s = rms(s) < rms(best_s) ? s : best_s;
        }
        return best_s;
    }
};

} // namespace

TEST_F(CyclicVelocity, ASineIsFollowedAnInterpolationPeriodLater)
{
    begin(20);
    send(0.02, 0.0, 0, 2.0);
    // A request of 13 characters and the silence after it take 3.0 ms; a millisecond is the drive's.
    EXPECT_GE(delay_s(), 0.020);
    EXPECT_LE(delay_s(), 0.0241);
    EXPECT_LE(rms(delay_s()),
              sine_band_e_radps); // the chord of an arc alone is off by 0.3 in its middle
    EXPECT_EQ(input(APP_REGISTERS_MODE_NOW), APP_CONTROL_CYCLIC_VELOCITY);
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(CyclicVelocity, JitterAndLostSetPointsMoveItNoFurtherThanTheyAreLate)
{
    begin(20);
    send(0.02, 0.3, 50, 3.0);
    const double later_s  = 0.02 * 1.3; // by a lost one and the jitter of the next
    const double steepest = circle * most_e_radps;
    EXPECT_LE(farthest(0.024), steepest * later_s);
    EXPECT_LE(rms(0.024), 4.5);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
}

TEST_F(CyclicVelocity, TheOffsetIsAddedAndTheModeIsTakenOverInARun)
{
    begin(5);
    ASSERT_TRUE(write_speed(APP_REGISTERS_SPEED, 1000.0));
    ASSERT_TRUE(write_speed(APP_REGISTERS_VELOCITY_OFFSET,
                            10.0 * 100.0 * 60.0 / circle / served.drive().motor.pole_pairs));
    pass(0.2);
    EXPECT_NEAR(served.plant_state().omega_e_radps, 200.0, 1.0);
    EXPECT_NE(input(APP_REGISTERS_STATUSWORD) & APP_REGISTERS_REACHED, 0);
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_VELOCITY));
    pass(0.2);
    EXPECT_NEAR(served.plant_state().omega_e_radps, 100.0, 1.0); // which has no offset
}

TEST_F(CyclicVelocity, WhenSetPointsStopTheSpeedStaysAndThenTheLossActs)
{
    begin(20);
    ASSERT_TRUE(write_one(APP_REGISTERS_LOST_OPTION, APP_CONTROL_LOST_QUICK_STOP));
    ASSERT_TRUE(write_speed(APP_REGISTERS_SPEED, 2000.0));
    pass(0.45);
    EXPECT_NEAR(served.plant_state().omega_e_radps, 200.0, 1.0);
    EXPECT_TRUE(served.bridge_on());
    pass(0.5); // MODBUS_TIMEOUT is half a second
    EXPECT_NEAR(served.plant_state().omega_e_radps, 0.0, 3.0);
    EXPECT_FALSE(served.bridge_on());
}
