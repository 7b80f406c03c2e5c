// SPDX-License-Identifier: MIT
// The drivers of firmware/board/f28335 on the virtual device: every register after the start, the timing of a period, and
// what they do when something breaks. Expected values are derived here, from the crystal up.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "board_firmware.h"
#include "plain_surroundings.hpp"
#include "sil/f28335/device.hpp"

extern "C" volatile std::uint32_t watchdog_after_reset[2];

namespace {

using namespace sdre::f28335;

constexpr double period_s = 200e-6;

class F28335Board : public ::testing::Test {
protected:
    F28335Board()
    {
        auto &b              = const_cast<board_firmware_t &>(board_firmware);
        b                    = board_firmware_t{};
        b.serve              = true;
        b.updates            = 1;
        b.setup              = {30000U, 7500U, 225U, 10000U, 2U, 0U}; // 5 kHz, 3 us, 2500 lines
        b.duty               = {3000, 3750, 7500};
        around.input_V[1][1] = 1.0;
    }

    Device &start()
    {
        device.reset(); // the registers exist once
        board_firmware.ticks = 0;
        device               = std::make_unique<Device>(around, board_firmware_main, options);
        EXPECT_TRUE(device->run_until([] { return board_firmware.ticks >= 1U; }, 50e-3));
        return *device;
    }
    void enable_gates()
    {
        board_firmware.enable = true;
        device->run_for(2 * period_s);
    }
    /// With the gates on, and the brake released.
    Device &start_released()
    {
        board_firmware.brake  = true;
        board_firmware.brakes = true;
        Device &d             = start();
        enable_gates();
        d.run_for(5 * period_s);
        return d;
    }
    bool all_legs(bool on) const
    {
        return around.legs == std::array<bool, 3>{on, on, on};
    }

    PlainSurroundings       around;
    DeviceOptions           options{{}, 3e-6};
    std::unique_ptr<Device> device;
};

TEST_F(F28335Board, ClockRegisters)
{
    start();
    // 30 MHz * 10 / 2 = 150 MHz: PLLCR 10, DIVSEL (8:7) 2, locked (0).
    EXPECT_EQ(SysCtrlRegs.PLLCR.all, 10U);
    EXPECT_EQ(SysCtrlRegs.PLLSTS.all, (2U << 7) | 1U);
    // ADC: 150 / (2 * 3) = 25 MHz. SCI: 150 / (2 * 2) = 37.5 MHz.
    EXPECT_EQ(SysCtrlRegs.HISPCP.all, 3U);
    EXPECT_EQ(SysCtrlRegs.LOSPCP.all, 2U);
    // TBCLKSYNC 2, ADC 3, SCI-A 10, eCAN-A 14; ePWM1..3 0..2, eQEP1 14; CPU timers 0, 1 8, 9; all the rest off.
    EXPECT_EQ(SysCtrlRegs.PCLKCR0.all, (1U << 2) | (1U << 3) | (1U << 10) | (1U << 14));
    EXPECT_EQ(SysCtrlRegs.PCLKCR1.all, 7U | (1U << 5) | (1U << 14));
    EXPECT_EQ(SysCtrlRegs.PCLKCR3.all, (1U << 8) | (1U << 9));
    EXPECT_EQ(SysCtrlRegs.MAPCNF.all, 0U);
}

TEST_F(F28335Board, FlashRegisters)
{
    start();
    // 150 MHz: 5 random and 5 paged waits, 8 for the OTP, pipeline on, longest wake-up times.
    EXPECT_EQ(FlashRegs.FOPT.all, 1U);
    EXPECT_EQ(FlashRegs.FBANKWAIT.all, (5U << 8) | 5U);
    EXPECT_EQ(FlashRegs.FOTPWAIT.all, 8U);
    EXPECT_EQ(FlashRegs.FSTDBYWAIT.all, 0x1FFU);
    EXPECT_EQ(FlashRegs.FACTIVEWAIT.all, 0x1FFU);
}

TEST_F(F28335Board, PwmRegisters)
{
    start();
    const volatile EPWM_REGS *legs[] = {&EPwm1Regs, &EPwm2Regs, &EPwm3Regs};
    for (const volatile EPWM_REGS *leg : legs) {
        // Up-down 2, shadow of the period off (3), no sync out 3 (5:4), SYSCLK / 2 (9:7 = 1), halt at end of cycle (15:14 = 1).
        EXPECT_EQ(leg->TBCTL.all, 2U | (1U << 3) | (3U << 4) | (1U << 7) | (1U << 14));
        // 75 MHz / (2 * 5 kHz)
        EXPECT_EQ(leg->TBPRD, 7500U);
        EXPECT_EQ(leg->TBPHS.all, 0U);
        // Shadows, loaded at PRD.
        EXPECT_EQ(leg->CMPCTL.all, 1U | (1U << 2));
        // PRD (3:2) clear 1, at full duty set 2; CAD (7:6) set 2, CBU (9:8) clear 1.
        EXPECT_EQ(leg->AQCTLA.all, ((leg == &EPwm3Regs ? 2U : 1U) << 2) | (2U << 6) | (1U << 8));
        EXPECT_EQ(leg->AQCTLB.all, 0U);
        EXPECT_EQ(leg->AQSFRC.all, 0U);
        EXPECT_EQ(leg->AQCSFRC.all, 0U);
        // Both outputs delayed 3, B inverted 2 (3:2), both from A 0 (5:4). 3 us * 75 MHz = 225.
        EXPECT_EQ(leg->DBCTL.all, 3U | (2U << 2));
        EXPECT_EQ(leg->DBRED, 225U);
        EXPECT_EQ(leg->DBFED, 225U);
        // One-shot by TZ1 (8), both outputs low (2 and 2 << 2), no interrupt; tripped until enabled.
        EXPECT_EQ(leg->TZSEL.all, 1U << 8);
        EXPECT_EQ(leg->TZCTL.all, 2U | (2U << 2));
        EXPECT_EQ(leg->TZEINT.all, 0U);
        EXPECT_EQ(leg->TZFLG.all, 1U << 2);
        EXPECT_EQ(leg->PCCTL.all, 0U);
        EXPECT_EQ(leg->HRCNFG.all, 0U);
    }
    // SOCA on (11) at PRD (10:8 = 2), every time (9:8 = 1); the other legs trigger nothing.
    EXPECT_EQ(EPwm1Regs.ETSEL.all, (2U << 8) | (1U << 11));
    EXPECT_EQ(EPwm1Regs.ETPS.all & 0x0303U, 1U << 8);
    EXPECT_EQ(EPwm2Regs.ETSEL.all, 0U);
    EXPECT_EQ(EPwm3Regs.ETSEL.all, 0U);
}

// A 20 kHz drive with 0.5 us and 1024 lines.
TEST_F(F28335Board, RegistersFollowTheSetup)
{
    auto &b = const_cast<board_firmware_t &>(board_firmware);
    b.setup = {7500U, 1875U, 38U, 4096U, 2U, 0U};
    start();
    EXPECT_EQ(EPwm3Regs.TBPRD, 1875U);
    EXPECT_EQ(EPwm3Regs.DBRED, 38U);
    EXPECT_EQ(EPwm3Regs.DBFED, 38U);
    EXPECT_EQ(EQep1Regs.QPOSMAX, 4095U);
    EXPECT_EQ(EQep1Regs.QUPRD, 7500U);
    EXPECT_EQ(CpuTimer1Regs.PRD.all, 7500U / 4U * 7U);
    const std::uint32_t before = board_firmware.ticks;
    device->run_for(10e-3);
    EXPECT_NEAR(board_firmware.ticks - before, 200.0, 1.0);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
}

// Zero, a period that the processor does not have, one that the capture timer does not reach, dead times that eat it.
TEST_F(F28335Board, SetupsThatNoRegisterHoldsAreRefused)
{
    auto &b = const_cast<board_firmware_t &>(board_firmware);
    for (const board_setup_t &setup : {board_setup_t{0U, 0U, 225U, 10000U, 2U, 0U},
                                       board_setup_t{30004U, 7500U, 225U, 10000U, 2U, 0U},
                                       board_setup_t{65536U, 16384U, 225U, 10000U, 2U, 0U},
                                       board_setup_t{30000U, 7500U, 0U, 10000U, 2U, 0U},
                                       board_setup_t{30000U, 7500U, 1024U, 10000U, 2U, 0U},
                                       board_setup_t{1000U, 250U, 125U, 10000U, 2U, 0U},
                                       board_setup_t{30000U, 7500U, 225U, 0U, 2U, 0U},
                                       board_setup_t{30000U, 7500U, 225U, 10000U, 1U, 0U},
                                       board_setup_t{30000U, 7500U, 225U, 10000U, 4U, 0U},
                                       board_setup_t{30000U, 7500U, 225U, 10000U, 2U, 2U}}) {
        b.setup       = setup;
        b.init_result = true;
        device.reset();
        device = std::make_unique<Device>(around, board_firmware_main, options);
        device->run_until([] { return !board_firmware.init_result; }, 50e-3);
        device->run_for(100e-6);
        EXPECT_FALSE(board_firmware.init_result) << setup.pwm_cycles << ' ' << setup.dead_time_cnt;
        EXPECT_FALSE(board_firmware.started);
        EXPECT_TRUE(all_legs(false));
    }
}

TEST_F(F28335Board, ConverterRegisters)
{
    start();
    // Window of 6 clocks (11:8 = 5), no prescaler, two sequencers.
    EXPECT_EQ(AdcRegs.ADCTRL1.all, 5U << 8);
    // SOCA starts sequencer 1 (8), interrupt at its end (11).
    EXPECT_EQ(AdcRegs.ADCTRL2.all, (1U << 8) | (1U << 11));
    // Powered (7:5), undivided (4:1), simultaneous (0).
    EXPECT_EQ(AdcRegs.ADCTRL3.all, 0xE0U | 1U);
    // Three pairs: 0, 0 again, then 1.
    EXPECT_EQ(AdcRegs.ADCMAXCONV.all, 2U);
    EXPECT_EQ(AdcRegs.ADCCHSELSEQ1.all, 1U << 8);
}

TEST_F(F28335Board, ThirdCurrentSensorIsReadWhenThereIsOne)
{
    auto &b                  = const_cast<board_firmware_t &>(board_firmware);
    b.setup                  = board_setup_t{30000U, 7500U, 225U, 10000U, 3U, 0U};
    around.input_V[0][0]     = 1.0; // 1365.3
    around.input_V[1][1]     = 1.5;
    around.input_V[1][2]     = 2.0; // 2730.7
    Device             &d    = start();
    const std::uint32_t tick = board_firmware.ticks;
    d.run_for(50 * period_s);
    // Four pairs: the last is A2 and B2.
    EXPECT_EQ(AdcRegs.ADCMAXCONV.all, 3U);
    EXPECT_EQ(AdcRegs.ADCCHSELSEQ1.all, (1U << 8) | (2U << 12));
    EXPECT_EQ(board_firmware.sample.ia_cnt, 1365);
    EXPECT_EQ(board_firmware.sample.temperature_cnt, 2048);
    EXPECT_EQ(board_firmware.sample.ic_cnt, 2730);
    EXPECT_EQ(board_firmware.ticks - tick, 50U);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
}

TEST_F(F28335Board, ChopperRegisters)
{
    auto &b = const_cast<board_firmware_t &>(board_firmware);
    b.setup = board_setup_t{30000U, 7500U, 225U, 10000U, 2U, 1U};
    start();
    // Counts up 0, period without shadow (3), no sync out 3 (5:4), SYSCLK / 2 (9:7 = 1), runs in a halt (15:14 = 2).
    EXPECT_EQ(EPwm5Regs.TBCTL.all, (1U << 3) | (3U << 4) | (1U << 7) | (2U << 14));
    EXPECT_EQ(EPwm5Regs.TBPRD, 65535U);
    // 1.5 periods of 15000 counts, without a shadow (4); there A is cleared (5:4 = 1), nothing sets it.
    EXPECT_EQ(EPwm5Regs.CMPA.half.CMPA, 22500U);
    EXPECT_EQ(EPwm5Regs.CMPCTL.all, 1U << 4);
    EXPECT_EQ(EPwm5Regs.AQCTLA.all, 1U << 4);
    EXPECT_EQ(EPwm5Regs.AQCTLB.all, 0U);
    EXPECT_EQ(EPwm5Regs.DBCTL.all, 0U);
    // No trip: a fast motor charges the link through an open bridge.
    EXPECT_EQ(EPwm5Regs.TZSEL.all, 0U);
    EXPECT_EQ(SysCtrlRegs.PCLKCR1.all, 7U | (3U << 4) | (1U << 14));
    EXPECT_EQ(GpioCtrlRegs.GPAMUX1.all, 0x555U | (1UL << 16) | (1UL << 20) | (1UL << 24));
    EXPECT_EQ(GpioCtrlRegs.GPAPUD.all, 0xFFFUL | (1UL << 12) | (1UL << 27));
    EXPECT_FALSE(device->chopper_is_on());
}

TEST_F(F28335Board, ChopperEndsWithItsCommandsAndNotWithTheBridge)
{
    auto &b   = const_cast<board_firmware_t &>(board_firmware);
    b.setup   = board_setup_t{30000U, 7500U, 225U, 10000U, 2U, 1U};
    Device &d = start();
    b.chopper = true;
    b.chops   = true;
    enable_gates();
    EXPECT_TRUE(d.chopper_is_on());
    d.set_fault_pin(true); // TZ1
    board_firmware.trip = true;
    for (int n = 0; n < 100;
         n++) { // a bridge that trips does not end it, and no gap comes between two commands
        d.run_for(0.1 * period_s);
        EXPECT_TRUE(d.chopper_is_on());
    }
    EXPECT_TRUE(all_legs(false));
    b.chopper = false;
    d.run_for(period_s);
    EXPECT_FALSE(d.chopper_is_on());
    b.chopper = true;
    d.run_for(period_s);
    EXPECT_TRUE(d.chopper_is_on());

    const std::uint32_t tick = board_firmware.ticks;
    d.run_until([&] { return board_firmware.ticks > tick; }, 2 * period_s, 1e-6);
    b.chops             = false; // no commands
    const double last_s = d.time_s();
    d.run_until([&] { return !d.chopper_is_on(); }, 4 * period_s, 1e-6);
    EXPECT_NEAR(d.time_s() - last_s, 1.5 * period_s, 3e-6);
    d.run_for(10 * period_s); // the counter comes around
    EXPECT_FALSE(d.chopper_is_on());
    for (const Findings::Entry &e : d.findings().all()) {
        ADD_FAILURE() << e.text;
    }
}

TEST_F(F28335Board, ChopperEndsWhenTicksHang)
{
    auto &b   = const_cast<board_firmware_t &>(board_firmware);
    b.setup   = board_setup_t{30000U, 7500U, 225U, 10000U, 2U, 1U};
    Device &d = start();
    b.chopper = true;
    b.chops   = true;
    d.run_for(5 * period_s);
    EXPECT_TRUE(d.chopper_is_on());
    d.mask_interrupts();
    d.run_for(2.6 * period_s);
    EXPECT_FALSE(d.chopper_is_on());

    Device &again = start();
    again.run_for(5 * period_s);
    EXPECT_TRUE(again.chopper_is_on());
    board_firmware.serve = false; // the watchdog resets
    EXPECT_TRUE(again.run_until([&] { return again.was_reset(); }, 10e-3));
    EXPECT_FALSE(again.chopper_is_on());
}

TEST_F(F28335Board, BrakeRegisters)
{
    start();
    // Counts up 0, period without shadow (3), no sync out 3 (5:4), SYSCLK / 2 (9:7 = 1) / 32 (12:10 = 5), runs in a halt (15:14 = 2).
    EXPECT_EQ(EPwm6Regs.TBCTL.all, (1U << 3) | (3U << 4) | (1U << 7) | (5U << 10) | (2U << 14));
    EXPECT_EQ(EPwm6Regs.TBPRD, 65535U);
    EXPECT_EQ(EPwm6Regs.CMPA.half.CMPA, 23438U); // 10 ms of 64 cycles each
    EXPECT_EQ(EPwm6Regs.CMPCTL.all, 1U << 4);
    EXPECT_EQ(EPwm6Regs.AQCTLA.all, 1U << 4);
    EXPECT_EQ(EPwm6Regs.AQCTLB.all, 0U);
    EXPECT_EQ(EPwm6Regs.DBCTL.all, 0U);
    EXPECT_EQ(EPwm6Regs.TZSEL.all, 1U << 8); // OSHT1, as the legs
    EXPECT_EQ(EPwm6Regs.TZCTL.all & 3U, 2U); // A low
    EXPECT_FALSE(device->brake_is_released());
}

TEST_F(F28335Board, BrakeIsReleasedOnlyWhileTheGatesAreOn)
{
    auto &b   = const_cast<board_firmware_t &>(board_firmware);
    b.brake   = true;
    b.brakes  = true;
    Device &d = start();
    d.run_for(20 * period_s);
    EXPECT_FALSE(d.brake_is_released()); // commanded, but the gates are off
    enable_gates();
    d.run_for(period_s);
    EXPECT_TRUE(d.brake_is_released());
    b.brake = false;
    d.run_for(period_s);
    EXPECT_FALSE(d.brake_is_released());
    b.brake = true;
    d.run_for(period_s);
    EXPECT_TRUE(d.brake_is_released());
    board_firmware.trip = true; // board_gate_trip()
    d.run_for(period_s);
    EXPECT_TRUE(all_legs(false));
    EXPECT_FALSE(d.brake_is_released());
    enable_gates();
    d.run_for(period_s);
    EXPECT_TRUE(d.brake_is_released());
    d.set_fault_pin(true); // TZ1: no program is needed
    EXPECT_FALSE(d.brake_is_released());
    d.run_for(20 * period_s);
    EXPECT_FALSE(d.brake_is_released());
    for (const Findings::Entry &e : d.findings().all()) {
        ADD_FAILURE() << e.text;
    }
}

TEST_F(F28335Board, BrakeEndsWithItsCommands)
{
    Device &d = start_released();
    ASSERT_TRUE(d.brake_is_released());
    const std::uint32_t tick = board_firmware.ticks;
    d.run_until([&] { return board_firmware.ticks > tick; }, 2 * period_s, 1e-6);
    board_firmware.brakes = false; // no commands, and the legs run on: as in a halt, but for those
    const double last_s   = d.time_s();
    d.run_until([&] { return !d.brake_is_released(); }, 20e-3, 1e-6);
    EXPECT_NEAR(d.time_s() - last_s, 10e-3, 5e-6);
    EXPECT_TRUE(all_legs(true));
    d.run_for(40e-3); // the counter comes around
    EXPECT_FALSE(d.brake_is_released());
}

TEST_F(F28335Board, BrakeEndsWithTheProgram)
{
    Device &d = start_released();
    ASSERT_TRUE(d.brake_is_released());
    board_firmware.tick_lasts_us = 1000.0; // a tick that hangs: CPU timer 1 trips
    d.run_for(3 * period_s);
    EXPECT_FALSE(d.brake_is_released());

    Device &again = start_released();
    ASSERT_TRUE(again.brake_is_released());
    board_firmware.serve = false; // the watchdog resets
    EXPECT_TRUE(again.run_until([&] { return again.was_reset(); }, 10e-3));
    EXPECT_FALSE(again.brake_is_released());
}

TEST_F(F28335Board, EncoderRegisters)
{
    start();
    EXPECT_EQ(EQep1Regs.QPOSMAX, 9999U); // 4 * 2500 - 1
    EXPECT_EQ(EQep1Regs.QUPRD, 30000U);  // 150 MHz / 5 kHz
    EXPECT_EQ(EQep1Regs.QDECCTL.all, 0U);
    // Unit timer 1, latch at time-out 2, counter on 3, index rising (5:4 = 1), reset at maximum (13:12 = 1), free run (15:14 = 2).
    EXPECT_EQ(EQep1Regs.QEPCTL.all,
              (1U << 1) | (1U << 2) | (1U << 3) | (1U << 4) | (1U << 12) | (2U << 14));
    EXPECT_EQ(EQep1Regs.QEINT.all, 0U);
    // Capture on (15), SYSCLK / 2 (6:4 = 1), every edge (3:0).
    EXPECT_EQ(EQep1Regs.QCAPCTL.all, (1U << 15) | (1U << 4));
    EXPECT_EQ(EQep1Regs.QPOSCTL.all, 0U);
}

TEST_F(F28335Board, PinRegisters)
{
    start();
    // Two bits a pin. First register: ePWM1A..3B on 0..5, TZ1 on 12. Second register, from pin 16:
    // eQEP1A, B, I on 20, 21, 23, SCI-A on 28, 29 and eCAN-A on 30, 31.
    EXPECT_EQ(GpioCtrlRegs.GPAMUX1.all, 0x555U | (1UL << 20) | (1UL << 24));
    EXPECT_EQ(GpioCtrlRegs.GPAMUX2.all, (1UL << 8) | (1UL << 10) | (1UL << 14) | (1UL << 24) |
                                            (1UL << 26) | (1UL << 28) | (1UL << 30));
    // Outputs: the six gates and the driver's enable on 6.
    EXPECT_EQ(GpioCtrlRegs.GPADIR.all, 0x47FU);
    // Pull-ups off: reset value 0xFFF, and pin 12, which the board pulls down.
    EXPECT_EQ(GpioCtrlRegs.GPAPUD.all, 0xFFFUL | (1UL << 12) | (1UL << 27));
    // TZ1 asynchronous 3; encoder and home switch on 26 six samples 2; both receivers asynchronous 3.
    EXPECT_EQ(GpioCtrlRegs.GPAQSEL1.all, 3UL << 24);
    EXPECT_EQ(GpioCtrlRegs.GPAQSEL2.all,
              (2UL << 8) | (2UL << 10) | (2UL << 14) | (2UL << 20) | (3UL << 24) | (3UL << 28));
    // Encoder every 4 cycles; switches every 510.
    EXPECT_EQ(GpioCtrlRegs.GPACTRL.all, (2UL << 16) | (0xFFUL << 24));
    // Limit switches on 32 and 33, with their pull-ups.
    EXPECT_EQ(GpioCtrlRegs.GPBQSEL1.all, (2UL << 0) | (2UL << 2));
    EXPECT_EQ(GpioCtrlRegs.GPBCTRL.all, 0xFFUL);
    EXPECT_EQ(GpioCtrlRegs.GPBPUD.all, 0U);
    EXPECT_EQ(GpioCtrlRegs.GPBMUX1.all | GpioCtrlRegs.GPBMUX2.all | GpioCtrlRegs.GPBDIR.all, 0U);
}

TEST_F(F28335Board, InputsAreTheLevelsOfTheSwitches)
{
    Device &d = start();
    for (unsigned n = 0; n < 8; n++) {
        d.set_input(32, (n & BOARD_INPUT_NEGATIVE) != 0);
        d.set_input(33, (n & BOARD_INPUT_POSITIVE) != 0);
        d.set_input(26, (n & BOARD_INPUT_HOME) != 0);
        EXPECT_EQ(board_inputs(), n);
    }
}

TEST_F(F28335Board, SerialRegisters)
{
    start();
    // 8 bits (2:0 = 7), parity on (5) and even (6), one stop bit.
    EXPECT_EQ(SciaRegs.SCICCR.all, 7U | (1U << 5) | (1U << 6));
    EXPECT_EQ(SciaRegs.SCICTL1.all, 3U | (1U << 5));
    // 37.5 MHz / (8 * 115200) - 1 = 39.7, so 40: 114329 baud.
    EXPECT_EQ(SciaRegs.SCIHBAUD, 0U);
    EXPECT_EQ(SciaRegs.SCILBAUD, 40U);
    EXPECT_EQ(SciaRegs.SCIFFTX.all, 0xE000U);
    EXPECT_EQ(SciaRegs.SCIFFRX.all, 0x2000U);
    EXPECT_EQ(SciaRegs.SCICTL2.all & 3U, 0U);
}

TEST_F(F28335Board, InterruptWatchdogAndTimerRegisters)
{
    start();
    EXPECT_EQ(+PieCtrlRegs.PIECTRL.bit.ENPIE, 1);
    EXPECT_EQ(PieCtrlRegs.PIEIER1.all, 1U); // ADC sequencer 1
    EXPECT_EQ(PieCtrlRegs.PIEIER2.all | PieCtrlRegs.PIEIER3.all | PieCtrlRegs.PIEIER5.all |
                  PieCtrlRegs.PIEIER9.all | PieCtrlRegs.PIEIER12.all,
              0U);
    EXPECT_EQ(IER, 1U | 0x1000U); // INT13: CPU timer 1
    const PINT *vectors = reinterpret_cast<const PINT *>(&PieVectTable);
    for (int n = 0; n < 128; n++) {
        EXPECT_NE(vectors[n], nullptr) << n;
    }
    EXPECT_NE(PieVectTable.SEQ1INT, PieVectTable.ADCINT);
    // On, crystal / 512: 256 * 512 / 30 MHz = 4.37 ms.
    EXPECT_EQ(SysCtrlRegs.WDCR & 0x47U, 1U);
    // One and three quarters of a period, asking for its interrupt (14), running (4).
    EXPECT_EQ(CpuTimer1Regs.PRD.all, 52500U);
    EXPECT_EQ(CpuTimer1Regs.TCR.all & 0x4010U, 0x4000U);
    EXPECT_EQ(CpuTimer0Regs.PRD.all, 0xFFFFFFFFU);
    EXPECT_EQ(+CpuTimer0Regs.TCR.bit.TSS, 0);
    EXPECT_EQ(CpuTimer0Regs.TPR.all, 0U);
    EXPECT_EQ(CpuTimer0Regs.TPRH.all, 0U);
}

TEST_F(F28335Board, StartsWithoutFindingAndWithTheBridgeOff)
{
    Device &d = start();
    EXPECT_TRUE(board_firmware.init_result);
    EXPECT_TRUE(all_legs(false));
    for (const Findings::Entry &e : d.findings().all()) {
        ADD_FAILURE() << e.text;
    }
}

TEST_F(F28335Board, OneTickPerPeriodWithItsSample)
{
    around.input_V[0][0]     = 1.0; // 1365.3
    around.input_V[1][0]     = 2.0; // 2730.7
    around.counts_per_period = 50;
    Device             &d    = start();
    const std::uint32_t tick = board_firmware.ticks;
    const int           from = board_firmware.sample.position_cnt;
    d.run_for(50 * period_s);

    EXPECT_EQ(board_firmware.ticks - tick, 50U);
    EXPECT_EQ((board_firmware.sample.position_cnt + 10000 - from) % 10000, 2500);
    EXPECT_EQ(board_firmware.sample.ia_cnt, 1365);
    EXPECT_EQ(board_firmware.sample.ib_cnt, 2730);
    EXPECT_TRUE(board_firmware.sample.valid);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
}

TEST_F(F28335Board, EverySampleIsNew)
{
    Device &d = start();
    for (int n = 1; n <= 8; n++) { // once around the sequencer and more
        around.input_V[0][0] = 0.1 * n;
        around.input_V[0][1] = 0.2 * n;
        d.run_for(period_s);
        EXPECT_EQ(board_firmware.sample.ia_cnt, static_cast<int>(4096 * 0.1 * n / 3.0)) << n;
        EXPECT_EQ(board_firmware.sample.dc_link_cnt, static_cast<int>(4096 * 0.2 * n / 3.0)) << n;
    }
}

TEST_F(F28335Board, DutyReachesTheGatesWithThreeMicrosecondsOfDeadTime)
{
    start();
    enable_gates();
    EXPECT_TRUE(all_legs(true));
    device->run_for(2 * period_s);

    const ControlPeriod &p = around.period;
    ASSERT_EQ(p.legs[0].gates.size(), 5U);
    EXPECT_NEAR(p.seconds(p.legs[0].gates[1].time_cnt), 100e-6 * (1.0 - 0.4), 1e-12);
    EXPECT_NEAR(p.seconds(*shortest_gap_cnt(p.legs[0].gates)), 3e-6, 1e-12);
    EXPECT_NEAR(p.seconds(*shortest_gap_cnt(p.legs[1].gates)), 3e-6, 1e-12);
    EXPECT_EQ(p.legs[2].gates.size(), 1U); // always on
    EXPECT_TRUE(p.legs[2].gates[0].upper);
}

// And with the duty ratios of the tick that enabled them.
TEST_F(F28335Board, GatesComeOnAtTheStartOfThePeriodAfterTheTick)
{
    Device             &d    = start();
    const std::uint32_t tick = board_firmware.ticks;
    board_firmware.enable    = true;
    d.run_until([&] { return board_firmware.ticks > tick; }, 2 * period_s, 1e-6);
    EXPECT_TRUE(all_legs(false));
    d.run_for(period_s);
    EXPECT_TRUE(all_legs(true));
    // 2.5 + 6 + 5 + 2 * 8 clocks of 40 ns.
    EXPECT_NEAR(around.legs_changed_s, 1.18e-6, 1e-12);
}

TEST_F(F28335Board, FaultPinTripsAndIsReported)
{
    Device &d = start();
    enable_gates();
    d.set_fault_pin(true);
    EXPECT_TRUE(all_legs(false));
    d.run_for(2 * period_s);
    EXPECT_EQ(board_firmware.faults & BOARD_FAULT_TRIP, BOARD_FAULT_TRIP);

    // Enabling is refused as long as the pin is low, and works after.
    enable_gates();
    EXPECT_TRUE(all_legs(false));
    d.set_fault_pin(false);
    enable_gates();
    EXPECT_TRUE(all_legs(true));
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
    EXPECT_FALSE(d.findings().has(Finding::trip));
}

TEST_F(F28335Board, SoftwareTripOpensEveryLegAndTheDriver)
{
    start();
    enable_gates();
    board_firmware.trip = true;
    // Look at the instant, before the next tick repeats the trip.
    device->run_until([&] { return all_legs(false); }, 2 * period_s, 5e-6);
    EXPECT_TRUE(all_legs(false));
    EXPECT_EQ(+EPwm1Regs.TZFLG.bit.OST, 1);
    EXPECT_EQ(+EPwm2Regs.TZFLG.bit.OST, 1);
    EXPECT_EQ(+EPwm3Regs.TZFLG.bit.OST, 1);
    EXPECT_EQ(+GpioDataRegs.GPADAT.bit.GPIO6, 0);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
}

TEST_F(F28335Board, FirstSampleIsValidAndOneWithoutLatchIsNot)
{
    Device &d = start();
    EXPECT_TRUE(board_firmware.first_sample.valid);
    EQep1Regs.QEPCTL.bit.UTE = 0; // the unit timer stops
    d.run_for(3 * period_s);
    EXPECT_FALSE(board_firmware.sample.valid);
}

TEST_F(F28335Board, ReceiverOverflowsAfterSixteenOctets)
{
    Device &d = start();
    for (int n = 0; n < 17; n++) {
        d.serial().send(0x55);
    }
    // 11 bits with parity, 8 * 41 cycles of a quarter of the clock each.
    const double octet_s = 11 * 8 * 41 * 4 / 150e6;
    d.run_for(16.5 * octet_s);
    EXPECT_EQ(+SciaRegs.SCIFFRX.bit.RXFFST, 16);
    EXPECT_EQ(+SciaRegs.SCIFFRX.bit.RXFFOVF, 0);
    d.run_for(octet_s);
    EXPECT_EQ(+SciaRegs.SCIFFRX.bit.RXFFST, 16);
    EXPECT_EQ(+SciaRegs.SCIFFRX.bit.RXFFOVF, 1);
}

// A master may send again after 1.75 ms. A pass of the background lasts up to 1 ms.
TEST_F(F28335Board, LineIsReleasedBeforeAMasterMaySend)
{
    for (const unsigned baud_Bd : {9600U, 115200U}) {
        for (const double pass_us : {0.0, 1000.0}) {
            const_cast<board_line_t &>(board_firmware.line) = {baud_Bd, BOARD_LINE_EVEN, 1};
            board_firmware.pass_lasts_us                    = pass_us;
            board_firmware.hear                             = true;
            Device &d                                       = start();
            board_firmware.says                             = 5;
            d.run_for(10e-3 + 5 * 11.0 / baud_Bd);
            const Direction &seen   = d.serial().direction();
            const double     tail_s = static_cast<double>(seen.tail_ticks) / tick_Hz;
            EXPECT_EQ(seen.rises, 1) << baud_Bd;
            EXPECT_EQ(seen.cut_octets, 0) << baud_Bd;
            EXPECT_GE(tail_s, 1.0 / baud_Bd - 1e-6) << baud_Bd;
            EXPECT_LE(tail_s, 2 * period_s + 1.1 / baud_Bd) << baud_Bd << ", " << pass_us;
            for (const Findings::Entry &e : d.findings().all()) {
                ADD_FAILURE() << e.text;
            }
        }
    }
}

// 16 octets of 11 bits at 37.5 MHz / 8 / divider; a pass of the background lasts 1 ms at most.
TEST_F(F28335Board, FifoOutlastsAPassAtEveryRateThatFits)
{
    start();
    int fitting = 0;
    for (const unsigned baud_Bd : {9600U, 19200U, 38400U, 57600U, 115200U, 230400U, 460800U}) {
        const board_line_t line{baud_Bd, BOARD_LINE_EVEN, 0};
        const double       lasts_s = 16 * 11 * 8 * std::round(37.5e6 / 8 / baud_Bd) / 37.5e6;
        EXPECT_EQ(board_line_fits(&line), lasts_s > 1e-3) << baud_Bd;
        fitting += board_line_fits(&line) ? 1 : 0;
    }
    EXPECT_EQ(fitting, 5);
}

TEST_F(F28335Board, WatchdogServedDoesNotReset)
{
    Device &d = start();
    d.run_for(60e-3);
    EXPECT_FALSE(d.was_reset());
}

TEST_F(F28335Board, TickThatOutlastsItsPeriodIsAnOverrun)
{
    Device &d = start();
    enable_gates();
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
    board_firmware.tick_lasts_us = 201.0;
    d.run_for(3 * period_s);
    EXPECT_EQ(board_firmware.faults & BOARD_FAULT_OVERRUN, BOARD_FAULT_OVERRUN);
    EXPECT_TRUE(all_legs(false));
}

TEST_F(F28335Board, LongTickWithinItsPeriodIsNone)
{
    Device &d = start();
    enable_gates();
    board_firmware.tick_lasts_us = 190.0;
    d.run_for(3 * period_s);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
    EXPECT_TRUE(all_legs(true));
}

TEST_F(F28335Board, LateInterruptIsAnOverrun)
{
    Device &d = start();
    enable_gates();
    d.delay_next_interrupt(30000); // a whole period
    d.run_for(4 * period_s);
    EXPECT_EQ(board_firmware.faults & BOARD_FAULT_OVERRUN, BOARD_FAULT_OVERRUN);
    EXPECT_TRUE(all_legs(false));
}

TEST_F(F28335Board, TickThatDoesNotEndOpensTheBridge)
{
    Device &d = start();
    enable_gates();
    board_firmware.tick_lasts_us = 1e5;
    d.run_for(period_s + 345e-6); // the next tick begins within a period
    EXPECT_TRUE(all_legs(true));
    d.run_for(30e-6);
    EXPECT_TRUE(all_legs(false));
    d.run_for(5e-3); // nobody serves the watchdog
    EXPECT_TRUE(d.was_reset());
}

TEST_F(F28335Board, LostTriggerOpensTheBridge)
{
    Device &d = start();
    enable_gates();
    d.lose_trigger();
    d.run_for(150e-6);
    EXPECT_TRUE(all_legs(true));
    d.run_for(250e-6);
    EXPECT_TRUE(all_legs(false));
    EXPECT_FALSE(d.was_reset());
}

/// The processor has taken its bit out of IER, and the group waits for PIEACK.
TEST_F(F28335Board, TickIsNotInterruptedByTheNextOne)
{
    Device             &d        = start();
    const std::uint32_t tick     = board_firmware.ticks;
    board_firmware.tick_lasts_us = 250.0;
    d.run_for(2 * period_s);
    EXPECT_EQ(board_firmware.ticks - tick, 1U);
}

TEST_F(F28335Board, OnePhaseErrorIsCountedAndTripsNothing)
{
    Device &d = start();
    enable_gates();
    const int before   = board_firmware.sample.phase_errors;
    around.phase_error = true;
    d.run_for(2 * period_s);
    EXPECT_EQ(board_firmware.sample.phase_errors, before + 1);
    EXPECT_TRUE(board_firmware.sample.valid);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
    EXPECT_TRUE(all_legs(true));
}

TEST_F(F28335Board, ThreePhaseErrorsWithinTenMillisecondsTrip)
{
    for (const int apart : {1, 10, 25}) { // periods: three in up to 10 ms
        Device &d = start();
        enable_gates();
        for (int n = 0; n < 2; n++) {
            around.phase_error = true;
            d.run_for(apart * period_s);
        }
        EXPECT_TRUE(all_legs(true)) << apart;
        around.phase_error = true;
        d.run_for(2 * period_s);
        EXPECT_EQ(board_firmware.faults & BOARD_FAULT_ENCODER, BOARD_FAULT_ENCODER) << apart;
        EXPECT_TRUE(all_legs(false)) << apart;
    }
}

TEST_F(F28335Board, RarePhaseErrorsNeverTrip)
{
    Device &d = start();
    enable_gates();
    for (int n = 0; n < 20; n++) {
        around.phase_error = true;
        d.run_for(10.2e-3);
    }
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
    EXPECT_TRUE(all_legs(true));
}

TEST_F(F28335Board, EdgeTimesComeWithThePosition)
{
    Device &d                = start();
    around.counts_per_period = 7;
    for (const double age_s : {13.3e-9, 1e-6, 199e-6}) {
        around.edge_age_s = age_s;
        d.run_for(3 * period_s);
        EXPECT_TRUE(board_firmware.sample.edge_seen);
        EXPECT_NEAR(board_firmware.sample.edge_age_cnt, age_s * 75e6, 1.0) << age_s;
    }
    around.counts_per_period = 0; // no edge: the age says nothing
    d.run_for(3 * period_s);
    EXPECT_FALSE(board_firmware.sample.edge_seen);
    around.counts_per_period = -7;
    d.run_for(3 * period_s);
    EXPECT_TRUE(board_firmware.sample.edge_seen);
    around.turns_back = true; // which of the edges was the last cannot be told
    d.run_for(period_s);
    EXPECT_FALSE(board_firmware.sample.edge_seen);
    d.run_for(3 * period_s);
    EXPECT_TRUE(board_firmware.sample.edge_seen);
}

TEST_F(F28335Board, FirstPairOfASequenceIsNotUsed)
{
    around.input_V[0][0]       = 1.0;
    around.input_V[1][0]       = 2.0;
    Device &d                  = start();
    AdcRegs.ADCTRL1.bit.ACQ_PS = 3; // 160 ns: the first pair reads full scale now
    d.run_for(3 * period_s);
    EXPECT_EQ(AdcMirror.ADCRESULT0, 4095);
    EXPECT_EQ(board_firmware.sample.ia_cnt, 1365);
    EXPECT_EQ(board_firmware.sample.ib_cnt, 2730);
}

TEST_F(F28335Board, WindowIsLongEnoughForTheFirstPairToo)
{
    around.input_V[0][0] = 1.0;
    Device &d            = start();
    d.run_for(3 * period_s);
    EXPECT_EQ(AdcMirror.ADCRESULT0, 1365);
}

TEST_F(F28335Board, TwoUpdatesSampleAndLoadAtBothEndsOfTheCounter)
{
    board_firmware.updates = 2;
    Device &d              = start();
    // Loaded at ZERO and PRD; unit 1 triggers at PRD (2), unit 2 at ZERO (1).
    EXPECT_EQ(EPwm3Regs.CMPCTL.all, 2U | (2U << 2));
    EXPECT_EQ(EPwm1Regs.ETSEL.all, (2U << 8) | (1U << 11));
    EXPECT_EQ(EPwm2Regs.ETSEL.all, (1U << 8) | (1U << 11));
    EXPECT_EQ(EQep1Regs.QUPRD, 15000U);
    const std::uint32_t tick = board_firmware.ticks;
    d.run_for(20 * period_s);
    EXPECT_EQ(board_firmware.ticks - tick, 40U);
    EXPECT_TRUE(board_firmware.sample.valid);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
    for (const Findings::Entry &e : d.findings().all()) {
        ADD_FAILURE() << e.text;
    }
}

TEST_F(F28335Board, TwoUpdatesGiveEachHalfItsOwnDuty)
{
    board_firmware.updates = 2;
    Device &d              = start();
    enable_gates();
    for (const int duty : {0, 1500, 7500}) {
        board_firmware.duty.a_cnt = static_cast<std::uint16_t>(duty);
        for (int half = 0; half < 4; half++) {
            d.run_for(0.5 * period_s);
            if (half < 2) {
                continue; // the duty before
            }
            const ControlPeriod &p    = around.period;
            double               high = 0.0;
            for (std::size_t n = 0; n < p.legs[0].a.size(); n++) {
                const int until =
                    n + 1 < p.legs[0].a.size() ? p.legs[0].a[n + 1].time_cnt : p.counts;
                high += p.legs[0].a[n].level ? until - p.legs[0].a[n].time_cnt : 0;
            }
            EXPECT_EQ(p.counts, 7500);
            EXPECT_EQ(high, duty);
        }
    }
    EXPECT_FALSE(d.findings().has(Finding::dead_time));
}

// A half that begins at ZERO after one without a pulse: the pulse starts there, after the dead time.
TEST_F(F28335Board, TwoUpdatesAfterAnEmptyHalf)
{
    board_firmware.updates = 2;
    Device &d              = start();
    enable_gates();
    int pulses = 0;
    for (int half = 0; half < 12; half++) {
        board_firmware.duty.a_cnt = static_cast<std::uint16_t>(half % 3 == 0 ? 3000 : 0);
        d.run_for(0.5 * period_s);
        int high = 0;
        for (std::size_t n = 0; n < around.period.legs[0].a.size(); n++) {
            const auto &a     = around.period.legs[0].a;
            const int   until = n + 1 < a.size() ? a[n + 1].time_cnt : around.period.counts;
            high += a[n].level ? until - a[n].time_cnt : 0;
        }
        EXPECT_TRUE(high == 0 || high == 3000) << high;
        pulses += high == 3000 ? 1 : 0;
    }
    EXPECT_GE(pulses, 3);
    EXPECT_FALSE(d.findings().has(Finding::dead_time));
}

/// Counts of the control period in which the input of the first leg's dead band is high.
int high_counts(const ControlPeriod &p)
{
    const auto &a    = p.legs[0].a;
    int         high = 0;
    for (std::size_t n = 0; n < a.size(); n++) {
        const int until = n + 1 < a.size() ? a[n + 1].time_cnt : p.counts;
        high += a[n].level ? until - a[n].time_cnt : 0;
    }
    return high;
}

// Each duty after each other one, whichever compare value counts at the instant of a load.
TEST_F(F28335Board, EveryStepOfTheDutyIsExact)
{
    const std::vector<int> duties{0, 1, 2, 113, 3000, 7387, 7498, 7499, 7500, 65535};
    for (const AtLoad at_load : {AtLoad::old_values, AtLoad::new_values}) {
        for (const int updates : {1, 2}) {
            options.at_load        = at_load;
            board_firmware.updates = static_cast<std::uint16_t>(updates);
            Device &d              = start();
            enable_gates();
            int before = -1;
            for (const int first : duties) {
                for (const int second : duties) {
                    for (const int duty : {first, second}) {
                        board_firmware.duty.a_cnt = static_cast<std::uint16_t>(duty);
                        d.run_for(period_s / updates);
                        ASSERT_EQ(around.period.counts, 15000 / updates);
                        if (before >= 0) {
                            EXPECT_EQ(high_counts(around.period),
                                      2 * std::min(before, 7500) / updates)
                                << "duty " << before << ", " << updates << " updates";
                        }
                        before = duty;
                    }
                }
            }
            for (const Findings::Entry &e : d.findings().all()) {
                ADD_FAILURE() << e.text;
            }
        }
    }
}

TEST_F(F28335Board, TwoUpdatesTimeTheEdgesOfEachHalf)
{
    board_firmware.updates   = 2;
    Device &d                = start();
    around.counts_per_period = 3;
    around.edge_age_s        = 50e-6;
    d.run_for(5 * period_s);
    EXPECT_TRUE(board_firmware.sample.edge_seen);
    EXPECT_NEAR(board_firmware.sample.edge_age_cnt, 50e-6 * 75e6, 1.0);
    const int from = board_firmware.sample.position_cnt;
    d.run_for(5 * period_s);
    EXPECT_EQ(board_firmware.sample.position_cnt - from, 30);
}

// 8192 cycles at a quarter of 30 MHz and 512: 1.1093 ms after the beginning of a reset the pin is looked at.
TEST_F(F28335Board, ResetCauseIsWhatTheFlagSays)
{
    for (const double low_s : {512 / 30e6, 1.1e-3, 1.12e-3, 0.2}) {
        options.xrs_low_s = low_s;
        start();
        EXPECT_EQ(board_firmware.reset_cause,
                  low_s < 1.109e-3 ? BOARD_RESET_WATCHDOG : BOARD_RESET_PIN)
            << low_s;
        EXPECT_EQ(SysCtrlRegs.WDCR & 0x80U, 0U); // cleared, for the next one
    }
}

TEST_F(F28335Board, LoaderIsWantedByAWordAndItsComplementAndOnce)
{
    constexpr std::uint32_t asked = 0x10ADE401;
    for (const double low_s : {512 / 30e6, 0.2}) { // the flag of the watchdog: set, clear
        options.xrs_low_s = low_s;
        start();
        watchdog_after_reset[0] = asked;
        watchdog_after_reset[1] = ~asked;
        EXPECT_TRUE(board_loader_is_wanted());
        EXPECT_FALSE(board_loader_is_wanted());
        for (int bit = 0; bit < 64; bit++) {
            watchdog_after_reset[0] = asked;
            watchdog_after_reset[1] = ~asked;
            watchdog_after_reset[bit / 32] ^= 1U << (bit % 32);
            EXPECT_FALSE(board_loader_is_wanted()) << bit;
        }
    }
}

TEST_F(F28335Board, TripInputShowsWhileTheGatesAreOff)
{
    Device &d = start();
    d.set_fault_pin(true);
    d.run_for(2 * period_s);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_INPUT);
    d.set_fault_pin(false);
    d.run_for(2 * period_s);
    EXPECT_EQ(board_firmware.faults, BOARD_FAULT_NONE);
}

TEST_F(F28335Board, ReceiveErrorCutsNoAnswer)
{
    Device &d = start();
    for (int n = 0; n < 10; n++) {
        board_firmware.say[n] = static_cast<std::uint16_t>('a' + n);
    }
    board_firmware.says = 10;
    board_firmware.hear = true;
    d.run_for(0.2e-3); // two octets
    d.serial().fail_receiver();
    d.run_for(2e-3);
    for (int n = 0; n < 10; n++) {
        EXPECT_EQ(d.serial().take(), 'a' + n);
    }
    d.serial().send('z'); // and the receiver works again
    d.run_for(0.3e-3);
    EXPECT_EQ(board_firmware.heard, 'z');
}

TEST_F(F28335Board, FailedLockIsReportedAndNothingStarts)
{
    options.clock.never_locks = true;
    device                    = std::make_unique<Device>(around, board_firmware_main, options);
    device->run_for(0.5);

    EXPECT_FALSE(board_firmware.init_result);
    EXPECT_FALSE(board_firmware.started);
    EXPECT_EQ(board_firmware.faults & BOARD_FAULT_CLOCK, BOARD_FAULT_CLOCK);
    EXPECT_EQ(board_firmware.ticks, 0U);
    EXPECT_TRUE(all_legs(false));
    EXPECT_FALSE(device->findings().has(Finding::clock));
}

TEST_F(F28335Board, MissingCrystalIsReportedAndNothingStarts)
{
    options.clock.limp_mode = true;
    device                  = std::make_unique<Device>(around, board_firmware_main, options);
    device->run_for(0.2);

    EXPECT_FALSE(board_firmware.init_result);
    EXPECT_EQ(board_firmware.faults & BOARD_FAULT_CLOCK, BOARD_FAULT_CLOCK);
    EXPECT_EQ(SysCtrlRegs.PLLCR.all, 0U); // never touched in limp mode
    EXPECT_TRUE(all_legs(false));
}

TEST_F(F28335Board, CrystalThatDiesOpensTheBridge)
{
    Device &d = start();
    enable_gates();
    d.lose_crystal();
    // Everything is 75 times slower now.
    d.run_until([&] { return all_legs(false); }, 75 * 2 * period_s);
    EXPECT_TRUE(all_legs(false));
}

TEST_F(F28335Board, WatchdogNotServedResetsTheDevice)
{
    Device &d = start();
    enable_gates();
    board_firmware.serve = false;
    d.run_for(4.1e-3);
    EXPECT_FALSE(d.was_reset());
    d.run_for(0.4e-3);
    EXPECT_TRUE(d.was_reset());
    EXPECT_TRUE(all_legs(false));
}

} // namespace
