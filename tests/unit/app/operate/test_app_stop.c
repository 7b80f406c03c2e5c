/* SPDX-License-Identifier: MIT */
#include "app_stop.h"

#include <stdlib.h>

#include "board_config.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

static app_stop_config_t config;
static app_stop_t        stop;

void setUp(void)
{
    config = board_config.stop;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_stop_init(&stop, &config, &gain_tables_drive));
}

void tearDown(void) {}

/* EQ-APP-STOP-1: 1.35 * 295 V / (sqrt(3) 0.193 V s). */
static void test_speed_limit_is_that_of_the_emf(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 1.35 * 295.0 / (sqrt(3.0) * 0.193), (double)stop.link_e_radps);
}

static void test_without_a_magnet_no_speed_charges_the_dc_link(void)
{
    drive_config_t drive = gain_tables_drive;
    drive.motor.l5       = 0.0f;

    TEST_ASSERT_EQUAL_INT(CTL_OK, app_stop_init(&stop, &config, &drive));
    TEST_ASSERT_FALSE(app_stop_is_braking(&stop, 1.0e6f));
    drive.motor.l5 = -1.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_stop_init(&stop, &config, &drive));
    drive.motor.l5 = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_stop_init(&stop, &config, &drive));
}

static void test_coasting_brakes_down_to_the_limit_and_a_ramp_to_standstill(void)
{
    for (int w = -1500; w <= 1500; w++) {
        stop.config     = &config;
        config.reaction = APP_STOP_COAST;
        TEST_ASSERT_TRUE(app_stop_is_braking(&stop, (float)w) == (abs(w) > 1191));
        config.reaction = APP_STOP_RAMP;
        TEST_ASSERT_TRUE(app_stop_is_braking(&stop, (float)w) == (abs(w) > 20));
    }
}

static bridge_t tick_at(float omega_e_radps)
{
    const app_stop_input_t in = {
        .omega_e_radps = omega_e_radps, .speed_known = true, .valid = true};
    return app_stop_bridge(&stop, &in);
}

/* A dead encoder reads zero. */
static void test_short_of_unknown_speed_ends_by_over_current_only(void)
{
    app_stop_input_t in = {.omega_e_radps = 0.0f, .speed_known = false, .valid = true};

    app_stop_fault(&stop, 1200.0f, DRIVE_FAULT_ENCODER, 0U);
    TEST_ASSERT_TRUE(app_stop_bridge(&stop, &in).gate_enable);
    in.ia_A = 2.0f * stop.trip_current_A;
    TEST_ASSERT_FALSE(app_stop_bridge(&stop, &in).gate_enable);
    in.ia_A = 0.0f;
    TEST_ASSERT_FALSE(app_stop_bridge(&stop, &in).gate_enable);
}

static void test_short_begins_above_the_limit_and_ends_at_four_fifths(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        app_stop_fault(&stop, (float)sign * 1191.0f, DRIVE_FAULT_NONE, 0U);
        TEST_ASSERT_FALSE(stop.shorted);
        app_stop_fault(&stop, (float)sign * 1192.0f, DRIVE_FAULT_NONE, 0U);
        TEST_ASSERT_TRUE(stop.shorted);
        TEST_ASSERT_TRUE(tick_at((float)sign * 954.0f).gate_enable);
        TEST_ASSERT_FALSE(tick_at((float)sign * 952.0f).gate_enable);
        TEST_ASSERT_FALSE(tick_at((float)sign * 1192.0f).gate_enable);
    }
}

static void test_speed_that_is_no_number_counts_as_fast(void)
{
    app_stop_fault(&stop, NAN, DRIVE_FAULT_NONE, 0U);
    TEST_ASSERT_TRUE(stop.shorted);
    TEST_ASSERT_TRUE(tick_at(NAN).gate_enable);
}

static void test_constants_out_of_range_are_refused(void)
{
    config.still_e_radps = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_stop_init(&stop, &config, &gain_tables_drive));
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        config.still_e_radps = support_not_finite[k];
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_stop_init(&stop, &config, &gain_tables_drive));
    }
    setUp();
    config.reaction = (app_stop_reaction_t)2;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_stop_init(&stop, &config, &gain_tables_drive));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_speed_limit_is_that_of_the_emf);
    RUN_TEST(test_without_a_magnet_no_speed_charges_the_dc_link);
    RUN_TEST(test_coasting_brakes_down_to_the_limit_and_a_ramp_to_standstill);
    RUN_TEST(test_short_begins_above_the_limit_and_ends_at_four_fifths);
    RUN_TEST(test_short_of_unknown_speed_ends_by_over_current_only);
    RUN_TEST(test_speed_that_is_no_number_counts_as_fast);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
