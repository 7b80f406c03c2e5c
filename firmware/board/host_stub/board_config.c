/* SPDX-License-Identifier: MIT */
#include "board_config.h"

#define TICKS_PER_ms 5U /* 200 us */
#define DUTY_FULL    2500U

/* Sensors as simulated in board.c. Chosen: +-12 A and 0 .. 450 V over all codes; the temperature
 * falls by 100 K over half of the codes. */
#define CURRENT_SPAN_A 24.0f
#define DC_LINK_SPAN_V 450.0f
#define NTC_FIRST_cnt  4096U
#define NTC_STEP_cnt   8192U
#define NTC_POINTS     2U

static const float ntc_degC[NTC_POINTS] = {100.0f, 0.0f};

const app_config_t board_config = {
    .board = /* chosen: a processor of 25 MHz, an encoder of 1024 lines */
    {
        .pwm_cycles      = 5000UL,
        .duty_full_cnt   = DUTY_FULL,
        .dead_time_cnt   = 75U,
        .positions       = 4096U,
        .current_sensors = 2U,
    },
    .pwm_period_s = 200.0e-6f,
    .dead_time_s  = 3.0e-6f,
    .scale =
        {
            .current_A_per_cnt = CURRENT_SPAN_A / (float)BOARD_ADC_CODES,
            .current_zero_cnt  = 0.5f * (float)BOARD_ADC_CODES,
            .offset_max_cnt    = 400.0f, /* chosen: 0.6 A */
            .dc_link_V_per_cnt = DC_LINK_SPAN_V / (float)BOARD_ADC_CODES,
            .ntc_first_cnt     = NTC_FIRST_cnt,
            .ntc_step_cnt      = NTC_STEP_cnt,
            .ntc_points        = NTC_POINTS,
            .ntc_degC          = ntc_degC,
        },
    .angle =
        {
            .index_theta_e_rad     = 0.0f,
            .index_tolerance_cnt   = 4U, /* no index pulse ever comes */
            .index_correct_max_cnt = 40U,
            .jump_cnt              = 16U,
        },
    /* The motor is that of the F28335's board; derivations stand in its board_config.c. Counts are
     * of 4096 a turn. */
    .align =
        {
            .current_A         = 2.0f,
            .bandwidth_radps   = 100.0f,
            .watch_ticks       = 100U * TICKS_PER_ms,
            .ramp_ticks        = 300U * TICKS_PER_ms,
            .sweep_ticks       = 1200U * TICKS_PER_ms,
            .settle_ticks      = 1200U * TICKS_PER_ms,
            .still_ticks       = 100U * TICKS_PER_ms,
            .still_cnt         = 4U,
            .quarter_error_cnt = 102U, /* a fifth of a quarter of an electrical turn, 512 */
        },
    .gate = /* isolated supplies; the drivers pass any pulse that is longer than the dead time */
    {
        .precharge_ticks         = 0U,
        .precharge_speed_e_radps = 0.0f,
        .duty_max_cnt            = DUTY_FULL,
        .pulse_min_cnt           = 0U,
    },
    .stop = /* a commanded stop coasts; 20 rad/s electrical is 1.6 turns per second */
    {
        .reaction      = APP_STOP_COAST,
        .still_e_radps = 20.0f,
        .short_circuit = true,
    },
    .heat         = {.motor_A = 2.6f, .motor_s = 30.0f, .inverter_A = 5.0f, .inverter_s = 2.0f},
    .zero_drift_A = 0.4f,
    .temperature_limit_degC = 80.0f, /* as on the F28335's board */
    .temperature_trip_degC  = 90.0f,
    .boot_ticks             = 10U * TICKS_PER_ms, /* chosen: nothing has to settle */
    .calibrate_ticks        = 20U * TICKS_PER_ms, /* chosen: there is no noise */
    .background_ticks       = 10U * TICKS_PER_ms,
    .modbus_address         = 1U,
    .modbus_gap_ticks       = 10U,
    .modbus_timeout_ticks   = 500U * TICKS_PER_ms,
    .drive_name             = "host_stub",
    .digest                 = "",
};
