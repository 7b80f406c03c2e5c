// SPDX-License-Identifier: MIT
// The register model under a small firmware: what works, and that each classic mistake is noticed.
#include <string>

#include <gtest/gtest.h>

#include "plain_surroundings.hpp"
#include "sil/f28335/device.hpp"
#include "small_firmware.h"

namespace {

using namespace sdre::f28335;

// Boot of the small firmware: 4.4 ms for the PLL, 5 ms for the converter.
constexpr double booted_s = 15e-3;

class F28335Device : public ::testing::Test {
protected:
    F28335Device()
    {
        small_firmware_mistake = MISTAKE_NONE;
        small_firmware_compare = 3000;
        small_firmware_ticks   = 0;
    }

    PlainSurroundings around;
    DeviceOptions     options{{}, 3e-6};

    /// Runs a mistake and says whether the device has found it.
    bool finds(small_firmware_mistake_t mistake, Finding kind)
    {
        small_firmware_mistake = mistake;
        Device device(around, small_firmware_main, options);
        device.run_for(booted_s + 10e-3);
        return device.findings().has(kind);
    }
};

TEST_F(F28335Device, RightFirmwareRunsWithoutFinding)
{
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);
    const std::uint32_t before = small_firmware_ticks;
    device.run_for(20e-3);

    EXPECT_EQ(small_firmware_ticks - before, 100U); // 5 kHz
    for (const Findings::Entry &e : device.findings().all()) {
        ADD_FAILURE() << e.text;
    }
    EXPECT_FALSE(device.was_reset());
    EXPECT_EQ(around.legs, (std::array<bool, 3>{true, true, true}));
}

TEST_F(F28335Device, StartsAgainInTheSameProcess)
{
    for (int run = 0; run < 3; run++) {
        Device device(around, small_firmware_main, options);
        EXPECT_EQ(EPwm1Regs.TBPRD, 0U);
        device.run_for(booted_s);
        EXPECT_GT(small_firmware_ticks, 10U);
        EXPECT_LT(small_firmware_ticks, 75U);
    }
}

TEST_F(F28335Device, ResultsAppearInBothViewsInOrderABAB)
{
    around.input_V[0][0] = 0.3; // 4096 * 0.3 / 3 = 409.6
    around.input_V[1][0] = 1.5; // 2048
    around.input_V[0][1] = 2.9; // 3959.5
    around.input_V[1][1] = 3.2; // beyond the range
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);

    EXPECT_EQ(small_firmware_codes[0], 409);
    EXPECT_EQ(small_firmware_codes[1], 2048);
    EXPECT_EQ(small_firmware_codes[2], 3959);
    EXPECT_EQ(small_firmware_codes[3], 4095);
    EXPECT_EQ(AdcMirror.ADCRESULT2, AdcRegs.ADCRESULT2 >> 4);
}

// Device advisory.
TEST_F(F28335Device, FirstPairNeedsALongWindow)
{
    around.input_V[0][0]   = 0.3;
    around.input_V[0][1]   = 0.3;
    small_firmware_mistake = MISTAKE_SHORT_WINDOW;
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);

    EXPECT_EQ(small_firmware_codes[0], 4095);
    EXPECT_EQ(small_firmware_codes[1], 4095);
    EXPECT_EQ(small_firmware_codes[2], 409);
}

TEST_F(F28335Device, CompareActsFromTheNextTopOfTheCounterOn)
{
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);
    const int tops           = around.periods;
    EPwm1Regs.CMPA.half.CMPA = 1000; // as an ISR would, some time within the period

    while (around.periods == tops) {
        EXPECT_EQ(around.period.legs[0].a[1].time_cnt, 7500 - 3000);
        device.run_for(10e-6);
    }
    EXPECT_EQ(around.period.legs[0].a[1].time_cnt, 7500 - 1000);
    EXPECT_EQ(around.period.legs[1].a[1].time_cnt, 7500 - 3000);
}

TEST_F(F28335Device, EncoderCountsModuloTurnAndLatchesWithTheCurrents)
{
    around.counts_per_period = 70;
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);
    const std::uint16_t first = small_firmware_position;
    const int           tops  = around.periods;
    device.run_for(0.1);

    EXPECT_EQ((small_firmware_position + 10000 - first) % 10000,
              70 * (around.periods - tops) % 10000);
    // The counter started at 0 somewhere; the index sits where the shaft's count is a whole turn.
    const std::int64_t since_index = around.count % 10000;
    EXPECT_EQ((small_firmware_position + 10000 - small_firmware_index) % 10000, since_index);
}

TEST_F(F28335Device, TenThousandAsHighestPositionDriftsOnePerTurn)
{
    const auto index_drift = [this](small_firmware_mistake_t mistake) {
        small_firmware_mistake   = mistake;
        around.count             = 0;
        around.seen_count        = 0;
        around.counts_per_period = 200;
        Device device(around, small_firmware_main, options);
        device.run_for(0.1);
        const int first = small_firmware_index;
        device.run_for(0.03); // three turns
        return first - small_firmware_index;
    };
    EXPECT_EQ(index_drift(MISTAKE_NONE), 0);
    EXPECT_EQ(index_drift(MISTAKE_QPOSMAX), 3);
}

TEST_F(F28335Device, SerialLineCarriesOctetsAtItsSpeed)
{
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);
    device.serial().send(0x41);
    device.run_for(80e-6);
    EXPECT_EQ(device.serial().take(), -1);
    // 10 bits of 8 * 41 cycles of 37.5 MHz each way, and a pass of the loop.
    device.run_for(2 * 87.5e-6 + 50e-6);

    EXPECT_EQ(small_firmware_heard, 0x41);
    EXPECT_EQ(device.serial().take(), 0x42);
}

TEST_F(F28335Device, OctetTakesItsBits)
{
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);
    // 10 bits of 8 * (40 + 1) cycles of LSPCLK, which is a quarter of SYSCLKOUT.
    EXPECT_EQ(device.serial().octet_ticks(device.clock()), 10 * 8 * 41 * 4);
}

TEST_F(F28335Device, FlagThatStandsMakesNoFurtherInterrupt)
{
    small_firmware_mistake = MISTAKE_NO_INT_CLEAR;
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s + 10e-3);
    EXPECT_EQ(small_firmware_ticks, 1U);
}

TEST_F(F28335Device, InterruptDoesNotInheritEallow)
{
    EXPECT_TRUE(finds(MISTAKE_ISR_NO_EALLOW, Finding::eallow));
    EXPECT_EQ(GpioCtrlRegs.GPADIR.all, 0x7FU);
}

TEST_F(F28335Device, FaultPinOpensAllLegsAtOnceAndStaysUntilCleared)
{
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s);
    device.set_fault_pin(true);
    EXPECT_EQ(around.legs, (std::array<bool, 3>{false, false, false}));
    EXPECT_EQ(+EPwm2Regs.TZFLG.bit.OST, 1);
    EXPECT_FALSE(device.findings().has(Finding::trip));

    device.set_fault_pin(false);
    device.run_for(1e-3);
    EXPECT_EQ(around.legs, (std::array<bool, 3>{false, false, false}));
}

TEST_F(F28335Device, UnarmedTripIsFound)
{
    for (const small_firmware_mistake_t mistake :
         {MISTAKE_TRIP_UNARMED, MISTAKE_TRIP_PIN_UNMUXED, MISTAKE_TRIP_FLOATS}) {
        small_firmware_mistake = mistake;
        Device device(around, small_firmware_main, options);
        device.run_for(booted_s);
        EXPECT_FALSE(device.findings().has(Finding::trip));
        device.set_fault_pin(true);
        EXPECT_TRUE(device.findings().has(Finding::trip)) << mistake;
    }
}

TEST_F(F28335Device, MissingAcknowledgeStopsTheInterruptAndIsFound)
{
    small_firmware_mistake = MISTAKE_NO_PIEACK;
    Device device(around, small_firmware_main, options);
    device.run_for(booted_s + 10e-3);

    EXPECT_EQ(small_firmware_ticks, 1U);
    EXPECT_TRUE(device.findings().has(Finding::interrupt));
}

TEST_F(F28335Device, MissingRewindRotatesTheResults)
{
    around.input_V[0][0]   = 1.0;
    small_firmware_mistake = MISTAKE_NO_SEQ_RESET;
    Device device(around, small_firmware_main, options);
    // Pairs 0, 1 | 2, 3: the second run converts into the registers that nobody reads.
    device.run_until([] { return small_firmware_ticks == 1U; }, booted_s, 1e-6);
    EXPECT_EQ(small_firmware_codes[0], 1365);
    around.input_V[0][0] = 2.0;
    device.run_until([] { return small_firmware_ticks == 2U; }, 1e-3, 1e-6);
    EXPECT_EQ(small_firmware_codes[0], 1365);
    EXPECT_EQ(AdcMirror.ADCRESULT4, 2730);
}

TEST_F(F28335Device, WriteWithoutEallowIsFoundAndHasNoEffect)
{
    EXPECT_TRUE(finds(MISTAKE_NO_EALLOW, Finding::eallow));
    EXPECT_EQ(EPwm1Regs.TZSEL.all, 0U);
    EXPECT_TRUE(finds(MISTAKE_EDIS_FIRST, Finding::eallow));
}

TEST_F(F28335Device, WriteToAUnitWithoutClockIsFoundAndHasNoEffect)
{
    EXPECT_TRUE(finds(MISTAKE_NO_CLOCK, Finding::no_clock));
    EXPECT_EQ(EPwm2Regs.TBPRD, 0U);
    EXPECT_EQ(EPwm3Regs.TBPRD, 7500U);
}

TEST_F(F28335Device, WrongDeadBandIsFound)
{
    EXPECT_TRUE(finds(MISTAKE_DEAD_BAND_WIDE, Finding::dead_time));
    options.dead_time_s = 3.1e-6; // the bridge needs more than the firmware gives
    EXPECT_TRUE(finds(MISTAKE_NONE, Finding::dead_time));
}

TEST_F(F28335Device, SamePolarityOnBothGatesIsFound)
{
    EXPECT_TRUE(finds(MISTAKE_POLARITY, Finding::dead_time));
}

TEST_F(F28335Device, ConverterMisuseIsFound)
{
    EXPECT_TRUE(finds(MISTAKE_ADC_TOO_FAST, Finding::adc));
    EXPECT_TRUE(finds(MISTAKE_ADC_COLD, Finding::adc));
    EXPECT_TRUE(finds(MISTAKE_NO_ADC_CAL, Finding::adc));
    EXPECT_TRUE(finds(MISTAKE_ADC_CAL_LOCKED, Finding::eallow));
}

TEST_F(F28335Device, DividerBeforeTheLockIsFound)
{
    EXPECT_TRUE(finds(MISTAKE_DIVSEL_EARLY, Finding::clock));
}

TEST_F(F28335Device, PllThatNeverLocksKeepsTheFirmwareWaiting)
{
    options.clock.never_locks = true;
    Device device(around, small_firmware_main, options);
    device.run_for(0.1);
    EXPECT_EQ(+SysCtrlRegs.PLLSTS.bit.PLLLOCKS, 0);
    EXPECT_EQ(small_firmware_ticks, 0U);
}

TEST_F(F28335Device, PllLocksAfterItsTime)
{
    Device device(around, small_firmware_main, options);
    device.run_for(131072 / 30e6 - 50e-6);
    EXPECT_EQ(+SysCtrlRegs.PLLSTS.bit.PLLLOCKS, 0);
    device.run_for(100e-6);
    EXPECT_EQ(+SysCtrlRegs.PLLSTS.bit.PLLLOCKS, 1);
    EXPECT_DOUBLE_EQ(device.clock().sysclk_Hz(), 150e6);
    EXPECT_DOUBLE_EQ(device.clock().hspclk_Hz(), 25e6);
    EXPECT_DOUBLE_EQ(device.clock().lspclk_Hz(), 37.5e6);
}

TEST_F(F28335Device, WatchdogResetsWhenNotServedOrHalfServed)
{
    for (const small_firmware_mistake_t mistake : {MISTAKE_NO_WATCHDOG, MISTAKE_HALF_KEY}) {
        small_firmware_mistake = mistake;
        Device       device(around, small_firmware_main, options);
        const double longest_s = booted_s + 256 * 512 * 4 / 30e6;
        EXPECT_FALSE(device.run_until([] { return false; }, longest_s));
        EXPECT_TRUE(device.was_reset()) << mistake;
        EXPECT_TRUE(device.findings().has(Finding::watchdog_reset));
        EXPECT_EQ(around.legs, (std::array<bool, 3>{false, false, false}));
    }
}

} // namespace
