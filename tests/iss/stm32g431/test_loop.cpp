// SPDX-License-Identifier: MIT
// The image in closed loop opens the bridge when something breaks, and tells why.
#include <gtest/gtest.h>

#include "stm32g431/image_bench.hpp"

extern "C" {
#include "app_control.h"
#include "app_registers.h"
}

using namespace iss;
using namespace iss::stm32g431;

namespace {

constexpr double freed_s = 0.31; // boot 50 ms, offsets of the sensors 256 ms
constexpr double soon_s  = 0.1;

const Program &program()
{
    static const Program p{read_elf(ISS_IMAGE), read_elf(ISS_LAYOUT)};
    return p;
}

const sdre::Drive &drive()
{
    static const sdre::Drive d = sdre::read_drive_file(ISS_DRIVE);
    return d;
}

class IssLoop : public ::testing::Test {
protected:
    /// Ready, and after that in a run at this share of the rated speed.
    void bring_to_run(double share)
    {
        speed = share * drive().motor.rated_speed_e_radps;
        b.pass(freed_s + 0.005);
        ASSERT_EQ(b.mode(), APP_MODE_READY);
        ASSERT_TRUE(b.enable(speed, soon_s)) << "mode " << b.mode() << ", fault " << b.fault();
        b.run(0.15);
        ASSERT_EQ(b.mode(), APP_MODE_RUN) << "fault " << b.fault() << ' ' << b.drive_fault();
        ASSERT_NEAR(b.speed_e_radps(), speed, 0.02 * std::abs(speed));
    }
    void expect_no_findings()
    {
        for (const std::string &line : b.chip.core().findings()) {
            ADD_FAILURE() << line;
        }
    }
    double period_s() const
    {
        return b.bench.period_s();
    }

    double     speed = 0.0;
    ImageBench b{at_rest(drive()), freed_s, program()};
};

} // namespace

TEST_F(IssLoop, TheBreakInputOpensTheBridgeAndAResetStartsAgain)
{
    bring_to_run(0.3);
    b.chip.set_over_current(true);
    EXPECT_FALSE(b.chip.gates_enabled());
    EXPECT_FALSE(b.bench.bridge_on());
    b.pass(2.0 * period_s());
    EXPECT_EQ(b.fault(), APP_FAULT_BOARD);
    b.chip.set_over_current(false);
    b.pass(0.01);
    EXPECT_FALSE(b.chip.gates_enabled()) << "nobody has asked for a new start";
    ASSERT_TRUE(b.command(APP_CONTROL_SHUT_DOWN | APP_CONTROL_FAULT_RESET, 0.0));
    b.pass(0.01);
    EXPECT_TRUE(b.enable(speed, soon_s)) << "mode " << b.mode() << ", fault " << b.fault();
    expect_no_findings();
}

TEST_F(IssLoop, TheButtonOpensTheBridgeWithinAPeriod)
{
    bring_to_run(0.3);
    b.chip.press_button(true);
    const double open_s = b.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 1.1 * period_s());
    b.pass(2.0 * period_s());
    EXPECT_EQ(b.fault(), APP_FAULT_BOARD);
    expect_no_findings();
}

TEST_F(IssLoop, ALostEncoderIsNoticedAndTheMotorStops)
{
    bring_to_run(0.3);
    b.bench.stick_encoder();
    b.run(0.5);
    EXPECT_FALSE(b.chip.gates_enabled());
    EXPECT_EQ(b.mode(), APP_MODE_FAULT);
    EXPECT_EQ(b.fault(), APP_FAULT_DRIVE);
    EXPECT_EQ(b.drive_fault(), DRIVE_FAULT_ENCODER);
    expect_no_findings();
}

TEST_F(IssLoop, ADcLinkThatFallsAwayOpensTheBridge)
{
    bring_to_run(0.3);
    b.bench.board()->set_source_V(0.3 * drive().inverter.dc_link_V);
    const double open_s = b.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_EQ(b.drive_fault(), DRIVE_FAULT_DC_LINK);
    expect_no_findings();
}

TEST_F(IssLoop, AHotSinkStopsTheDrive)
{
    bring_to_run(0.3);
    b.circuit.set_temperature_degC(drive().board.temperature_trip_degC + 3.0);
    b.run(0.3);
    EXPECT_EQ(b.mode(), APP_MODE_FAULT);
    EXPECT_EQ(b.fault(), APP_FAULT_TEMPERATURE);
    expect_no_findings();
}

TEST_F(IssLoop, WithoutConversionsTheBridgeOpensWithinTwoPeriods)
{
    bring_to_run(0.3);
    b.chip.lose_trigger();
    const double open_s = b.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 3.0 * period_s());
    expect_no_findings();
}

TEST_F(IssLoop, ATickThatHangsDoesNotKeepTheBridgeClosed)
{
    bring_to_run(0.3);
    b.chip.core().hang_at(program().image.symbols.at("app_tick"));
    const double open_s = b.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 3.0 * period_s());
    b.pass(0.01);
    EXPECT_GE(b.chip.resets(), 1) << "by the watchdog";
}

TEST_F(IssLoop, MaskedInterruptsDoNotKeepTheBridgeClosed)
{
    bring_to_run(0.3);
    b.chip.core().mask_interrupts();
    const double open_s = b.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 5e-3) << "the watchdog's longest time";
}

TEST_F(IssLoop, ACrystalThatStopsOpensTheBridge)
{
    bring_to_run(0.3);
    b.chip.stop_crystal();
    EXPECT_FALSE(b.chip.gates_enabled());
    b.pass(2.0 * period_s());
    EXPECT_EQ(b.fault(), APP_FAULT_BOARD);
    expect_no_findings();
}

TEST_F(IssLoop, AZeroWithinItsBandIsCalibratedAndOneBeyondIsAFault)
{
    for (const int zero : {90, -90, 700}) {
        ImageBench other(at_rest(drive()), freed_s, program());
        other.circuit.set_zero_cnt(zero);
        other.pass(freed_s + 0.005);
        EXPECT_EQ(other.fault(), zero < 600 ? APP_FAULT_NONE : APP_FAULT_OFFSET) << zero;
        if (zero < 600) { // the firmware turns the codes round
            EXPECT_NEAR(other.memory.get<float>("tick_side", "zero_a_cnt"), 2048 - zero, 1.0);
            EXPECT_NEAR(other.memory.get<float>("tick_side", "zero_b_cnt"), 2048 - zero, 1.0);
        }
    }
}
