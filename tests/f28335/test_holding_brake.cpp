// SPDX-License-Identifier: MIT
// A holding brake on the shaft of the virtual device, under a load that hangs on it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "can_client.hpp"
#include "position_client.hpp"

extern "C" {
#include "app_brake.h"
}

using namespace sdre;

namespace {

constexpr double load_Nm    = 0.8; // half of the rated torque
constexpr double brake_Nm   = 3.0;
constexpr double release_s  = 0.05;
constexpr double close_s    = 0.03;
constexpr int    release_ms = 60; // of the drive: some more than the brake needs
constexpr int    close_ms   = 40;
constexpr double slow_s     = 1.5; // longer than the vector of an alignment turns
constexpr int    slow_ms    = 1600;
constexpr double late_s     = 3e-3; // app_brake.h
constexpr double pi         = 3.14159265358979323846;

struct Moment {
    double time_s;
    double turns;
    double speed_e_radps;
    double current_A;
    bool   output;
    bool   closed;
    bool   bridge;
};

class BrakedShaft : public PositionClient {
protected:
    BrakedShaft()
    {
        served.set_holding_brake({brake_Nm, release_s, close_s});
    }
    void after_period() override
    {
        const Moment now{
            served.time_s(),
            served.turns(),
            served.plant_state().omega_e_radps,
            std::hypot(served.plant_state().current_A.d, served.plant_state().current_A.q),
            served.device().brake_is_released(),
            served.brake_is_closed(),
            served.bridge_on()};
        if (now.output && !now.bridge) {
            released_without_bridge++;
        }
        moments.push_back(now);
    }
    void TearDown() override
    {
        EXPECT_EQ(released_without_bridge, 0);
        for (const std::string &f : served.findings()) {
            ADD_FAILURE() << f;
        }
    }
    void use_brake(std::uint16_t takes_ms = release_ms)
    {
        pass(0.4);
        ASSERT_TRUE(write(APP_REGISTERS_BRAKE_USED, {1, takes_ms, close_ms}));
        EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_CLOSED);
        EXPECT_EQ(input(APP_REGISTERS_DIGITAL_OUTPUTS), 1);
    }
    bool wait_for_mode(int mode, double longest_s = 4.0)
    {
        const double end_s = served.time_s() + longest_s;
        bool         found = false;
        while (!found && served.time_s() < end_s) {
            pass(0.005);
            found = input(APP_REGISTERS_MODE) == mode;
        }
        return found;
    }
    /// The first run aligns the rotor, without a load. Then the load hangs on the brake.
    void align_and_load()
    {
        use_brake();
        enable(APP_CONTROL_PROFILE_VELOCITY);
        ASSERT_TRUE(control(APP_CONTROL_SWITCHED_ON));
        ASSERT_TRUE(wait_for_mode(APP_MODE_READY));
        served.dynamometer().drive(load_Nm);
        pass(0.1);
        moments.clear();
    }
    void start(int mode_of_operation)
    {
        ASSERT_TRUE(write_one(APP_REGISTERS_MODE_OF_OPERATION, mode_of_operation));
        ASSERT_TRUE(control(APP_CONTROL_SHUT_DOWN));
        ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION));
    }
    void start_and_release(int mode_of_operation)
    {
        start(mode_of_operation);
        pass(0.2);
        ASSERT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_RELEASED);
        moments.clear();
    }
    /// Largest way from the first moment, in turns.
    double way() const
    {
        double most = 0.0;
        for (const Moment &m : moments) {
            most = std::max(most, std::abs(m.turns - moments.front().turns));
        }
        return most;
    }
    /// The moment after this time at which the output goes low.
    std::vector<Moment>::iterator expect_closed_before_the_bridge_is_off(double since_s)
    {
        const auto low = std::find_if(moments.begin(), moments.end(), [&](const Moment &m) {
            return m.time_s > since_s && !m.output;
        });
        EXPECT_NE(low, moments.end());
        const double low_s = low->time_s;
        const double closed_s =
            first([&](const Moment &m) { return m.time_s > low_s && m.closed; });
        const double off_s = first([&](const Moment &m) { return m.time_s > low_s && !m.bridge; });
        EXPECT_NEAR(closed_s, low_s + close_s, 2 * served.period_s());
        EXPECT_GE(off_s, low_s + 1e-3 * close_ms);
        EXPECT_LE(off_s, low_s + 1e-3 * close_ms + late_s);
        return low;
    }
    template <typename Is> double first(const Is &is) const
    {
        const auto m = std::find_if(moments.begin(), moments.end(), is);
        return m == moments.end() ? NAN : m->time_s;
    }
    /// Way of a free fall, from rest, until the brake has closed.
    double fall_turns() const
    {
        const Motor &m = served.drive().motor;
        return 0.5 * load_Nm / m.inertia_kgm2 * close_s * close_s / (2.0 * pi);
    }

    std::vector<Moment> moments;
    int                 released_without_bridge = 0;
};

constexpr double degree = 1.0 / 360.0;

} // namespace

TEST_F(BrakedShaft, AStartHoldsTheLoadAndSetPointsWaitForTheRelease)
{
    align_and_load();
    ASSERT_TRUE(write_two(APP_REGISTERS_SPEED, 1000)); // 100 rad/s
    start(APP_CONTROL_PROFILE_VELOCITY);
    pass(0.3);
    const double bridge_s = first([](const Moment &m) { return m.bridge; });
    const double output_s = first([](const Moment &m) { return m.output; });
    const double open_s   = first([](const Moment &m) { return !m.closed; });
    const double moves_s  = first([](const Moment &m) { return m.speed_e_radps > 20.0; });
    EXPECT_GE(output_s, bridge_s + served.period_s()); // the law has run
    EXPECT_LE(output_s, bridge_s + 2 * late_s);
    EXPECT_NEAR(open_s, output_s + release_s, 2 * served.period_s());
    EXPECT_GE(moves_s, output_s + 1e-3 * release_ms);
    EXPECT_LE(moves_s, output_s + 1e-3 * release_ms + late_s + 0.01);
    EXPECT_NEAR(moments.back().speed_e_radps, 100.0, 5.0);
    EXPECT_EQ(input(APP_REGISTERS_DIGITAL_OUTPUTS), 0);

    // The load comes from the brake onto the motor.
    moments.erase(
        std::find_if(moments.begin(), moments.end(),
                     [&](const Moment &m) { return m.time_s >= output_s + 1e-3 * release_ms; }),
        moments.end());
    EXPECT_LT(way(), 1.0 * degree);
    EXPECT_GT(way(), 0.1 * degree); // it hung on the brake
}

TEST_F(BrakedShaft, EachStopHoldsTheLoadUntilTheBrakeHasClosed)
{
    align_and_load();
    struct Row {
        int word;
        int quick_option;
        int speed;
        int mode_of_operation;
    };
    for (const Row row : {Row{APP_CONTROL_SWITCHED_ON, 2, 0, APP_CONTROL_PROFILE_VELOCITY},
                          Row{APP_CONTROL_SHUT_DOWN, 2, 1000, APP_CONTROL_PROFILE_VELOCITY},
                          Row{APP_CONTROL_QUICK_STOP, 2, -1000, APP_CONTROL_PROFILE_VELOCITY},
                          Row{APP_CONTROL_QUICK_STOP, 0, 1000, APP_CONTROL_PROFILE_VELOCITY},
                          Row{APP_CONTROL_DISABLE_VOLTAGE, 2, 0, APP_CONTROL_PROFILE_VELOCITY},
                          Row{APP_CONTROL_DISABLE_VOLTAGE, 2, 1000, APP_CONTROL_PROFILE_VELOCITY},
                          Row{APP_CONTROL_SWITCHED_ON, 2, 0, APP_CONTROL_PROFILE_POSITION},
                          Row{APP_CONTROL_SWITCHED_ON, 2, 0, APP_CONTROL_CYCLIC_POSITION}}) {
        SCOPED_TRACE(fmt::format("word {} option {} speed {} mode {}", row.word, row.quick_option,
                                 row.speed, row.mode_of_operation));
        ASSERT_TRUE(write_one(APP_REGISTERS_QUICK_STOP_OPTION, row.quick_option));
        ASSERT_TRUE(write_two(APP_REGISTERS_SPEED, row.speed));
        start_and_release(row.mode_of_operation);
        const double asked_s = served.time_s();
        ASSERT_TRUE(control(row.word));
        ASSERT_TRUE(wait_for_mode(APP_MODE_READY));
        pass(0.1);
        const auto low = expect_closed_before_the_bridge_is_off(asked_s);
        EXPECT_LT(std::abs(low->speed_e_radps), 2.0);
        moments.erase(moments.begin(), low);
        EXPECT_LT(way(), 0.3 * degree);
        ASSERT_TRUE(control(APP_CONTROL_SHUT_DOWN));
    }
}

TEST_F(BrakedShaft, AFaultDropsTheLoadForTheTimeOfTheBrake)
{
    align_and_load();
    start_and_release(APP_CONTROL_PROFILE_VELOCITY);
    const double before_s = served.time_s();
    served.set_trip_input(true);
    pass(0.2);
    EXPECT_LE(first([](const Moment &m) { return !m.output; }), before_s + served.period_s());
    EXPECT_LE(first([](const Moment &m) { return !m.bridge; }), before_s + served.period_s());
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_FAULT);
    EXPECT_EQ(input(APP_REGISTERS_DIGITAL_OUTPUTS), 1);
    const double and_stops = brake_Nm / (brake_Nm - load_Nm); // the brake stops it
    EXPECT_NEAR(way(), fall_turns() * and_stops, 0.05 * fall_turns());
    EXPECT_NEAR(moments.back().speed_e_radps, 0.0, 1e-9);
    served.set_trip_input(false);
}

TEST_F(BrakedShaft, ClosesWithoutPowerAndWithoutAProgram)
{
    align_and_load();
    start_and_release(APP_CONTROL_PROFILE_VELOCITY);
    served.power_cycle();
    pass(0.3);
    EXPECT_FALSE(moments.back().output);
    EXPECT_TRUE(moments.back().closed);
    EXPECT_EQ(moments.back().speed_e_radps, 0.0);
    EXPECT_EQ(holding(APP_REGISTERS_BRAKE_USED), 0); // not stored

    served.dynamometer().drive(0.0);
    align_and_load();
    start_and_release(APP_CONTROL_PROFILE_VELOCITY);
    InjectedFault fault;
    fault.kind = FaultKind::tick_hung;
    served.break_part(fault);
    pass(0.3);
    EXPECT_EQ(served.resets(), 1);
    EXPECT_FALSE(moments.back().output);
    EXPECT_EQ(moments.back().speed_e_radps, 0.0);
}

TEST_F(BrakedShaft, ANewStartWhileItClosesReleasesItAgain)
{
    align_and_load();
    start_and_release(APP_CONTROL_PROFILE_VELOCITY);
    ASSERT_TRUE(control(APP_CONTROL_SWITCHED_ON));
    while (served.device().brake_is_released()) {
        pass(served.period_s());
    }
    ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION));
    pass(0.2);
    EXPECT_TRUE(std::isnan(first([](const Moment &m) { return !m.bridge; })));
    EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_RELEASED);
    EXPECT_LT(way(), 0.5 * degree);
}

TEST_F(BrakedShaft, PositionsAndHomingThatAreAskedForEarlyBeginLater)
{
    align_and_load();
    start(APP_CONTROL_PROFILE_POSITION);
    ASSERT_TRUE(wait_for_mode(APP_MODE_RUN));
    const int here = now();
    ASSERT_TRUE(write_two(APP_REGISTERS_TARGET_POSITION, here + counts_per_turn));
    ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT));
    EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_RELEASING);
    EXPECT_LT(way(), 0.5 * degree);
    pass(0.6);
    EXPECT_NEAR(now(), here + counts_per_turn, 6); // 0.2 degrees
    ASSERT_TRUE(control(APP_CONTROL_SWITCHED_ON));
    ASSERT_TRUE(wait_for_mode(APP_MODE_READY));

    ASSERT_TRUE(write_one(APP_REGISTERS_HOMING_METHOD, 37));
    start(APP_CONTROL_HOMING);
    ASSERT_TRUE(wait_for_mode(APP_MODE_RUN));
    ASSERT_TRUE(control(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT));
    EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_RELEASING);
    EXPECT_EQ(input(APP_REGISTERS_HOMED), 0);
    pass(0.2);
    EXPECT_EQ(input(APP_REGISTERS_HOMED), 1);
}

TEST_F(BrakedShaft, ATorqueRunBeginsWithTheTorqueThatHeldTheLoad)
{
    align_and_load();
    const double rated_Nm = input(APP_REGISTERS_RATED_TORQUE + 1) * 1e-3;
    ASSERT_TRUE(write_one(APP_REGISTERS_TORQUE,
                          static_cast<int>(std::lround(1000.0 * load_Nm / rated_Nm))));
    start(APP_CONTROL_PROFILE_TORQUE);
    pass(0.1);
    EXPECT_LT(way(), 3 * degree); // it still holds nearly as much as hangs on it
    ASSERT_TRUE(control(APP_CONTROL_SWITCHED_ON));
    ASSERT_TRUE(wait_for_mode(APP_MODE_READY));
    EXPECT_TRUE(served.brake_is_closed());
}

TEST_F(BrakedShaft, AlignmentTurnsTheShaftUnderALoad)
{
    served.set_holding_brake({brake_Nm, slow_s, close_s});
    use_brake(slow_ms);
    served.dynamometer().drive(0.1);
    start(APP_CONTROL_FIND_ANGLE);
    ASSERT_TRUE(wait_for(APP_REGISTERS_REACHED, align_s + slow_s));
    EXPECT_EQ(input(APP_REGISTERS_REFERENCE), APP_ANGLE_ALIGNED);
    EXPECT_LT(way(), 0.6); // the vector's turn, and no fall
    expect_closed_before_the_bridge_is_off(first([](const Moment &m) { return m.output; }));
    EXPECT_TRUE(served.brake_is_closed());
}

TEST_F(BrakedShaft, CommissioningReleasesItBeforeItHasCurrents)
{
    served.set_holding_brake({brake_Nm, slow_s, close_s});
    use_brake(slow_ms);
    ASSERT_TRUE(write_one(APP_REGISTERS_COMMISSION_CURRENT, 200)); // 2 A
    ASSERT_TRUE(write_one(APP_REGISTERS_COMMISSION_SPEED, 1000));
    start(APP_CONTROL_COMMISSIONING);
    talk(slow_s + 2.0);
    EXPECT_EQ(input(APP_REGISTERS_MODE), APP_MODE_COMMISSION);
    EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_RELEASED);
    const double output_s  = first([](const Moment &m) { return m.output; });
    const double current_s = first([](const Moment &m) { return m.current_A > 0.1; });
    EXPECT_GE(current_s, output_s + 1e-3 * slow_ms);
    ASSERT_TRUE(control(APP_CONTROL_DISABLE_VOLTAGE));
    pass(0.1);
    EXPECT_FALSE(served.device().brake_is_released());
    EXPECT_TRUE(served.brake_is_closed());
}

TEST_F(BrakedShaft, LimitsOfItsParameters)
{
    use_brake();
    EXPECT_FALSE(write_one(APP_REGISTERS_BRAKE_USED, 2));
    EXPECT_FALSE(write_one(APP_REGISTERS_BRAKE_RELEASE_TIME, 5001));
    EXPECT_FALSE(write_one(APP_REGISTERS_BRAKE_CLOSE_TIME, 5001));
    ASSERT_TRUE(write(APP_REGISTERS_BRAKE_USED, {1, 0, 0}));
    enable(APP_CONTROL_PROFILE_VELOCITY);
    pass(0.05);
    EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_RELEASED);
    EXPECT_FALSE(write_one(APP_REGISTERS_BRAKE_USED, 0)); // enabled
    ASSERT_TRUE(control(APP_CONTROL_SWITCHED_ON));
    ASSERT_TRUE(wait_for_mode(APP_MODE_READY));
    EXPECT_TRUE(write_one(APP_REGISTERS_BRAKE_USED, 0));
    EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_NONE);
    EXPECT_EQ(input(APP_REGISTERS_DIGITAL_OUTPUTS), 0);
}

TEST_F(BrakedShaft, WithoutTheParameterTheOutputStaysLow)
{
    served.set_holding_brake({});
    enable(APP_CONTROL_PROFILE_VELOCITY);
    pass(0.3);
    EXPECT_EQ(input(APP_REGISTERS_BRAKE_STATE), APP_BRAKE_NONE);
    EXPECT_TRUE(std::isnan(first([](const Moment &m) { return m.output; })));
}

namespace {

class BrakedNode : public CanClient {
protected:
    static constexpr unsigned used_object  = 0x2000 + APP_REGISTERS_BRAKE_USED;
    static constexpr unsigned state_object = 0x2800 + APP_REGISTERS_BRAKE_STATE;
    static constexpr unsigned outputs      = 0x60FE;
};

} // namespace

TEST_F(BrakedNode, ShowsTheBrakeAsADigitalOutput)
{
    served.set_holding_brake({brake_Nm, release_s, close_s});
    pass(0.4);
    EXPECT_EQ(get(outputs, 0), 1U);
    EXPECT_EQ(get(outputs, 1), 0U);
    ASSERT_EQ(put(used_object, 0, 1, 2), no_abort);
    EXPECT_EQ(get(outputs, 1), 1U);
    EXPECT_EQ(put(outputs, 1, 0, 4), 0x06010002U); // read only
    enable(APP_CONTROL_PROFILE_VELOCITY);
    pass(0.2);
    EXPECT_EQ(get(state_object), APP_BRAKE_RELEASED);
    EXPECT_EQ(get(outputs, 1), 0U);
    EXPECT_EQ(put(used_object, 0, 0, 2), 0x08000022U); // not in this state
    ASSERT_EQ(put(0x6040, 0, 0x07, 2), no_abort);
    pass(0.05);
    EXPECT_EQ(get(state_object), APP_BRAKE_CLOSING);
    EXPECT_EQ(get(outputs, 1), 1U);
    EXPECT_TRUE(served.bridge_on());
    pass(0.2);
    EXPECT_EQ(get(state_object), APP_BRAKE_CLOSED);
    EXPECT_FALSE(served.bridge_on());
    expect_no_findings();
}
