/* SPDX-License-Identifier: MIT */
/* Constants of the B-G431B-ESC1 around the shipped drive's tables. docs/hardware_stm32g431.md has
 * the origin of each number of the board. Its motor needs ten times the board's dc link: board and
 * constants contradict each other, and the drive answers but never runs. */
#include "board_config.h"

#define TICKS_PER_ms 5U /* 200 us */
#define DUTY_FULL    17000U

/* 3.3 V over the gain of 64 / 7 and a shunt of 3 mOhm: 120.31 A from end to end. */
#define CURRENT_RANGE_A 60.15625f
#define DC_LINK_RANGE_V 34.283333f /* 3.3 V times (169 + 18) / 18 */
#define NTC_POINTS      28U

/* EQ-BOARD-4, of 10 kOhm and 3380 K with 4.7 kOhm. */
static const float ntc_degC[NTC_POINTS] = {
    118.25f, 106.83f, 97.66f, 89.96f, 83.28f, 77.35f,  71.99f,  67.06f,  62.48f, 58.16f,
    54.04f,  50.10f,  46.27f, 42.54f, 38.86f, 35.21f,  31.56f,  27.88f,  24.12f, 20.26f,
    16.23f,  11.97f,  7.40f,  2.36f,  -3.34f, -10.12f, -18.82f, -31.99f,
};

const app_config_t board_config = {
    .board =
        {
            .pwm_cycles      = 34000UL,
            .duty_full_cnt   = DUTY_FULL,
            .dead_time_cnt   = 512U, /* 3 us of the tables, up to the next step */
            .positions       = 10000U,
            .current_sensors = 3U,
            .chopper         = 0U,
        },
    .pwm_period_s = 200.0e-6f,
    .dead_time_s  = 3.0e-6f, /* of the tables */
    .scale =
        {
            .current_A_per_cnt = (2.0f * CURRENT_RANGE_A) / (float)BOARD_ADC_CODES,
            .current_zero_cnt  = 0.5f * (float)BOARD_ADC_CODES,
            .offset_max_cnt    = 600.0f, /* the network's zero may be 505 counts off the middle */
            .dc_link_V_per_cnt = DC_LINK_RANGE_V / (float)BOARD_ADC_CODES,
            .ntc_first_cnt     = 512U,
            .ntc_step_cnt      = 128U,
            .ntc_points        = NTC_POINTS,
            .ntc_degC          = ntc_degC,
        },
    /* Motor and encoder are those of firmware/config/board_config.c, as the next two. */
    .angle =
        {
            .index_theta_e_rad     = 0.0f,
            .index_tolerance_cnt   = 4U,
            .index_correct_max_cnt = 100U,
            .jump_cnt              = 16U,
        },
    .align =
        {
            .current_A         = 2.0f,
            .bandwidth_radps   = 73.3899612f,
            .theta_e_rad       = 0.0f,
            .watch_ticks       = 100U * TICKS_PER_ms,
            .ramp_ticks        = 300U * TICKS_PER_ms,
            .sweep_ticks       = 1200U * TICKS_PER_ms,
            .settle_ticks      = 1200U * TICKS_PER_ms,
            .still_ticks       = 100U * TICKS_PER_ms,
            .still_cnt         = 4U,
            .quarter_error_cnt = 250U,
        },
    .gate = /* bootstrap supplies; the shunts need the lower switch in every period */
    {
        .precharge_ticks         = 1U * TICKS_PER_ms,
        .precharge_speed_e_radps = 50.0f, /* below the current limit times R / flux, 4 A */
        .duty_max_cnt            = 16266U,
        .pulse_min_cnt           = 0U,
    },
    .stop =
        {
            .reaction      = APP_STOP_COAST,
            .still_e_radps = 20.0f,
            .short_circuit = true,
        },
    .heat = {.motor_A = 2.60614252f, .motor_s = 30.0f, .inverter_A = 20.0f, .inverter_s = 2.0f},
    .zero_drift_A           = 0.4f,
    .temperature_limit_degC = 80.0f,
    .temperature_trip_degC  = 90.0f,
    .boot_ticks             = 50U * TICKS_PER_ms,
    .calibrate_ticks        = 256U * TICKS_PER_ms,
    .background_ticks       = 3U * TICKS_PER_ms,
    .modbus_address         = 1U,
    .modbus_gap_ticks       = 10U,
    .modbus_timeout_ticks   = 500U * TICKS_PER_ms,
    .drive_name             = "ipmsm_390w",
    .digest                 = "",
};

const board_identity_t board_identity = {
    .name = "b_g431b_esc1",
    .fact =
        {
            [BOARD_FACT_PWM_CLOCK_Hz]             = 170.0e6f,
            [BOARD_FACT_GATE_ON_LEVEL]            = 1.0f,
            [BOARD_FACT_DEAD_TIME_MIN_s]          = 0.6e-6f,
            [BOARD_FACT_PRECHARGE_s]              = 1.0e-3f,
            [BOARD_FACT_DUTY_MAX]                 = 0.981f,
            [BOARD_FACT_PULSE_MIN_s]              = 0.0f,
            [BOARD_FACT_CURRENT_RANGE_A]          = CURRENT_RANGE_A,
            [BOARD_FACT_CURRENT_SENSORS]          = 3.0f,
            [BOARD_FACT_RATED_CURRENT_A]          = 40.0f,
            [BOARD_FACT_TRIP_CURRENT_A]           = 45.0f,
            [BOARD_FACT_DC_LINK_RANGE_V]          = DC_LINK_RANGE_V,
            [BOARD_FACT_RATED_DC_LINK_V]          = 25.0f,
            [BOARD_FACT_NTC_RESISTANCE_Ohm]       = 10.0e3f,
            [BOARD_FACT_NTC_BETA_K]               = 3380.0f,
            [BOARD_FACT_NTC_DIVIDER_Ohm]          = 4.7e3f,
            [BOARD_FACT_TEMPERATURE_LIMIT_degC]   = 80.0f,
            [BOARD_FACT_TEMPERATURE_TRIP_degC]    = 90.0f,
            [BOARD_FACT_INVERTER_CURRENT_A]       = 20.0f,
            [BOARD_FACT_INVERTER_TIME_CONSTANT_s] = 2.0f,
            [BOARD_FACT_ENCODER_EDGES_Hz]         = 6.0e6f,
        },
    .sum = 0x98B64AF8UL,
};
