/* SPDX-License-Identifier: MIT */
#include "app_scale.h"

#include <string.h>

#include "board_config.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_A          2.0e-6 /* A, up to 10 A; worst 4e-7 */
#define TOL_V          2.0e-4 /* V, up to 450 V; worst 2e-5 */
#define TOL_NTC_degC   1.05   /* K, straight lines over the whole table; worst 1.00 */
#define TOL_WARM_degC  0.15   /* K, the same from 40 to 105 degC; worst 0.13 */
#define TOL_POINT_degC 0.006  /* K, points are written with two digits */

static app_scale_config_t config;
static app_scale_t        scale;
static board_sample_t     raw;

void setUp(void)
{
    const board_sample_t rest = {.ia_cnt          = 2048U,
                                 .ib_cnt          = 2048U,
                                 .dc_link_cnt     = 2685U,
                                 .temperature_cnt = 3357U,
                                 .valid           = true};
    raw                       = rest;
    config                    = board_config.scale;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_scale_init(&scale, &config, board_config.board.positions,
                                                 gain_tables_drive.trip_current_A));
}

void tearDown(void) {}

static ctl_status_t init(void)
{
    return app_scale_init(&scale, &config, board_config.board.positions, 8.0f);
}

static app_scale_sample_t converted(void)
{
    app_scale_sample_t sample;

    (void)memset(&sample, 0xFF, sizeof sample); /* every member has to be set */
    app_scale_sample(&scale, &raw, &sample);
    app_scale_temperature(&scale, &raw, &sample);
    return sample;
}

/* The converter of the simulation, EQ-ADC-1: two's complement code of a current, as an offset binary code. */
static void test_currents_match_the_simulated_converter_over_all_codes(void)
{
    for (int code = 0; code < 4096; code++) {
        raw.ia_cnt = (uint16_t)code;
        raw.ib_cnt = (uint16_t)(4095 - code);

        const app_scale_sample_t s = converted();

        TEST_ASSERT_TRUE(s.valid);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, ldexp(10.0, -11) * (code - 2048), (double)s.ia_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, ldexp(10.0, -11) * (2047 - code), (double)s.ib_A);
    }
}

static void test_dc_link_is_proportional_to_its_code(void)
{
    for (int code = 0; code < 4096; code++) {
        raw.dc_link_cnt = (uint16_t)code;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 450.0 * code / 4096.0, (double)converted().dc_link_V);
    }
}

static void test_the_shipped_scaling_covers_what_the_drive_accepts(void)
{
    raw.dc_link_cnt = 4095U;
    TEST_ASSERT_TRUE(converted().dc_link_V > gain_tables_drive.dc_link_max_V);
}

/* Oracle: divider and exponential curve of the sensor, solved for the temperature. */
static double ntc_oracle_degC(double code)
{
    const double r_Ohm = 2200.0 * code / (4096.0 - code);
    return (1.0 / ((1.0 / 298.15) + (log(r_Ohm / 10000.0) / 3435.0))) - 273.15;
}

static void test_temperature_matches_the_sensor_curve(void)
{
    for (int code = 512; code < 3968; code++) {
        raw.temperature_cnt = (uint16_t)code;

        const app_scale_sample_t s    = converted();
        const double             want = ntc_oracle_degC((double)code);
        const bool               warm = (want > 40.0) && (want < 105.0);

        TEST_ASSERT_TRUE(s.valid && s.temperature_valid);
        TEST_ASSERT_DOUBLE_WITHIN(warm ? TOL_WARM_degC : TOL_NTC_degC, want,
                                  (double)s.temperature_degC);
        if (((code - 512) % 128) == 0) {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_POINT_degC, want, (double)s.temperature_degC);
        }
    }
}

static void test_codes_of_a_broken_or_shorted_sensor_are_no_temperature(void)
{
    static const int broken[] = {0, 1, 511, 3968, 3969, 4000, 4094, 4095};
    for (int i = 0; i < SUPPORT_COUNT(broken); i++) {
        raw.temperature_cnt        = (uint16_t)broken[i];
        const app_scale_sample_t s = converted();
        TEST_ASSERT_TRUE(s.valid);
        TEST_ASSERT_FALSE(s.temperature_valid);
        TEST_ASSERT_TRUE(s.temperature_degC == 0.0f);
    }
}

static void assert_refused(void)
{
    const app_scale_sample_t s = converted();
    TEST_ASSERT_FALSE(s.valid);
    TEST_ASSERT_FALSE(s.temperature_valid);
    TEST_ASSERT_TRUE((s.ia_A == 0.0f) && (s.ib_A == 0.0f) && (s.dc_link_V == 0.0f));
}

static void test_sample_marked_invalid_is_refused(void)
{
    raw.valid = false;
    assert_refused();
}

static void test_code_or_position_out_of_range_is_refused(void)
{
    uint16_t *const fields[] = {&raw.ia_cnt, &raw.ib_cnt, &raw.dc_link_cnt, &raw.temperature_cnt,
                                &raw.position_cnt};
    for (int i = 0; i < SUPPORT_COUNT(fields); i++) {
        setUp();
        const uint16_t first_bad = (fields[i] == &raw.position_cnt) ? 10000U : 4096U;
        *fields[i]               = first_bad;
        assert_refused();
        *fields[i] = 65535U;
        assert_refused();
        *fields[i] = (uint16_t)(first_bad - 1U);
        TEST_ASSERT_TRUE(converted().valid);
    }
}

static void test_index_position_counts_only_with_its_pulse(void)
{
    raw.index_cnt = 10000U;
    TEST_ASSERT_TRUE(converted().valid);
    raw.index_seen = true;
    assert_refused();
}

static void test_measured_zero_takes_the_place_of_the_nominal_one(void)
{
    TEST_ASSERT_TRUE(app_scale_set_zero(&scale, 1280UL * 2100UL + 320UL, 1280UL * 2000UL, 1280U));
    raw.ia_cnt = 2100U;
    raw.ib_cnt = 2010U;

    const app_scale_sample_t s = converted();

    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, -0.25 * 20.0 / 4096.0, (double)s.ia_A);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 10.0 * 20.0 / 4096.0, (double)s.ib_A);
}

static void test_zero_beyond_its_bound_is_refused_and_changes_nothing(void)
{
    static const uint32_t off[][2] = {{1947UL, 2048UL}, {2149UL, 2048UL}, {2048UL, 1947UL},
                                      {2048UL, 2149UL}, {0UL, 0UL},       {4095UL, 2048UL}};
    for (int i = 0; i < SUPPORT_COUNT(off); i++) {
        TEST_ASSERT_FALSE(app_scale_set_zero(&scale, 64UL * off[i][0], 64UL * off[i][1], 64U));
        TEST_ASSERT_TRUE(converted().ia_A == 0.0f);
        TEST_ASSERT_TRUE(converted().ib_A == 0.0f);
    }
    TEST_ASSERT_TRUE(app_scale_set_zero(&scale, 64UL * 1948UL, 64UL * 2148UL, 64U));
    TEST_ASSERT_FALSE(app_scale_set_zero(&scale, 0UL, 0UL, 0U));
}

static void test_every_constant_out_of_range_is_refused(void)
{
    float *const fields[] = {&config.current_A_per_cnt, &config.current_zero_cnt,
                             &config.offset_max_cnt, &config.dc_link_V_per_cnt};
    for (int i = 0; i < SUPPORT_COUNT(fields); i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            setUp();
            *fields[i] = support_not_finite[k];
            TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
        }
        setUp();
        *fields[i] = -1.0f;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    }
}

/* 8 A are 1638 codes: with 2047 above the zero, 409 may be offset. */
static void test_trip_current_that_the_converter_cannot_show_is_refused(void)
{
    config.offset_max_cnt = 408.0f;
    TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    config.offset_max_cnt = 409.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.current_zero_cnt = 1700.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.current_zero_cnt = 2395.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.current_A_per_cnt = 0.00390625f; /* 8 A are exactly 2048 codes */
    config.offset_max_cnt    = 0.5f;
    TEST_ASSERT_EQUAL_INT(
        CTL_BAD_CONFIG,
        app_scale_init(&scale, &config, board_config.board.positions, 2046.5f / 256.0f));
    TEST_ASSERT_EQUAL_INT(
        CTL_OK, app_scale_init(&scale, &config, board_config.board.positions, 2046.4f / 256.0f));
}

static void test_table_that_is_no_curve_is_refused(void)
{
    float table[28];
    for (int i = 0; i < 28; i++) {
        table[i] = config.ntc_degC[i];
    }
    config.ntc_degC = table;
    TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    table[5] = table[4];
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    table[5] = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.ntc_points = 2U;
    TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    table[1] = table[0];
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    table[0] = 301.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());

    setUp();
    config.ntc_degC = NULL;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.ntc_points = 1U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.ntc_step_cnt = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.ntc_first_cnt = 640U; /* the last point at 4096 */
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_match_the_simulated_converter_over_all_codes);
    RUN_TEST(test_dc_link_is_proportional_to_its_code);
    RUN_TEST(test_the_shipped_scaling_covers_what_the_drive_accepts);
    RUN_TEST(test_temperature_matches_the_sensor_curve);
    RUN_TEST(test_codes_of_a_broken_or_shorted_sensor_are_no_temperature);
    RUN_TEST(test_sample_marked_invalid_is_refused);
    RUN_TEST(test_code_or_position_out_of_range_is_refused);
    RUN_TEST(test_index_position_counts_only_with_its_pulse);
    RUN_TEST(test_measured_zero_takes_the_place_of_the_nominal_one);
    RUN_TEST(test_zero_beyond_its_bound_is_refused_and_changes_nothing);
    RUN_TEST(test_every_constant_out_of_range_is_refused);
    RUN_TEST(test_trip_current_that_the_converter_cannot_show_is_refused);
    RUN_TEST(test_table_that_is_no_curve_is_refused);
    return UNITY_END();
}
