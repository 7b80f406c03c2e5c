/* SPDX-License-Identifier: MIT */
#include "app_config_check.h"

#include <math.h>
#include <stdio.h>

#include "app.h"
#include "board_config.h"
#include "fake_board.h"
#include "gain_tables.h"
#include "unity.h"

static app_config_t   config;
static drive_config_t drive;

void setUp(void)
{
    fake_board_reset();
    config = board_config;
    drive  = gain_tables_drive;
}

void tearDown(void) {}

/* Floats that one constant each refuses. */
static float *const floats[] = {&config.pwm_period_s,
                                &config.dead_time_s,
                                &config.scale.current_A_per_cnt,
                                &config.scale.current_zero_cnt,
                                &config.scale.offset_max_cnt,
                                &config.scale.dc_link_V_per_cnt,
                                &config.angle.index_theta_e_rad,
                                &config.align.current_A,
                                &config.align.bandwidth_radps,
                                &config.align.theta_e_rad,
                                &config.stop.still_e_radps,
                                &config.heat.motor_A,
                                &config.heat.motor_s,
                                &config.heat.inverter_A,
                                &config.heat.inverter_s,
                                &config.zero_drift_A,
                                &config.temperature_limit_degC,
                                &config.temperature_trip_degC,
                                &drive.ts_s,
                                &drive.current_max_A,
                                &drive.trip_current_A,
                                &drive.dc_link_max_V,
                                &drive.motor.l5};

static uint16_t *const counts[] = {
    &config.calibrate_ticks,   &config.background_ticks,     &config.modbus_address,
    &config.modbus_gap_ticks,  &config.modbus_timeout_ticks, &config.angle.jump_cnt,
    &config.gate.duty_max_cnt, &config.scale.ntc_points,     &drive.hardware.pole_pairs};

static uint32_t *const times[] = {&config.align.watch_ticks, &config.align.ramp_ticks,
                                  &config.align.sweep_ticks, &config.align.settle_ticks,
                                  &config.align.still_ticks};

static void assert_refused(const char *which, size_t i)
{
    char text[40];

    (void)snprintf(text, sizeof text, "%s %u", which, (unsigned)i);
    TEST_ASSERT_EQUAL_INT_MESSAGE(CTL_BAD_CONFIG, app_config_check(&config, &drive), text);
    TEST_ASSERT_EQUAL_INT_MESSAGE(CTL_BAD_CONFIG, app_init(&config, &drive), text);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, app_status_read().mode);
    setUp();
}

static void test_the_shipped_constants_are_taken(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_config_check(&config, &drive));
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &drive));
}

static void test_each_bad_constant_is_refused_here_and_by_the_application(void)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, -1.0e9f};

    for (size_t i = 0U; i < (sizeof floats / sizeof floats[0]); i++) {
        for (size_t k = 0U; k < (sizeof bad / sizeof bad[0]); k++) {
            *floats[i] = bad[k];
            assert_refused("float", i);
        }
    }
    for (size_t i = 0U; i < (sizeof counts / sizeof counts[0]); i++) {
        *counts[i] = 0U;
        assert_refused("count", i);
    }
    for (size_t i = 0U; i < (sizeof times / sizeof times[0]); i++) {
        *times[i] = 0UL;
        assert_refused("time", i);
        *times[i] = 0x80000001UL; /* twice of it is 2 in 32 bits */
        assert_refused("long time", i);
    }
    config.modbus_address = 248U;
    assert_refused("address", 248U);
    config.scale.ntc_degC = NULL;
    assert_refused("table", 0U);
    drive.law = NULL;
    assert_refused("law", 0U);
}

static void test_the_largest_times_are_taken(void)
{
    config.align.settle_ticks = 1000000000UL;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_config_check(&config, &drive));
    config.align.settle_ticks = 1000000001UL;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_config_check(&config, &drive));
}

static void test_a_check_leaves_the_application_alone(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &drive));
    for (int n = 0; n < 3; n++) {
        app_tick();
    }
    const app_status_t before      = app_status_read();
    app_config_t       other       = config;
    drive_config_t     other_motor = drive;

    other.modbus_address           = 0U;
    other_motor.trip_speed_e_radps = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_config_check(&other, &other_motor));
    const app_status_t after = app_status_read();
    TEST_ASSERT_EQUAL_INT(before.mode, after.mode);
    TEST_ASSERT_EQUAL_UINT32(before.ticks, after.ticks);
    TEST_ASSERT_TRUE(after.ticks > 0UL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_shipped_constants_are_taken);
    RUN_TEST(test_each_bad_constant_is_refused_here_and_by_the_application);
    RUN_TEST(test_the_largest_times_are_taken);
    RUN_TEST(test_a_check_leaves_the_application_alone);
    return UNITY_END();
}
