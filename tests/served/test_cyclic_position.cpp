// SPDX-License-Identifier: MIT
// Cyclic position over Modbus; simulated time only. A master sends set-points
// of a sine; the position is the shaft's own.
#include <gtest/gtest.h>

#include <cmath>

#include "cyclic_client.hpp"

using namespace sdre;

namespace {

constexpr int    per_turn = 10000;
constexpr double turns    = 2.0; // of the sine, which has 1 Hz
const double     circle   = 2.0 * std::acos(-1.0);

double sine_cnt(double time_s)
{
    return turns * per_turn * std::sin(circle * time_s);
}

double sine_rpm(double time_s)
{
    return turns * 60.0 * circle * std::cos(circle * time_s);
}

class CyclicPosition : public CyclicClient {
protected:
    CyclicPosition() : CyclicClient(sine_cnt, 1.5) {}

    void after_period() override
    {
        note(turned_cnt());
    }
    double turned_cnt() const
    {
        return served.turns() * per_turn - begin_cnt;
    }
    bool write_target(double counts)
    {
        return write_two(APP_REGISTERS_TARGET_POSITION, static_cast<int>(std::lround(counts)));
    }
    bool write_both(double counts, double rpm)
    {
        return write_two(APP_REGISTERS_VELOCITY_OFFSET,
                         static_cast<int>(std::lround(10.0 * rpm))) &&
               write_target(counts);
    }
    int position_cnt()
    {
        const Octets a = ask({4, 0, APP_REGISTERS_POSITION_NOW, 0, 2});
        return a.size() == 6 ? static_cast<int>((static_cast<unsigned>(a[2]) << 24U) |
                                                (a[3] << 16) | (a[4] << 8) | a[5])
                             : 0;
    }
    void begin(int period_ms)
    {
        CyclicClient::begin(APP_CONTROL_CYCLIC_POSITION, period_ms);
        base_cnt  = position_cnt();
        begin_cnt = served.turns() * per_turn;
        begin_time();
    }
    void send(double period_s, double jitter, int lost_each, double length_s, bool offset = false)
    {
        send_each(period_s, jitter, lost_each, length_s, [&](double time_s) {
            const double x = base_cnt + sine_cnt(time_s);
            return offset ? write_both(x, sine_rpm(time_s)) : write_target(x);
        });
    }
    /// The delay that brings them nearest.
    double delay_s() const
    {
        double best_s = 0.0;
        for (const double each_s : {1e-3, 1e-4, 1e-5, 1e-6}) {
            const double around_s = best_s;
            for (int n = each_s < 1e-3 ? -20 : 0; n < (each_s < 1e-3 ? 21 : 150); n++) {
                const double s = around_s + n * each_s;
                best_s         = rms(s) < rms(best_s) ? s : best_s;
            }
        }
        return best_s;
    }
    void record()
    {
        RecordProperty("delay_us", static_cast<int>(1e6 * delay_s()));
        RecordProperty("rms_thousandths", static_cast<int>(1e3 * rms(delay_s())));
        RecordProperty("farthest_cnt", static_cast<int>(farthest(delay_s())));
    }

    double begin_cnt = 0.0; ///< of the shaft, like turned_cnt()
    int    base_cnt  = 0;   ///< of the drive
};

} // namespace

TEST_F(CyclicPosition, ASineIsFollowedAnInterpolationPeriodLater)
{
    begin(20);
    send(0.02, 0.0, 0, 3.5);
    // A request of 13 characters and the silence after it take 3.0 ms; a millisecond is the drive's.
    EXPECT_GE(delay_s(), 0.020);
    EXPECT_LE(delay_s(), 0.0241);
    EXPECT_LE(rms(delay_s()), 6.0);
    record();
    EXPECT_EQ(input(APP_REGISTERS_MODE_NOW), APP_CONTROL_CYCLIC_POSITION);
    EXPECT_TRUE(has(APP_REGISTERS_OF_MODE));
    EXPECT_FALSE(has(APP_REGISTERS_FOLLOWING_ERROR));
    EXPECT_TRUE(served.findings().empty());
}

TEST_F(CyclicPosition, TheSpeedAtTheSetPointsBringsItNearer)
{
    begin(20);
    send(0.02, 0.0, 0, 3.5, true);
    EXPECT_LE(delay_s(), 0.0325); // the request of the speed comes first, and its answer
    EXPECT_LE(rms(delay_s()), 2.0);
    record();
}

TEST_F(CyclicPosition, SlowSetPointsAreFollowedToo)
{
    begin(50);
    send(0.05, 0.0, 0, 3.5);
    EXPECT_GE(delay_s(), 0.050);
    EXPECT_LE(delay_s(), 0.0545);
    EXPECT_LE(rms(delay_s()), 8.0);
    record();
}

TEST_F(CyclicPosition, JitterAndLostSetPointsKeepItWithinAShareOfAPeriod)
{
    begin(20);
    send(0.02, 0.3, 100, 5.0);
    const double steepest = circle * turns * per_turn;
    EXPECT_LE(delay_s(), 0.0241 + 0.001);
    EXPECT_LE(rms(delay_s()), 60.0);
    record();
    EXPECT_LE(farthest(delay_s()), steepest * 0.1 * 0.02);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    EXPECT_FALSE(has(APP_REGISTERS_FOLLOWING_ERROR));
}

TEST_F(CyclicPosition, WhenSetPointsStopItRunsOnAndThenTheLossActs)
{
    begin(20);
    ASSERT_TRUE(write_one(APP_REGISTERS_LOST_OPTION, APP_CONTROL_LOST_QUICK_STOP));
    send(0.02, 0.0, 0, 2.0);
    const double running_radps = served.plant_state().omega_e_radps;
    EXPECT_GT(running_radps, 100.0);
    pass(0.05); // in all 80 ms after the last one
    EXPECT_GT(served.plant_state().omega_e_radps, 0.8 * running_radps);
    EXPECT_TRUE(served.bridge_on());
    pass(0.2); // before MODBUS_TIMEOUT
    EXPECT_NEAR(served.plant_state().omega_e_radps, 0.0,
                6.0); // it opens below 20 rad/s; measured: 4.1 at most
    EXPECT_FALSE(served.bridge_on());
    EXPECT_NE(input(APP_REGISTERS_CONDITIONS) & APP_REGISTERS_SILENT, 0);
}

TEST_F(CyclicPosition, AFollowingErrorBeyondItsWindowIsAFault)
{
    begin(20);
    ASSERT_TRUE(write_two(APP_REGISTERS_FOLLOWING_WINDOW, 200));
    ASSERT_TRUE(write_one(APP_REGISTERS_FOLLOWING_TIMEOUT, 50));
    send(0.02, 0.0, 0, 1.2);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    ASSERT_TRUE(write_two(APP_REGISTERS_MAX_CURRENT, 50)); // too little for the sine
    zero_s = served.time_s();
    send(0.02, 0.0, 0, 1.2);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_FAULT);
    EXPECT_EQ(input(APP_REGISTERS_FAULT), APP_FAULT_FOLLOWING);
    EXPECT_EQ(input(APP_REGISTERS_ERROR_CODE), 0x8611);
}

TEST_F(CyclicPosition, RunsChangeIntoItAndBackWithoutABump)
{
    begin(20);
    for (const int mode : {APP_CONTROL_PROFILE_POSITION, APP_CONTROL_PROFILE_VELOCITY,
                           APP_CONTROL_CYCLIC_VELOCITY, APP_CONTROL_CYCLIC_TORQUE}) {
        ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, mode));
        pass(0.05);
        ASSERT_EQ(input(APP_REGISTERS_MODE_NOW), mode);
        ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_CYCLIC_POSITION));
        pass(0.05);
        ASSERT_EQ(input(APP_REGISTERS_MODE_NOW), APP_CONTROL_CYCLIC_POSITION);
        EXPECT_TRUE(served.bridge_on());
        EXPECT_LE(std::abs(turned_cnt()), 20.0) << mode; // measured with twelve seeds: at most 16
    }
}

TEST_F(CyclicPosition, AShaftThatTurnsComesToRestBeforeTheFirstSetPoint)
{
    begin(20);
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_VELOCITY));
    ASSERT_TRUE(write_two(APP_REGISTERS_SPEED, 3000));
    pass(0.3);
    EXPECT_NEAR(served.plant_state().omega_e_radps, 300.0, 1.0);
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_CYCLIC_POSITION));
    pass(0.3);
    EXPECT_NEAR(served.plant_state().omega_e_radps, 0.0, 1.0);
    EXPECT_TRUE(served.bridge_on());
    // A step of the set-points, which takes the time that it needs.
    const int from_cnt = position_cnt();
    for (int n = 0; n < 40; n++) {
        ASSERT_TRUE(write_target(from_cnt + per_turn));
        pass(0.012);
    }
    EXPECT_NEAR(position_cnt(), from_cnt + per_turn, 3);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
}

TEST_F(CyclicPosition, TheOffsetMovesTheTargetAndValuesOutOfRangeAreRefused)
{
    begin(20);
    ASSERT_TRUE(write_two(APP_REGISTERS_POSITION_OFFSET, 500));
    for (int n = 0; n < 30; n++) {
        ASSERT_TRUE(write_target(base_cnt - 200));
        pass(0.012);
    }
    EXPECT_NEAR(position_cnt(), base_cnt + 300, 3);
    EXPECT_FALSE(write_two(APP_REGISTERS_TARGET_POSITION, 1000001000));
    EXPECT_FALSE(write_two(APP_REGISTERS_POSITION_OFFSET, -1000001000));
    EXPECT_FALSE(write_one(APP_REGISTERS_INTERPOLATION_PERIOD, 0));
    EXPECT_FALSE(write_one(APP_REGISTERS_INTERPOLATION_PERIOD, 101));
    EXPECT_TRUE(served.bridge_on());
}
