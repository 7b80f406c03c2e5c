// SPDX-License-Identifier: MIT
// The torque modes over Modbus; simulated time only. The torque is the
// machine's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "running_client.hpp"

using namespace sdre;

namespace {

constexpr double rated_Nm        = 1.5;
constexpr double window_s        = 4e-3; // of a mean: the sensors' noise is not the law's
constexpr int    slow_e_radps2   = 30;   // takes 0.4 % of the rated torque
const double     rpm_per_e_radps = 60.0 / (2.0 * std::acos(-1.0)) / 2.0;

class Torques : public RunningClient {
protected:
    struct Period {
        double time_s;
        double torque_Nm;
        double omega_e_radps;
        bool   bridge_on;
    };

    void after_period() override
    {
        const PlantState &s = served.plant_state();
        all.push_back({served.time_s(), s.torque_Nm, s.omega_e_radps, served.bridge_on()});
    }
    int actual(unsigned number)
    {
        return static_cast<std::int16_t>(input(number));
    }
    double speed_e_radps() const
    {
        return served.plant_state().omega_e_radps;
    }
    void set_ramp(int e_radps2)
    {
        for (const unsigned ramp : {APP_REGISTERS_ACCELERATION, APP_REGISTERS_DECELERATION}) {
            ASSERT_TRUE(write_two(ramp, e_radps2));
        }
    }
    /// Mean torque of a window that begins at this time.
    double mean_Nm(double from_s) const
    {
        double sum = 0.0;
        int    n   = 0;
        for (const Period &p : all) {
            if (p.time_s >= from_s && p.time_s < from_s + window_s) {
                sum += p.torque_Nm;
                n++;
            }
        }
        return n > 0 ? sum / n : NAN;
    }
    /// TORQUE becomes the torque that the drive has, over 0.1 s.
    void command_what_there_is()
    {
        const int readings = 16;
        int       sum      = 0;
        for (int n = 0; n < readings; n++) {
            sum += actual(APP_REGISTERS_TORQUE_DEMAND);
        }
        ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE, sum / readings));
    }
    /// The largest difference of such a mean from this torque, since a time.
    double most_off_Nm(double torque_Nm, double since_s) const
    {
        double most = 0.0;
        for (double at_s = since_s; at_s + window_s < all.back().time_s; at_s += window_s / 4) {
            most = std::max(most, std::abs(mean_Nm(at_s) - torque_Nm));
        }
        return most;
    }

    std::vector<Period> all;
};

} // namespace

TEST_F(Torques, TheSpeedLimitHoldsAndGivesBackInAllFourQuadrants)
{
    const double limit_rpm = 1000.0;
    enable(APP_CONTROL_PROFILE_TORQUE);
    ASSERT_TRUE(write_two(APP_REGISTERS_TORQUE_SPEED_MAX, static_cast<int>(limit_rpm)));
    ASSERT_TRUE(
        write_two(APP_REGISTERS_TORQUE_SLOPE, 10000)); // ten times the rated torque in a second
    for (const int share : {300, -300, 300}) { // motors, then brakes and turns, then both again
        ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE, share));
        talk(0.4);
        const double sign = share > 0 ? 1.0 : -1.0;
        EXPECT_NEAR(sign * speed_e_radps() * rpm_per_e_radps, limit_rpm, 0.01 * limit_rpm);
        EXPECT_FALSE(has(APP_REGISTERS_REACHED)); // the limit takes the torque away
    }
    for (const Period &p : all) {
        ASSERT_LT(std::abs(p.omega_e_radps) * rpm_per_e_radps, 1.02 * limit_rpm) << p.time_s;
    }
    served.dynamometer().drive(0.45); // what is commanded: the torque is there again, at any speed
    ASSERT_TRUE(write_two(APP_REGISTERS_TORQUE_SPEED_MAX, static_cast<int>(2.0 * limit_rpm)));
    talk(0.3);
    EXPECT_TRUE(has(APP_REGISTERS_REACHED));
    EXPECT_NEAR(mean_Nm(served.time_s() - window_s), 0.45, 0.01 * rated_Nm);
    // One sample each. Measured with twelve seeds: within 14 and 2.
    EXPECT_NEAR(actual(APP_REGISTERS_TORQUE_NOW), 300, 20);
    EXPECT_NEAR(actual(APP_REGISTERS_TORQUE_DEMAND), 300, 3);
    EXPECT_TRUE(served.findings().empty());
}

/// PROFILE_SPEED_MAX (607Fh) counts 0.1 r/min, TORQUE_SPEED_MAX (6080h) whole ones.
TEST_F(Torques, OneLimitActsInTorquesSpeedsAndPositions)
{
    const double limit_rpm = 800.0;
    enable(APP_CONTROL_PROFILE_TORQUE);
    set_ramp(2000);
    ASSERT_TRUE(write_two(APP_REGISTERS_TORQUE_SPEED_MAX, static_cast<int>(1.5 * limit_rpm)));
    ASSERT_TRUE(write_two(APP_REGISTERS_PROFILE_SPEED_MAX, static_cast<int>(10.0 * limit_rpm)));
    ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE, 300));
    talk(0.4);
    EXPECT_NEAR(speed_e_radps() * rpm_per_e_radps, limit_rpm, 0.01 * limit_rpm);

    ASSERT_TRUE(write_two(APP_REGISTERS_SPEED_RPM, static_cast<int>(-20.0 * limit_rpm)));
    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_VELOCITY));
    talk(0.5);
    EXPECT_NEAR(speed_e_radps() * rpm_per_e_radps, -limit_rpm, 0.005 * limit_rpm);
    EXPECT_TRUE(has(APP_REGISTERS_LIMITED));
    EXPECT_FALSE(has(APP_REGISTERS_REACHED));
    ASSERT_TRUE(write_two(APP_REGISTERS_SPEED_RPM, 0));
    talk(0.5);
    EXPECT_FALSE(has(APP_REGISTERS_LIMITED));

    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_POSITION));
    ASSERT_TRUE(write_two(APP_REGISTERS_TARGET_POSITION, 100000)); // ten turns
    ASSERT_TRUE(write_one(APP_REGISTERS_CONTROLWORD,
                          APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT));
    double fastest = 0.0;
    for (int n = 0; n < 20; n++) {
        talk(0.05);
        fastest = std::max(fastest, speed_e_radps());
    }
    EXPECT_NEAR(fastest * rpm_per_e_radps, limit_rpm, 0.01 * limit_rpm);
    EXPECT_TRUE(has(APP_REGISTERS_REACHED));
}

TEST_F(Torques, TheSlopeIsThatOfProfileTorqueAlone)
{
    enable(APP_CONTROL_PROFILE_TORQUE);
    served.dynamometer().brake(4.0);                          // holds the shaft
    ASSERT_TRUE(write_two(APP_REGISTERS_TORQUE_SLOPE, 2000)); // all of it takes half a second
    const double begin_s = served.time_s();
    ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE, 800));
    talk(0.35);
    const auto first = std::find_if(all.begin(), all.end(), [&](const Period &p) {
        return p.time_s > begin_s && p.torque_Nm > 0.2 * rated_Nm;
    });
    ASSERT_NE(first, all.end());
    for (const double later_s : {0.05, 0.1, 0.2}) {
        EXPECT_NEAR(mean_Nm(first->time_s + later_s - 0.5 * window_s),
                    (0.2 + 2.0 * later_s) * rated_Nm, 0.02 * rated_Nm);
    }
    talk(0.2);
    EXPECT_NEAR(mean_Nm(served.time_s() - window_s), 0.8 * rated_Nm, 0.01 * rated_Nm);
    EXPECT_TRUE(has(APP_REGISTERS_REACHED));
    EXPECT_FALSE(has(APP_REGISTERS_OF_MODE));

    ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_CYCLIC_TORQUE));
    ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE_OFFSET, -300));
    const double cyclic_s = served.time_s();
    ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE, -100));
    talk(0.1);
    EXPECT_NEAR(mean_Nm(served.time_s() - window_s), -0.4 * rated_Nm, 0.01 * rated_Nm);
    EXPECT_TRUE(has(APP_REGISTERS_OF_MODE));
    int between = 0; // periods on the way: a step has a few
    for (const Period &p : all) {
        between +=
            (p.time_s > cyclic_s && p.torque_Nm < 0.4 * rated_Nm && p.torque_Nm > -0.3 * rated_Nm)
                ? 1
                : 0;
    }
    EXPECT_LE(between, 8);
    ASSERT_TRUE(write_one(APP_REGISTERS_MAX_TORQUE, 250));
    talk(0.1);
    EXPECT_NEAR(mean_Nm(served.time_s() - window_s), -0.25 * rated_Nm, 0.01 * rated_Nm);
}

TEST_F(Torques, RunsAtRestChangeIntoEachOtherWithoutABump)
{
    const int modes[] = {APP_CONTROL_PROFILE_POSITION, APP_CONTROL_PROFILE_VELOCITY,
                         APP_CONTROL_PROFILE_TORQUE, APP_CONTROL_CYCLIC_TORQUE};
    enable(APP_CONTROL_PROFILE_VELOCITY);
    set_ramp(slow_e_radps2); // at rest the shaft hunts, and a torque alone lets it drift
    served.dynamometer().drive(0.5 * rated_Nm);
    talk(0.3);
    for (const int from : modes) {
        for (const int to : modes) {
            // a torque alone does not hold the shaft: the speed run before it does
            ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_VELOCITY));
            talk(0.2);
            command_what_there_is();
            ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, from));
            talk(0.02);
            const double now_s  = served.time_s();
            const double before = mean_Nm(now_s - window_s);
            ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, to));
            talk(0.05);
            EXPECT_EQ(input(APP_REGISTERS_MODE_NOW), to);
            EXPECT_LT(most_off_Nm(before, now_s), 0.02 * rated_Nm) << from << " to " << to;
        }
    }
    EXPECT_TRUE(
        std::all_of(all.end() - 1000, all.end(), [](const Period &p) { return p.bridge_on; }));
}

TEST_F(Torques, ATurningShaftGoesFromASpeedToItsTorqueAndBack)
{
    enable(APP_CONTROL_PROFILE_VELOCITY);
    for (const double load : {0.5, -0.5}) {
        served.dynamometer().drive(load * rated_Nm);
        for (const int mode : {APP_CONTROL_PROFILE_TORQUE, APP_CONTROL_CYCLIC_TORQUE}) {
            set_ramp(2000);
            ASSERT_TRUE(write_two(APP_REGISTERS_SPEED, 3000));
            talk(0.4);
            set_ramp(slow_e_radps2);
            command_what_there_is();
            double now_s  = served.time_s();
            double before = mean_Nm(now_s - window_s);
            ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, mode));
            talk(0.1);
            EXPECT_EQ(input(APP_REGISTERS_MODE_NOW), mode);
            EXPECT_LT(most_off_Nm(before, now_s), 0.02 * rated_Nm) << mode << " at " << load;
            ASSERT_TRUE(write_two(APP_REGISTERS_SPEED, static_cast<int>(10.0 * speed_e_radps())));
            now_s  = served.time_s();
            before = mean_Nm(now_s - window_s);
            ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_PROFILE_VELOCITY));
            talk(0.1);
            // The ramp begins at one sample of the speed. With six seeds: median 0.9 %, at most 2.6 %.
            EXPECT_LT(most_off_Nm(before, now_s), 0.03 * rated_Nm) << "back at " << load;
        }
    }
}

TEST_F(Torques, HaltStopsTheShaftAndTheTorqueComesBack)
{
    enable(APP_CONTROL_CYCLIC_TORQUE);
    served.dynamometer().drive(0.2 * rated_Nm);
    ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE, 300));
    talk(0.15);
    EXPECT_GT(speed_e_radps(), 20.0);
    ASSERT_TRUE(
        write_one(APP_REGISTERS_CONTROLWORD, APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_HALT));
    talk(0.3);
    EXPECT_NEAR(speed_e_radps(), 0.0, 2.0);
    EXPECT_TRUE(has(APP_REGISTERS_REACHED));
    EXPECT_FALSE(has(APP_REGISTERS_OF_MODE));
    EXPECT_TRUE(served.bridge_on());
    ASSERT_TRUE(write_one(APP_REGISTERS_CONTROLWORD, APP_CONTROL_ENABLE_OPERATION));
    talk(0.1);
    EXPECT_NEAR(mean_Nm(served.time_s() - window_s), 0.3 * rated_Nm, 0.01 * rated_Nm);
}

// The load goes on: a shaft that it drives meets the diodes later, when the drive has long let go.
TEST_F(Torques, WithoutAnEncoderTheTorqueGoesToZero)
{
    for (const double speed_rpm : {0.0, 200.0, 1000.0, 4000.0}) {
        for (const int share : {-800, 500}) {
            served.power_cycle();
            enable(APP_CONTROL_PROFILE_VELOCITY);
            ASSERT_TRUE(write_two(APP_REGISTERS_SPEED_RPM, static_cast<int>(10.0 * speed_rpm)));
            served.dynamometer().drive(1e-3 * share * rated_Nm);
            talk(0.6);
            command_what_there_is();
            ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, APP_CONTROL_CYCLIC_TORQUE));
            talk(0.01);
            ASSERT_TRUE(served.bridge_on());
            const double broken_s = served.time_s();
            all.clear();
            served.break_part({broken_s, FaultKind::encoder_losing, 0, 1e6, 0.0});
            talk(0.1);
            const auto open =
                std::find_if(all.begin(), all.end(), [](const Period &p) { return !p.bridge_on; });
            ASSERT_NE(open, all.end()) << speed_rpm << " r/min, " << share;
            const auto zero = std::find_if(open, all.end(), [](const Period &p) {
                return std::abs(p.torque_Nm) < 0.003 * rated_Nm;
            });
            ASSERT_NE(zero, all.end());
            double most_Nm = 0.0;
            for (const Period &p : all) {
                most_Nm = std::max(most_Nm, std::abs(p.torque_Nm));
            }
            EXPECT_LE(open->time_s - broken_s, 1.1e-3) << speed_rpm << " r/min, " << share;
            EXPECT_LE(zero->time_s - broken_s, 6.5e-3) << speed_rpm << " r/min, " << share;
            EXPECT_LT(most_Nm,
                      (1e-3 * std::abs(share) + 0.05) * rated_Nm); // no jerk before it is open
            const int fault = input(APP_REGISTERS_DRIVE_FAULT);
            EXPECT_TRUE(fault == DRIVE_FAULT_ENCODER || fault == DRIVE_FAULT_OVER_SPEED) << fault;
            served.mend();
        }
    }
}
