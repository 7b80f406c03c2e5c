// SPDX-License-Identifier: MIT
// The image for a debugger on the virtual device: steps of docs/bring-up.md that need no power. The test writes bench_wanted, as the
// debugger does there.
#include <array>
#include <memory>

#include <gtest/gtest.h>

#include "plain_surroundings.hpp"
#include "sil/f28335/device.hpp"

extern "C" {
#include "bench.h"
int bench_main(void);
}

namespace {

using namespace sdre::f28335;

constexpr double period_s = 200e-6;

class F28335Bench : public ::testing::Test {
protected:
    F28335Bench()
    {
        const_cast<bench_wanted_t &>(bench_wanted) = {0, 205, {0, 0, 0}};
        const_cast<bench_seen_t &>(bench_seen)     = {};
        current_V(1.5, 1.5);
        around.input_V[0][1] = 1.97; // 295 V
        around.input_V[1][1] = 2.46; // 25 degC
        device               = std::make_unique<Device>(around, bench_main, options);
        EXPECT_TRUE(device->run_until([] { return bench_seen.ticks >= 2U; }, 60e-3));
    }
    void current_V(double a, double b)
    {
        around.input_V[0][0] = a;
        around.input_V[1][0] = b;
    }
    void ask(std::uint16_t gates, const board_duty_t &duty)
    {
        const_cast<board_duty_t &>(bench_wanted.duty) = duty;
        bench_wanted.gates                            = gates;
        device->run_for(3 * period_s);
    }
    bool on() const
    {
        return bench_seen.on && around.legs == std::array<bool, 3>{true, true, true};
    }
    bool off() const
    {
        return !bench_seen.on && around.legs == std::array<bool, 3>{false, false, false};
    }

    PlainSurroundings       around;
    DeviceOptions           options{{}, 3e-6};
    std::unique_ptr<Device> device;
};

TEST_F(F28335Bench, Level1StartsWithTheBridgeOffAndReadsItsInputs)
{
    EXPECT_TRUE(off());
    EXPECT_EQ(bench_seen.faults, 0U);
    EXPECT_NEAR(bench_seen.sample.ia_cnt, 2048, 1); // 1.5 V of 3 V
    EXPECT_NEAR(bench_seen.sample.dc_link_cnt, 4096 * 1.97 / 3.0, 1);
    EXPECT_NEAR(bench_seen.sample.temperature_cnt, 4096 * 2.46 / 3.0, 1);
    device->run_for(0.1); // twenty watchdog periods
    EXPECT_TRUE(off());
    EXPECT_GT(bench_seen.ticks, 400U);
    EXPECT_EQ(SysCtrlRegs.WDCR & 0x40U, 0U); // it runs
}

TEST_F(F28335Bench, Level2GatesFollowTheDutyRatiosOnlyWhenAskedForByTheWholeWord)
{
    for (const unsigned stray : {1U, 0x6A7FU, 0xFFFFU}) {
        ask(static_cast<std::uint16_t>(stray), {3000, 3750, 4500});
        EXPECT_TRUE(off()) << stray;
    }
    ask(BENCH_GATES, {3000, 3750, 4500});
    ASSERT_TRUE(on());
    EXPECT_EQ(EPwm1Regs.CMPA.half.CMPA, 3000U);
    EXPECT_EQ(EPwm2Regs.CMPA.half.CMPA, 3750U);
    EXPECT_EQ(EPwm3Regs.CMPA.half.CMPA, 4500U);
    EXPECT_EQ(EPwm1Regs.DBRED, 225U); // 3 us
    ask(0, {3000, 3750, 4500});
    EXPECT_TRUE(off());
}

TEST_F(F28335Bench, Level2TripInputOpensTheBridgeAndItStaysSo)
{
    ask(BENCH_GATES, {3750, 3750, 3750});
    ASSERT_TRUE(on());
    device->set_fault_pin(true);
    device->run_for(3 * period_s);
    EXPECT_TRUE(off());
    device->set_fault_pin(false);
    device->run_for(10 * period_s);
    EXPECT_TRUE(off());
    EXPECT_EQ(bench_wanted.gates, 0U);
    ask(BENCH_GATES, {3750, 3750, 3750});
    EXPECT_TRUE(on());
}

TEST_F(F28335Bench, Level3ACurrentBeyondTheLimitOpensTheBridgeWithinTwoPeriods)
{
    for (const double volts : {1.5 - 210 * 3.0 / 4096, 1.5 + 210 * 3.0 / 4096}) {
        for (const bool phase_a : {true, false}) {
            const auto before = bench_seen.over_current;
            current_V(1.5, 1.5);
            ask(BENCH_GATES, {3750, 3750, 3750});
            ASSERT_TRUE(on());
            current_V(phase_a ? volts : 1.5, phase_a ? 1.5 : volts);
            device->run_for(2 * period_s);
            EXPECT_TRUE(off()) << volts << phase_a;
            EXPECT_EQ(bench_seen.over_current, before + 1);
            ask(BENCH_GATES, {3750, 3750, 3750});
            EXPECT_TRUE(off()); // refused while it is there
        }
    }
    current_V(1.5 - 200 * 3.0 / 4096, 1.5 + 200 * 3.0 / 4096);
    ask(BENCH_GATES, {3750, 3750, 3750});
    EXPECT_TRUE(on());
}

} // namespace
