/* SPDX-License-Identifier: MIT */
#include "board_config.h"

#include "clock_tree.h"

#define TICKS_PER_ms 5U /* 200 us */

/* -10 A .. 10 A as 0 V .. 3 V over 4096 codes: 150 mV/A about 1.5 V. */
#define CURRENT_SPAN_A     20.0f
#define CURRENT_ZERO_cnt   2048.0f
#define CURRENT_OFFSET_cnt 100.0f

/* 0 V .. 450 V as 0 V .. 3 V, a divider of 1/150: 13 % above the largest dc link that the drive accepts (398 V). */
#define DC_LINK_SPAN_V 450.0f

/* NTC 10 kOhm at 25 degC, B = 3435 K, to ground; 2.2 kOhm to 3.0 V, which puts half scale near 70 degC:
 *
 *     code / 4096 = R / (R + 2.2 kOhm),   R = 10 kOhm exp(B (1 / T - 1 / 298.15 K))
 *
 * One point every 128 codes from 512 to 3968. Straight lines in between are wrong by at most 0.15 K from 40 to
 * 105 degC and 1.0 K at either end (calculated; tests/unit/test_app_scale.c). */
#define NTC_FIRST_cnt 512U
#define NTC_STEP_cnt  128U
#define NTC_POINTS    28U

static const float ntc_degC[NTC_POINTS] = {
    152.98f, 139.68f, 129.05f, 120.14f, 112.45f, 105.63f, 99.47f, 93.83f, 88.58f, 83.64f,
    78.96f,  74.46f,  70.11f,  65.87f,  61.70f,  57.57f,  53.44f, 49.28f, 45.04f, 40.69f,
    36.16f,  31.37f,  26.24f,  20.61f,  14.23f,  6.67f,   -3.00f, -17.59f};

const app_config_t board_config = {
    .pwm_period_s = 200.0e-6f, /* BOARD_PWM_CYCLES at 150 MHz */
    .dead_time_s  = (float)CLOCK_DEAD_TIME_us * 1.0e-6f,
    .scale =
        {
            .current_A_per_cnt = CURRENT_SPAN_A / (float)BOARD_ADC_CODES, /* 4.88 mA, EQ-ADC-1 */
            .current_zero_cnt  = CURRENT_ZERO_cnt,
            /* Converter 15 codes, half of the supply with 1 % resistors 20 codes, sensor 1 % of its 20 A 41 codes:
             * 76, and room. 0.49 A. */
            .offset_max_cnt    = CURRENT_OFFSET_cnt,
            .dc_link_V_per_cnt = DC_LINK_SPAN_V / (float)BOARD_ADC_CODES, /* 0.11 V */
            .ntc_first_cnt     = NTC_FIRST_cnt,
            .ntc_step_cnt      = NTC_STEP_cnt,
            .ntc_points        = NTC_POINTS,
            .ntc_degC          = ntc_degC,
        },
    .angle =
        {
            .index_theta_e_rad =
                0.0f, /* encoder mounted with its mark at the d axis; measure it (docs/hardware.md) */
            /* The mark is up to one line = 4 counts wide and is entered from either side. */
            .index_tolerance_cnt = 4U,
            /* 0.126 rad electrical: costs 0.8 % of the torque, and is what the encoder form's own limit
             * of plausibility (trip_d_omega = 2.7e4 over its gain 1.04e9 times 200 us = 0.13 rad) lets pass. */
            .index_correct_max_cnt = 100U,
            /* The largest torque and a load as large change a count per period by 0.86 per period, the disc by 0.35. */
            .jump_cnt = 16U,
        },
    /* Half of the current limit: the hold 1.5 n_p (flux I - (Lq - Ld) I^2) is 0.69 N m/rad; its maximum, at 2.5 A, is
     * 0.72. 100 counts of error, which the first index still corrects, stand for 0.087 N m.
     * Watch: finds shafts that turn faster than 0.025 rad/s. Sweep: 2.6 rad/s electrical, 0.9 V of EMF over 10 Ohm turn
     * the vector by 3 degrees. Settle: the swing dies with 0.14 s (poles -7.2 +- j 62 1/s at k_p = 7.5 V/A, where it dies
     * fastest), from 3 to 0.2 degrees within 0.4 s; three times the inertia still fits. Quarter: a fifth of 1250. */
    .align =
        {
            .current_A         = 2.0f,
            .bandwidth_radps   = 100.0f, /* forty times the sweep, a fiftieth of the sampling */
            .watch_ticks       = 100U * TICKS_PER_ms,
            .ramp_ticks        = 300U * TICKS_PER_ms,
            .sweep_ticks       = 1200U * TICKS_PER_ms,
            .settle_ticks      = 1200U * TICKS_PER_ms,
            .still_ticks       = 100U * TICKS_PER_ms,
            .still_cnt         = 4U,
            .quarter_error_cnt = 250U,
        },
    .gate = /* isolated supplies; the drivers pass any pulse that is longer than the dead time */
    {
        .precharge_ticks         = 0U,
        .precharge_speed_e_radps = 0.0f,
        .duty_max_cnt            = BOARD_DUTY_FULL,
        .pulse_min_cnt           = 0U,
    },
    .stop = /* a commanded stop coasts; 20 rad/s electrical is 1.6 turns per second */
    {
        .reaction      = APP_STOP_COAST,
        .still_e_radps = 20.0f,
        .short_circuit = true,
    },
    .heat = /* peak of the phase current; motor: rated torque takes 2.33 A, a small frame's time constant is minutes, its
             * winding's half a minute; inverter: modules for twice the current limit, their bases take seconds. Chosen. */
    {
        .motor_A    = 2.6f,
        .motor_s    = 30.0f,
        .inverter_A = 5.0f,
        .inverter_s = 2.0f,
    },
    /* Twice what the sensor's 41 codes of offset are (0.2 A), a tenth of the current limit. */
    .zero_drift_A           = 0.4f,
    .temperature_limit_degC = 80.0f, /* chosen: heat sink of modules for 125 degC junction */
    .temperature_trip_degC  = 90.0f,
    .boot_ticks      = 50U * TICKS_PER_ms,  /* chosen: filters of the analog inputs (RC of 1 ms) */
    .calibrate_ticks = 256U * TICKS_PER_ms, /* 10 mA of noise: mean good to 0.3 mA */
    /* A pass of the background is below 1 ms (twice the CRC of the longest frame, 0.2 ms each). The watchdog resets
     * after 4.4 ms, so that the trip, with its record, comes first. */
    .background_ticks     = 3U * TICKS_PER_ms,
    .modbus_address       = 1U,
    .modbus_gap_ticks     = 10U, /* 1.75 ms at 115200 Bd by the protocol, rounded up, and one */
    .modbus_timeout_ticks = 500U * TICKS_PER_ms, /* chosen: five lost polls at 10 Hz */
};
