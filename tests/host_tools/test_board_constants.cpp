// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "common/errors.hpp"
#include "design/board/align_design.hpp"
#include "design/board/board_constants.hpp"
#include "design/board/identity.hpp"
#include "design/design.hpp"
#include "design/trip_levels.hpp"
#include "drive/pwm_frequency.hpp"
#include "temp_dir.hpp"

extern "C" {
#include "app_board_check.h"
}

using namespace sdre;

namespace {

Drive shipped()
{
    return read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
}

std::string refusal(const Drive &d)
{
    try {
        board_constants(d);
    } catch (const InputError &e) {
        return e.what();
    }
    return "";
}

} // namespace

// EQ-BOARD-1: 75 MHz / (2 * 5 kHz), 150 MHz / 5 kHz, 3 us, 2500 lines.
TEST(BoardConstants, RegistersOfTheShippedDrive)
{
    const board_setup_t s = board_constants(shipped()).config.board;
    EXPECT_EQ(s.duty_full_cnt, 7500);
    EXPECT_EQ(s.pwm_cycles, 30000U);
    EXPECT_EQ(s.dead_time_cnt, 225);
    EXPECT_EQ(s.positions, 10000);
}

TEST(BoardConstants, RegistersFollowTheFile)
{
    Drive d = shipped();
    d.board.file.reset(); // its gates need more dead time
    d.inverter.pwm_frequency_Hz = 20e3;
    d.inverter.dead_time_s      = 0.5e-6; // 37.5 counts: no less
    d.encoder.lines             = 1024;
    const app_config_t c        = board_constants(d).config;
    EXPECT_EQ(c.board.duty_full_cnt, 1875);
    EXPECT_EQ(c.board.pwm_cycles, 7500U);
    EXPECT_EQ(c.board.dead_time_cnt, 38);
    EXPECT_EQ(c.board.positions, 4096);
    EXPECT_FLOAT_EQ(c.pwm_period_s, 50e-6F);
    EXPECT_EQ(c.boot_ticks, 1000);         // 50 ms
    EXPECT_EQ(c.align.watch_ticks, 2000U); // 100 ms
    EXPECT_EQ(c.modbus_gap_ticks, 36);     // 1.75 ms, and one
}

// EQ-BOARD-2: 20 A and 450 V over 4096 codes.
TEST(BoardConstants, ScalesOfTheConverters)
{
    const app_scale_config_t s = board_constants(shipped()).config.scale;
    EXPECT_FLOAT_EQ(s.current_A_per_cnt, 20.0F / 4096.0F);
    EXPECT_FLOAT_EQ(s.dc_link_V_per_cnt, 450.0F / 4096.0F);
    EXPECT_FLOAT_EQ(s.current_zero_cnt, 2048.0F);
}

// EQ-BOARD-4 the other way round: temperature, resistance, divider, code.
TEST(BoardConstants, TableOfTheThermistor)
{
    BoardConstants      b = board_constants(shipped());
    const app_config_t &c = b.bind();
    for (std::size_t n = 0; n < ntc_points; n++) {
        const double T_K  = static_cast<double>(c.scale.ntc_degC[n]) + 273.15;
        const double r    = 10e3 * std::exp(3435.0 * (1.0 / T_K - 1.0 / 298.15));
        const double code = 4096.0 * r / (r + 2200.0);
        EXPECT_NEAR(code, 512.0 + 128.0 * static_cast<double>(n), 0.25); // a hundredth of a degree
    }
}

// EQ-BOARD-5. 0.126 rad of 10000 counts and two pole pairs.
TEST(BoardConstants, ToleranceOfTheIndexIsAnAngle)
{
    Drive d = shipped();
    EXPECT_EQ(board_constants(d).config.angle.index_correct_max_cnt, 100);
    d.motor.pole_pairs = 4;
    EXPECT_EQ(board_constants(d).config.angle.index_correct_max_cnt, 50);
    d.encoder.lines = 64;
    EXPECT_EQ(board_constants(d).config.angle.index_correct_max_cnt, 4); // no less than the mark
}

TEST(BoardConstants, WhatTheBoardCannotHaveIsRefusedWithWhatItCan)
{
    Drive d                     = shipped();
    d.inverter.pwm_frequency_Hz = 19e3;
    EXPECT_NE(refusal(d).find("18996.96"), std::string::npos) << refusal(d); // 75 MHz / (2 * 1974)
    for (const double none : {0.0, 500.0, 1e9}) { // no register holds them
        d.inverter.pwm_frequency_Hz = none;
        EXPECT_NE(refusal(d).find("pwm_frequency_Hz"), std::string::npos) << none;
    }
    d                      = shipped();
    d.inverter.dead_time_s = 0.0;
    EXPECT_NE(refusal(d).find("dead_time_s"), std::string::npos);
    d.inverter.dead_time_s = 15e-6;
    EXPECT_NE(refusal(d).find("1.364e-05"), std::string::npos) << refusal(d);
    d               = shipped();
    d.encoder.lines = 16384;
    EXPECT_NE(refusal(d).find("16383"), std::string::npos) << refusal(d);
    d                          = shipped();
    d.current_sensors.adc_bits = 16;
    EXPECT_NE(refusal(d).find("12"), std::string::npos) << refusal(d);
    d                  = shipped();
    d.board.ntc_beta_K = 1000.0;
    EXPECT_NE(refusal(d).find("ntc_beta_K"), std::string::npos) << refusal(d);
}

// EQ-BOARD-3: the swing of the 390 W motor, integrated in steps. It must be within 0.2 degrees when
// the application looks, also with three times the inertia.
TEST(BoardConstants, AlignmentEndsAtRest)
{
    for (const double heavier : {1.0, 3.0}) {
        const Drive       d     = shipped();
        const Motor      &m     = d.motor;
        const AlignDesign a     = align_design(d);
        const double      J     = heavier * m.inertia_kgm2;
        const double      kp    = a.bandwidth_radps * m.d_axis_inductance_H;
        const double      dt    = 1e-5;
        double            del   = 3.0 / 57.3;
        double            w     = 0.0;
        double            iq    = 0.0;
        double            worst = 0.0;
        for (double t = 0.0; t < a.settle_s; t += dt) {
            const double torque =
                1.5 * m.pole_pairs *
                (m.pm_flux_Wb + (m.d_axis_inductance_H - m.q_axis_inductance_H) * a.current_A) * iq;
            iq += dt / m.q_axis_inductance_H *
                  (-(m.stator_resistance_Ohm + kp) * (iq + a.current_A * del) -
                   w * (m.pm_flux_Wb + m.d_axis_inductance_H * a.current_A));
            w += dt * (m.pole_pairs * torque - m.viscous_friction_Nms * w) / J;
            del += dt * w;
            worst = t > a.settle_s - 0.1 ? std::max(worst, std::abs(del)) : 0.0;
        }
        EXPECT_LT(worst, 0.2 / 57.3) << heavier;
    }
}

// Half of the current limit, or the largest stiffness of flux I - (Lq - Ld) I^2. A rotor without a
// magnet comes to rest with its larger inductance along the vector.
TEST(BoardConstants, AlignmentHoldsTheAxisThatHolds)
{
    Drive d = shipped();
    EXPECT_DOUBLE_EQ(align_design(d).current_A, 2.0);
    EXPECT_DOUBLE_EQ(align_design(d).theta_e_rad, 0.0);
    d.motor.max_current_A = 8.0;
    EXPECT_NEAR(align_design(d).current_A, 0.193 / (2.0 * (0.11391 - 0.07498)), 1e-9);
    d.motor.pm_flux_Wb = 0.0;
    EXPECT_DOUBLE_EQ(align_design(d).current_A, 4.0);
    EXPECT_NEAR(align_design(d).theta_e_rad, 4.712389, 1e-6);
    EXPECT_GT(align_design(d).decay_1ps, 1.0);
    d.board.align_current_A = 1.0;
    EXPECT_DOUBLE_EQ(align_design(d).current_A, 1.0);
}

// The range belongs to the board: half the current limit does not halve it.
TEST(BoardConstants, ACurrentLimitBelowTheBoardsKeepsItsRange)
{
    std::string text =
        support::read_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
    const std::string from = "max_current_A         = 4.0";
    text.replace(text.find(from), from.size(), "max_current_A = 2.0");
    const Drive        d = read_drive_text(text, "half");
    const app_config_t c = board_constants(d).config;
    EXPECT_EQ(d.current_sensors.range_A, 10.0);
    EXPECT_EQ(c.scale.current_A_per_cnt, board_constants(shipped()).config.scale.current_A_per_cnt);
    EXPECT_EQ(c.heat.inverter_A, 5.0F);
    EXPECT_EQ(c.zero_drift_A, board_constants(shipped()).config.zero_drift_A);
}

TEST(BoardConstants, ADriveThatWasChangedIsHeldToItsBoard)
{
    Drive d                = shipped();
    d.inverter.dead_time_s = 5e-8;
    EXPECT_NE(refusal(d).find("dead_time_s = 5e-08"), std::string::npos);
    d                     = shipped();
    d.motor.max_current_A = 5.1;
    EXPECT_NE(refusal(d).find("max_current_A = 5.1"), std::string::npos);
    d               = shipped();
    d.encoder.lines = 15000;
    EXPECT_NE(refusal(d).find("encoder_edges_Hz = 6.25e+06"), std::string::npos) << refusal(d);
}

TEST(BoardConstants, TripLevelsAreWithinTheBoard)
{
    Drive d = shipped();
    EXPECT_EQ(largest_trip_current_A(d), 9.0);
    EXPECT_NEAR(largest_trip_dc_link_V(d), 449.89, 0.01);
    d.board.file->facts[BOARD_FACT_RATED_DC_LINK_V] = 400.0;
    EXPECT_EQ(largest_trip_dc_link_V(d), 400.0);
    d.board.file.reset();
    EXPECT_NEAR(largest_trip_current_A(d), 9.502, 0.001);
}

namespace {

Drive second_board()
{
    return read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/m2310p_24v.toml");
}

/// Counts of the 256 codes of TIM1's DTG by the four lines of RM0440.
unsigned dead_time_of(unsigned code)
{
    return code < 0x80U   ? code
           : code < 0xC0U ? (64U + (code & 0x3FU)) * 2U
           : code < 0xE0U ? (32U + (code & 0x1FU)) * 8U
                          : (32U + (code & 0x1FU)) * 16U;
}

} // namespace

// 170 MHz, a count a cycle; 0.6 us; 1000 lines; no chopper.
TEST(SecondBoard, RegistersOfItsDrive)
{
    const app_config_t c = board_constants(second_board()).config;
    EXPECT_EQ(c.board.duty_full_cnt, 4250);
    EXPECT_EQ(c.board.pwm_cycles, 8500U);
    EXPECT_EQ(c.board.dead_time_cnt, 102);
    EXPECT_EQ(c.board.positions, 4000);
    EXPECT_EQ(c.board.current_sensors, 3U);
    EXPECT_EQ(c.board.chopper, 0U);
    EXPECT_FLOAT_EQ(c.scale.current_A_per_cnt, 120.3125F / 4096.0F);
    EXPECT_FLOAT_EQ(c.scale.offset_max_cnt, 600.0F);
    EXPECT_FLOAT_EQ(board_constants(shipped()).config.scale.offset_max_cnt, 100.0F);
}

// No less than asked for, and no more than the next code has. The shortest is one count.
TEST(SecondBoard, DeadTimeIsTheNextThatTheTimerHas)
{
    Drive d = second_board();
    for (unsigned tenths = 1; tenths <= 10080; tenths += 3) {
        const double wanted = tenths / 10.0;
        unsigned     best   = 65535;
        for (unsigned code = 1; code < 256; code++) {
            const unsigned cnt = dead_time_of(code);
            best               = cnt >= wanted && cnt < best ? cnt : best;
        }
        ASSERT_EQ(processor_of(d).dead_time_cnt(wanted).value_or(0.0), best) << wanted;
    }
    EXPECT_FALSE(processor_of(d).dead_time_cnt(1008.1));
    d.inverter.dead_time_s = 3e-6; // 510 counts, between 504 and 512
    EXPECT_EQ(board_constants(d).config.board.dead_time_cnt, 512);
    d.inverter.dead_time_s = 6e-6;
    EXPECT_NE(refusal(d).find("5.929e-06"), std::string::npos) << refusal(d);
}

// EQ-BOARD-8: lower switches on for the dead time and 1.3 us before the top, at any frequency.
TEST(SecondBoard, ShuntsCarryTheirCurrentsWhenTheySettle)
{
    Drive d = second_board();
    EXPECT_EQ(board_constants(d).config.gate.duty_max_cnt, 4250 - 102 - 221);
    for (const double full : {1000.0, 2125.0, 4251.0, 8500.0, 17000.0, 21845.0}) {
        d.inverter.pwm_frequency_Hz = 170e6 / (2.0 * full);
        const app_config_t c        = board_constants(d).config;
        const double       on_s     = (full - c.gate.duty_max_cnt - c.board.dead_time_cnt) / 170e6;
        EXPECT_GT(on_s, 1.3e-6 - 1e-12) << full;
        EXPECT_LE(c.gate.duty_max_cnt, 0.981 * full);
        EXPECT_TRUE(on_s < 1.31e-6 || c.gate.duty_max_cnt >= std::floor(0.981 * full)) << full;
    }
    d.inverter.pwm_frequency_Hz = 170e6 / (2.0 * 640.0);
    EXPECT_NE(refusal(d).find("leave a duty of 0.5"), std::string::npos) << refusal(d);
    EXPECT_EQ(board_constants(shipped()).config.gate.duty_max_cnt, 7500);
}

// The zero may be 600 codes off, and the comparators act at 45 A.
TEST(SecondBoard, TripLevelIsWhatTheConverterShows)
{
    Drive d = second_board();
    EXPECT_NEAR(largest_trip_current_A(d), 60.15625 * (1.0 - 2.0 * 602.0 / 4096.0), 1e-9);
    d.board.file->offset_max_cnt = 100.0;
    EXPECT_EQ(largest_trip_current_A(d), 45.0);
}

TEST(SecondBoard, ItsFirmwareAcceptsTheConstants)
{
    const Drive            d      = second_board();
    const Design           design = design_drive(d, Precision::quick);
    BoardConstants         c      = board_constants(d);
    const board_identity_t b      = board_identity_of(d);
    EXPECT_STREQ(b.name, "b_g431b_esc1");
    EXPECT_EQ(app_board_check(&b, &c.bind(), &design.config).field, BOARD_FIELD_NONE);
}

TEST(SecondBoard, WhatItsProcessorHasNot)
{
    const Processor &p = processor_of(second_board());
    EXPECT_EQ(p.clock_Hz, 170e6);
    EXPECT_EQ(p.counter_Hz, 170e6);
    EXPECT_EQ(p.most_updates, 1);
    EXPECT_FALSE(p.has_chopper_pin);
    EXPECT_FALSE(p.has_cycle_budget);
    const Processor &first = processor_of(shipped());
    EXPECT_EQ(first.clock_Hz, 150e6);
    EXPECT_EQ(first.counter_Hz, 75e6);
    EXPECT_EQ(first.most_cycles, 65535.0);
    EXPECT_EQ(first.most_updates, 2);
    EXPECT_TRUE(first.has_chopper_pin);
    EXPECT_TRUE(first.has_cycle_budget);
}

namespace {

Drive with_chopper()
{
    Drive d                               = shipped();
    auto &f                               = d.board.file->facts;
    f[BOARD_FACT_CHOPPER_ON_V]            = 385.0;
    f[BOARD_FACT_CHOPPER_OFF_V]           = 375.0;
    f[BOARD_FACT_CHOPPER_POWER_W]         = 50.0;
    f[BOARD_FACT_CHOPPER_RESISTANCE_Ohm]  = 100.0;
    f[BOARD_FACT_CHOPPER_TIME_CONSTANT_s] = 20.0;
    return d;
}

} // namespace

TEST(BoardConstants, ChopperInCodes)
{
    const app_config_t c = board_constants(with_chopper()).config;
    EXPECT_EQ(c.board.chopper, 1U);
    EXPECT_EQ(c.chopper.on_cnt, 3504U);  // 385 x 4096 / 450 = 3504.4
    EXPECT_EQ(c.chopper.off_cnt, 3413U); // 3413.3
    EXPECT_FLOAT_EQ(c.chopper.per_V2, 2e-4F);
    EXPECT_EQ(c.chopper.tau_s, 20.0F);
    EXPECT_EQ(board_constants(shipped()).config.board.chopper, 0U);
    EXPECT_EQ(board_constants(shipped()).config.chopper.on_cnt, 0U);

    Drive d                                      = with_chopper();
    d.board.file->facts[BOARD_FACT_CHOPPER_ON_V] = 399.0;
    EXPECT_NE(refusal(d).find("below 398.25, the trip"), std::string::npos) << refusal(d);
}

// 193 cycles of each period, over 1 - 0.32 / 3.
TEST(BoardConstants, ChopperTakesCyclesOfThePeriod)
{
    const double without = pwm_full_cnt_range(shipped()).least;
    const double with    = pwm_full_cnt_range(with_chopper()).least;
    EXPECT_NEAR(4.0 * (with - without), 216.0, 4.1);
}

// The law may feed back as much as it likes until the chopper is on, and nothing halfway to the trip.
TEST(BoardConstants, ChopperRaisesTheLimitOfRegenerationWhenTheDriveNamesIt)
{
    Drive d = with_chopper();
    EXPECT_NEAR(regeneration_limit(d).start_V, 324.5, 1e-9);
    EXPECT_NEAR(regeneration_limit(d).end_V, 368.75, 1e-9);
    d.inverter.regeneration = DcLinkSink::brake_chopper;
    EXPECT_NEAR(regeneration_limit(d).start_V, 385.0, 1e-9);
    EXPECT_NEAR(regeneration_limit(d).end_V, 391.625, 1e-9);
    d.board.file->facts[BOARD_FACT_CHOPPER_ON_V] =
        0.0; // one outside the board: nobody knows its level
    EXPECT_NEAR(regeneration_limit(d).start_V, 324.5, 1e-9);
}

TEST(BoardIdentity, IsThatOfTheBoardFileWithItsSum)
{
    const Drive            d = shipped();
    const board_identity_t b = board_identity_of(d);
    EXPECT_STREQ(b.name, "board_390w");
    for (std::size_t n = 0; n < BOARD_FACT_COUNT; n++) {
        EXPECT_EQ(b.fact[n], static_cast<float>(d.board.file->facts[n]))
            << board_field_name(static_cast<std::uint16_t>(n + 1));
    }
    EXPECT_EQ(b.sum, board_identity_sum(&b));
}

// A simulated board has the drive's own values: the firmware accepts its constants.
TEST(BoardIdentity, OfADriveWithoutBoardHoldsForItsConstants)
{
    Drive d = shipped();
    d.board.file.reset();
    d.board.precharge_s = 0.02;
    d.board.duty_max    = 0.97;
    d.board.pulse_min_s = 1.3e-6;
    for (const double scale : {1.0, 0.1, 7.0}) {
        d.current_sensors.range_A       = 10.0 * scale;
        d.motor.max_current_A           = 4.0 * scale;
        const Design             design = design_drive(d, Precision::quick);
        BoardConstants           c      = board_constants(d);
        const board_identity_t   b      = board_identity_of(d);
        const board_difference_t found  = app_board_check(&b, &c.bind(), &design.config);
        EXPECT_STREQ(board_field_name(found.field), "") << scale;
    }
}
