// SPDX-License-Identifier: MIT
// The image in closed loop opens the bridge when something breaks, and tells why.
#include <gtest/gtest.h>

#include "running_client.hpp"

using namespace sdre;

namespace {

constexpr double soon_s = 0.1;

class IssLoop : public RunningClient {
protected:
    /// From power-up to a run at this share of the rated speed.
    void bring_to_run(double share)
    {
        speed = share * served.drive().motor.rated_speed_e_radps;
        ASSERT_TRUE(set_speed(speed));
        ASSERT_NO_FATAL_FAILURE(enable(APP_CONTROL_PROFILE_VELOCITY)) << "fault " << status().fault;
        talk(0.15);
        ASSERT_EQ(status().mode, APP_MODE_RUN) << status().fault << ' ' << status().drive_fault;
        ASSERT_NEAR(served.plant_state().omega_e_radps, speed, 0.02 * std::abs(speed));
    }
    bool set_speed(double e_radps)
    {
        return write_two(APP_REGISTERS_SPEED, static_cast<int>(std::lround(10.0 * e_radps)));
    }
    app_status_t status()
    {
        return served.image().status();
    }
    void expect_no_findings()
    {
        for (const std::string &line : served.findings()) {
            ADD_FAILURE() << line;
        }
    }
    double period_s() const
    {
        return served.period_s();
    }

    double                      speed = 0.0;
    iss::stm32g431::ImageBoard &image = served.image();
    iss::stm32g431::Chip       &chip  = image.chip;
};

} // namespace

TEST_F(IssLoop, TheBreakInputOpensTheBridgeAndAResetStartsAgain)
{
    bring_to_run(0.3);
    chip.set_over_current(true);
    EXPECT_FALSE(chip.gates_enabled());
    EXPECT_FALSE(served.bridge_on());
    pass(2.0 * period_s());
    EXPECT_EQ(status().fault, APP_FAULT_BOARD);
    chip.set_over_current(false);
    pass(0.01);
    EXPECT_FALSE(chip.gates_enabled()) << "nobody has asked for a new start";
    ASSERT_TRUE(
        write_one(APP_REGISTERS_CONTROLWORD, APP_CONTROL_SHUT_DOWN | APP_CONTROL_FAULT_RESET));
    pass(0.01);
    enable(APP_CONTROL_PROFILE_VELOCITY);
    expect_no_findings();
}

// Windings that are shorted to a fiftieth of their inductance and resistance: the current rises by 6 A in a microsecond. At
// this speed the motor has voltage for longer than it needs to reach the threshold.
TEST_F(IssLoop, AComparatorOpensTheBridgeBeforeTheProgramKnows)
{
    bring_to_run(0.8);
    chip.look_each(0.5e-6);
    PlantChange shorted;
    shorted.plant_scale = {{"stator_resistance_Ohm", 0.02},
                           {"d_axis_inductance_H", 0.02},
                           {"q_axis_inductance_H", 0.02}};
    served.bench().board()->apply(shorted);
    ASSERT_GE(image.opens_s(soon_s), 0.0);
    EXPECT_FALSE(served.bridge_on());
    EXPECT_EQ(status().mode, APP_MODE_RUN) << "no tick knows of it";
    EXPECT_EQ(status().fault, APP_FAULT_NONE);
    const double peak_A = served.bench().board()->peak_current_A();
    EXPECT_GT(peak_A, 44.8) << "by the network and 0.205 V";
    EXPECT_LT(peak_A, 44.8 * 2.0 / std::sqrt(3.0) + 6.0)
        << "a vector between two phases, and a look later";
    pass(2.0 * period_s());
    EXPECT_EQ(status().mode, APP_MODE_FAULT);
    EXPECT_EQ(status().fault, APP_FAULT_BOARD);
    expect_no_findings();
}

TEST_F(IssLoop, TheButtonOpensTheBridgeWithinAPeriod)
{
    bring_to_run(0.3);
    chip.press_button(true);
    const double open_s = image.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 1.1 * period_s());
    pass(2.0 * period_s());
    EXPECT_EQ(status().fault, APP_FAULT_BOARD);
    expect_no_findings();
}

TEST_F(IssLoop, ALostEncoderIsNoticedAndTheMotorStops)
{
    bring_to_run(0.3);
    served.bench().stick_encoder();
    talk(0.5);
    EXPECT_FALSE(chip.gates_enabled());
    EXPECT_EQ(status().mode, APP_MODE_FAULT);
    EXPECT_EQ(status().fault, APP_FAULT_DRIVE);
    EXPECT_EQ(status().drive_fault, DRIVE_FAULT_ENCODER);
    expect_no_findings();
}

TEST_F(IssLoop, ADcLinkThatFallsAwayOpensTheBridge)
{
    bring_to_run(0.3);
    served.set_dc_link_V(0.3 * served.drive().inverter.dc_link_V);
    const double open_s = image.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_EQ(status().drive_fault, DRIVE_FAULT_DC_LINK);
    expect_no_findings();
}

TEST_F(IssLoop, AHotSinkStopsTheDrive)
{
    bring_to_run(0.3);
    image.circuit.set_temperature_degC(served.drive().board.temperature_trip_degC + 3.0);
    talk(0.3);
    EXPECT_EQ(status().mode, APP_MODE_FAULT);
    EXPECT_EQ(status().fault, APP_FAULT_TEMPERATURE);
    expect_no_findings();
}

TEST_F(IssLoop, WithoutConversionsTheBridgeOpensWithinTwoPeriods)
{
    bring_to_run(0.3);
    image.inject(FaultKind::trigger_lost);
    const double open_s = image.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 3.0 * period_s());
    expect_no_findings();
}

TEST_F(IssLoop, ATickThatHangsDoesNotKeepTheBridgeClosed)
{
    bring_to_run(0.3);
    image.inject(FaultKind::tick_hung);
    const double open_s = image.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 3.0 * period_s());
    pass(0.01);
    EXPECT_GE(served.resets(), 1) << "by the watchdog";
}

TEST_F(IssLoop, MaskedInterruptsDoNotKeepTheBridgeClosed)
{
    bring_to_run(0.3);
    image.inject(FaultKind::interrupt_masked);
    const double open_s = image.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, 5e-3) << "the watchdog's longest time";
}

TEST_F(IssLoop, ACrystalThatStopsOpensTheBridge)
{
    bring_to_run(0.3);
    chip.stop_crystal();
    EXPECT_FALSE(chip.gates_enabled());
    pass(2.0 * period_s());
    EXPECT_EQ(status().fault, APP_FAULT_BOARD);
    expect_no_findings();
}

TEST_F(IssLoop, AZeroWithinItsBandIsCalibratedAndOneBeyondIsAFault)
{
    for (const int zero : {90, -90, 700}) {
        ServedBoard other(shipped_drive(), 1);
        other.image().circuit.set_zero_cnt(zero);
        while (other.time_s() < 0.32) { // boot 50 ms, offsets of the sensors 256 ms
            other.period();
        }
        const app_status_t seen = other.image().status();
        EXPECT_EQ(seen.fault, zero < 600 ? APP_FAULT_NONE : APP_FAULT_OFFSET) << zero;
        if (zero < 600) { // the firmware turns the codes round
            EXPECT_NEAR(seen.zero_a_cnt, 2048 - zero, 1.0);
            EXPECT_NEAR(seen.zero_b_cnt, 2048 - zero, 1.0);
        }
    }
}

TEST_F(IssLoop, AStackThatOverflowsOpensTheBridgeAtOnce)
{
    bring_to_run(0.3);
    const auto         &symbols = ServedBoard::program().image.symbols;
    const std::uint32_t tick    = symbols.at("app_tick") & ~1U; // its first instruction pushes
    for (const double end_s = chip.time_s() + 2.0 * period_s();
         chip.core().program_counter() != tick && chip.time_s() < end_s;) {
        chip.run_to(chip.core().cycles() + 1U);
    }
    ASSERT_EQ(chip.core().program_counter(), tick);
    chip.core().fill_stack_to(symbols.at("image_stack") + 8U);
    const double open_s = image.opens_s(soon_s);
    EXPECT_GE(open_s, 0.0);
    EXPECT_LE(open_s, period_s());
    ASSERT_FALSE(served.findings().empty());
    EXPECT_NE(served.findings().front().find("which the MPU guards"), std::string::npos)
        << served.findings().front();
    pass(0.01);
    EXPECT_GE(served.resets(), 1) << "by the watchdog";
}
