// SPDX-License-Identifier: MIT
// Compares the application with its drivers on the virtual device with the same application on
// board.h. The same codes and counts must give the same duty ratios, bit for bit.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <gtest/gtest.h>

extern "C" {
#include "app.h"
#include "app_registers.h"
}
#include "common/errors.hpp"
#include "drive/pwm_frequency.hpp"
#include "sil/board/board_run.hpp"
#include "sil/board/board_runs.hpp"
#include "sil/eval/metrics.hpp"

namespace {

using namespace sdre;

Scenario shipped(const std::string &name)
{
    return read_scenario_file(std::string(SDRE_SOURCE_DIR) + "/host_tools/sil/scenarios/" + name +
                              ".toml");
}

/// The age of an edge is rounded by each in its own way (EdgeTimes, below); counts are whole numbers.
Scenario on_counts(Scenario s)
{
    if (s.drive.encoder.edge_times) {
        s.drive                     = read_drive_file(std::string(SDRE_SOURCE_DIR) +
                                                      "/firmware/config/drives/ipmsm_390w_counts.toml");
        s.sensors.encoder_edge_time = false;
    }
    return s;
}

class BoardRuns : public ::testing::TestWithParam<const char *> {};

TEST_P(BoardRuns, DriversAndFakeGiveTheSameRunBitForBit)
{
    Scenario s                   = on_counts(shipped(GetParam()));
    s.duration_s                 = std::min(s.duration_s, 0.45); // beyond the first step of each
    const Controller  controller = prepare_controller(s);
    const BoardResult api        = simulate_on_board(s, BoardKind::api, controller);
    const BoardResult device     = simulate_on_board(s, BoardKind::f28335, controller);

    EXPECT_EQ(device.findings, std::vector<std::string>{});
    EXPECT_EQ(device.result.fault, 0);
    EXPECT_EQ(device.modbus_errors, 0);
    EXPECT_GT(device.modbus_answers, 2);
    EXPECT_EQ(device.zero_a_cnt, api.zero_a_cnt);
    EXPECT_EQ(device.zero_b_cnt, api.zero_b_cnt);
    ASSERT_EQ(device.ticks.size(), api.ticks.size());
    for (std::size_t k = 0; k < api.ticks.size(); k++) {
        ASSERT_EQ(device.ticks[k].current_code, api.ticks[k].current_code) << k;
        ASSERT_EQ(device.ticks[k].count, api.ticks[k].count) << k;
        ASSERT_EQ(device.ticks[k].duty_cnt, api.ticks[k].duty_cnt) << k;
        ASSERT_EQ(device.result.trace[k].omega_e_radps, api.result.trace[k].omega_e_radps) << k;
        ASSERT_EQ(device.result.trace[k].iq_A, api.result.trace[k].iq_A) << k;
        ASSERT_EQ(device.result.trace[k].peak_current_A, api.result.trace[k].peak_current_A) << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, BoardRuns,
                         ::testing::Values("board_load_step", "board_load_step_varied",
                                           "board_speed_step", "board_speed_step_varied",
                                           "board_speed_step_5A", "board_reversal", "board_hold",
                                           "board_flux_weakening", "board_flux_weakening_5A",
                                           "fig4_parameter_steps_nd0", "fig4_parameter_steps_nd1",
                                           "fig4_parameter_steps_nd2", "fig4_parameter_steps_nd3",
                                           "fig5_load_step", "fig6_load_step_varied",
                                           "fig7_speed_step", "fig8_flux_weakening"));

/// Drivers and fake round the age of an edge each in its own way, by one tick of the capture timer: 13 ns.
class EdgeTimes : public ::testing::TestWithParam<std::pair<const char *, const char *>> {};

TEST_P(EdgeTimes, DriversAndFakeAndCoreAgree)
{
    const auto [scenario, drive] = GetParam();
    Scenario s                   = shipped(scenario);
    s.drive = read_drive_file(std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/" + drive +
                              ".toml");
    s.sensors.encoder_edge_time = s.drive.encoder.edge_times;
    s.sensors.encoder_disc      = {0.0, 0.0, 0.0};
    s.duration_s                = 0.1;
    s.sensors.adc_offset_a_A =
        0.0; // the application calibrates offsets away, the core alone does not
    s.sensors.adc_offset_b_A          = 0.0;
    const Controller       controller = prepare_controller(s);
    const SimulationResult core       = simulate(s, controller);
    const BoardResult      api        = simulate_on_board(s, BoardKind::api, controller);
    const BoardResult      device     = simulate_on_board(s, BoardKind::f28335, controller);

    EXPECT_EQ(device.findings, std::vector<std::string>{});
    EXPECT_EQ(core.fault, 0);
    EXPECT_EQ(api.result.fault, 0);
    EXPECT_EQ(device.result.fault, 0);
    ASSERT_EQ(device.result.trace.size(), core.trace.size());
    ASSERT_EQ(device.result.trace.size(), api.result.trace.size());
    double to_api  = 0.0;
    double to_core = 0.0;
    for (std::size_t k = core.trace.size() / 2; k < core.trace.size(); k++) {
        const double w = device.result.trace[k].omega_e_radps;
        to_api         = std::max(to_api, std::abs(w - api.result.trace[k].omega_e_radps));
        to_core        = std::max(to_core, std::abs(w - core.trace[k].omega_e_radps));
    }
    std::printf("%s on %s: %.3f rad/s to the fake, %.3f to the core\n", scenario, drive, to_api,
                to_core);
    EXPECT_LE(to_api, 0.05);  // measured 0.02
    EXPECT_LE(to_core, 0.25); // measured 0.11
}

INSTANTIATE_TEST_SUITE_P(Shipped, EdgeTimes,
                         ::testing::Values(std::pair{"board_load_step", "ipmsm_390w"},
                                           std::pair{"board_load_step", "ipmsm_390w_noc_h_edges"},
                                           std::pair{"board_load_step", "ipmsm_390w_pi_foc_edges"},
                                           std::pair{"board_load_step", "ipmsm_390w_ladrc_edges"},
                                           std::pair{"servo_case_1_2", "servo_200w_cdobc"},
                                           std::pair{"servo_case_1_2", "servo_200w_gpiobc"},
                                           std::pair{"servo_case_1_2", "servo_200w_hdobc"},
                                           std::pair{"servo_case_1_2", "servo_200w_pid"},
                                           std::pair{"servo_case_1_2", "servo_200w_noc_h"}));

struct OtherFrequency {
    const char *drive;
    double      pwm_Hz;
    int         updates;
};

/// Periods that are no round number of anything: the ends of the range, between them, and beyond what the cycles of the
/// processor allow.
class OtherFrequencies : public ::testing::TestWithParam<OtherFrequency> {};

TEST_P(OtherFrequencies, DriversAndFakeAndCoreAgree)
{
    const auto [drive, pwm_Hz, updates] = GetParam();
    Scenario s                          = shipped("board_load_step");
    s.drive = read_drive_file(std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/" + drive +
                              ".toml");
    s.drive.inverter.pwm_frequency_Hz =
        counted_pwm_Hz(processor_of(s.drive), pwm_full_cnt(processor_of(s.drive), pwm_Hz));
    s.drive.inverter.updates_per_period = updates;
    s.drive.board.file.reset();               // its gates need more dead time
    s.drive.inverter.dead_time_s      = 1e-6; // at most a tenth of the shortest period
    s.sensors.encoder_edge_time       = s.drive.encoder.edge_times;
    s.sensors.encoder_disc            = {0.0, 0.0, 0.0};
    s.duration_s                      = 0.06;
    s.sensors.adc_offset_a_A          = 0.0;
    s.sensors.adc_offset_b_A          = 0.0;
    s.sensors.adc_noise_rms_A         = 0.0;
    const Controller       controller = prepare_controller(s);
    const SimulationResult core       = simulate(s, controller);
    const BoardResult      api        = simulate_on_board(s, BoardKind::api, controller);
    const BoardResult      device     = simulate_on_board(s, BoardKind::f28335, controller);

    EXPECT_EQ(device.findings, std::vector<std::string>{});
    EXPECT_EQ(core.fault, 0);
    EXPECT_EQ(device.result.fault, 0);
    EXPECT_EQ(device.modbus_errors, 0);
    ASSERT_EQ(device.ticks.size(), api.ticks.size());
    ASSERT_EQ(device.result.trace.size(), core.trace.size());
    double to_api  = 0.0;
    double to_core = 0.0;
    for (std::size_t k = 0; k < api.ticks.size(); k++) {
        const double w = device.result.trace[k].omega_e_radps;
        if (k >= api.ticks.size() / 2) {
            to_api  = std::max(to_api, std::abs(w - api.result.trace[k].omega_e_radps));
            to_core = std::max(to_core, std::abs(w - core.trace[k].omega_e_radps));
        }
        if (!s.drive.encoder.edge_times) { // bit for bit
            ASSERT_EQ(device.ticks[k].current_code, api.ticks[k].current_code) << k;
            ASSERT_EQ(device.ticks[k].count, api.ticks[k].count) << k;
            ASSERT_EQ(device.ticks[k].duty_cnt, api.ticks[k].duty_cnt) << k;
        }
    }
    std::printf("%s at %g Hz, %d: %.3f rad/s to the fake, %.3f to the core\n", drive, pwm_Hz,
                updates, to_api, to_core);
    EXPECT_LE(to_api, 0.05);  // measured 0.02 at 2289 Hz
    EXPECT_LE(to_core, 0.75); // measured 0.44: counts alone at 2289 Hz
}

INSTANTIATE_TEST_SUITE_P(Range, OtherFrequencies,
                         ::testing::Values(OtherFrequency{"ipmsm_390w_counts", 8000.0, 1},
                                           OtherFrequency{"ipmsm_390w_counts", 20672.0, 1},
                                           OtherFrequency{"ipmsm_390w_counts", 8000.0, 2},
                                           OtherFrequency{"ipmsm_390w", 16000.0, 1},
                                           OtherFrequency{"ipmsm_390w", 16000.0, 2},
                                           OtherFrequency{"ipmsm_390w_counts", 2289.0, 1},
                                           OtherFrequency{"ipmsm_390w", 2289.0, 1},
                                           OtherFrequency{"ipmsm_390w_pi_foc_edges", 16000.0, 2},
                                           OtherFrequency{"ipmsm_390w_pi_foc_edges", 41852.0, 1}));

TEST(BoardRunsMore, SwitchedInverterToo)
{
    Scenario s                   = on_counts(shipped("board_load_step"));
    s.duration_s                 = 0.1;
    s.inverter.model             = InverterModel::switched;
    const Controller  controller = prepare_controller(s);
    const BoardResult api        = simulate_on_board(s, BoardKind::api, controller);
    const BoardResult device     = simulate_on_board(s, BoardKind::f28335, controller);
    EXPECT_EQ(device.result.fault, 0);
    ASSERT_EQ(device.ticks.size(), api.ticks.size());
    for (std::size_t k = 0; k < api.ticks.size(); k++) {
        ASSERT_EQ(device.ticks[k].duty_cnt, api.ticks[k].duty_cnt) << k;
        ASSERT_EQ(device.result.trace[k].iq_A, api.result.trace[k].iq_A) << k;
    }
}

/// Edges after a change of direction have no time there; taken as if nothing were known of them, the loop hunted with 58 V.
TEST(BoardRunsMore, HoldsQuietlyAtRest)
{
    for (const BoardKind kind : {BoardKind::api, BoardKind::f28335}) {
        Scenario s            = shipped("board_hold");
        s.duration_s          = 0.5; // the crawl comes after it
        const BoardResult run = simulate_on_board(s, kind);
        const Metrics     m   = measure(s, run.result.trace).at(0);
        EXPECT_EQ(run.result.fault, 0);
        EXPECT_LE(m.effort.vq_noise_V, 12.0); // measured 9.4
        EXPECT_LE(m.ripple_e_radps, 0.3);     // measured 0.21
        EXPECT_LE(m.dip_e_radps, 15.5);       // measured 14.5; 13.0 before late edges said less
    }
}

TEST(BoardRunsMore, StartsWithTheShaftAtZeroAndTheWantedSpeed)
{
    Scenario s            = shipped("board_load_step");
    s.duration_s          = 0.01;
    s.initial_angle_e_rad = 0.0;
    const BoardResult run = simulate_on_board(s, BoardKind::f28335);
    EXPECT_EQ(run.ticks.front().count, 0);
    EXPECT_DOUBLE_EQ(run.result.trace.front().omega_e_radps, 300.0);
    EXPECT_DOUBLE_EQ(run.result.trace.front().iq_A, 0.0);
}

TEST(BoardRunsMore, CoreAloneAndApplicationAgreeWithinTheirNoise)
{
    // The application adds duty counts (0.04 V), the dc link's code (0.1 V) and the calibrated zeros (0.3 mA).
    // Measured without noise: 0.32 rad/s.
    Scenario s                         = shipped("board_load_step");
    s.sensors.adc_noise_rms_A          = 0.0;
    s.duration_s                       = 0.4;
    const Controller       c           = prepare_controller(s);
    const SimulationResult core        = simulate(s, c);
    const BoardResult      device      = simulate_on_board(s, BoardKind::f28335, c);
    double                 worst_omega = 0.0;
    for (std::size_t k = 0; k < core.trace.size(); k++) {
        worst_omega = std::max(worst_omega, std::abs(core.trace[k].omega_e_radps -
                                                     device.result.trace[k].omega_e_radps));
    }
    RecordProperty("worst_omega_mradps", static_cast<int>(1e3 * worst_omega));
    EXPECT_LT(worst_omega, 1.0); // rad/s, of 300
}

TEST(BoardRunsMore, StuckEncoderIsAFault)
{
    Scenario         s = shipped("board_load_step");
    const Controller c = prepare_controller(s);
    set_firmware(c.config, s.drive);
    F28335Run  run(s, 1700, 3e-6);
    const auto step_to = [&run](long tick) {
        while (run.bench().tick() < tick) {
            ASSERT_TRUE(run.step());
        }
    };
    step_to(1560);
    run.set_speed(3000);
    step_to(1640);
    run.set_run();
    step_to(2000);
    ASSERT_EQ(app_status_read().mode, APP_MODE_RUN);
    run.bench().stick_encoder();
    step_to(2100);
    EXPECT_EQ(app_status_read().mode, APP_MODE_STOP); // brakes first
    step_to(2250);
    EXPECT_EQ(app_status_read().mode, APP_MODE_FAULT);
    EXPECT_EQ(app_status_read().drive_fault, DRIVE_FAULT_ENCODER);

    // And the operator reads so over the serial line.
    run.chat();
    step_to(2310);
    ASSERT_GT(run.registers().size(), static_cast<std::size_t>(APP_REGISTERS_DRIVE_FAULT));
    EXPECT_EQ(run.registers()[APP_REGISTERS_MODE], APP_MODE_FAULT);
    EXPECT_EQ(run.registers()[APP_REGISTERS_DRIVE_FAULT], DRIVE_FAULT_ENCODER);
}

TEST(BoardRunsMore, SettingsThatTheBoardDoesNotHaveAreRefused)
{
    Scenario s                        = shipped("board_load_step");
    s.drive.inverter.pwm_frequency_Hz = 19000.0; // its counter has no such period
    EXPECT_THROW(simulate_on_board(s, BoardKind::api), InputError);
    s                  = shipped("board_load_step");
    s.sensors.adc_bits = 14;
    EXPECT_THROW(simulate_on_board(s, BoardKind::api), InputError);
    s                      = shipped("board_load_step");
    s.inverter.dead_time_s = 5e-6;
    EXPECT_THROW(simulate_on_board(s, BoardKind::api), InputError);
}

} // namespace
