/* SPDX-License-Identifier: MIT */
#include "app_gate.h"

#include "board_config.h"
#include "unit_support.h"
#include "unity.h"

static app_gate_config_t config;

void setUp(void)
{
    config = board_config.gate;
}

void tearDown(void) {}

static board_duty_t duty_of(double ratio)
{
    const abc_t duty = {.a = (float)ratio, .b = (float)(1.0 - ratio), .c = 0.5f};
    return app_gate_duty(&config, board_config.board.duty_full_cnt, duty);
}

static void test_duty_becomes_the_nearest_compare_value(void)
{
    for (int n = 0; n <= 30000; n++) {
        const double       ratio = (double)n / 30000.0;
        const board_duty_t got   = duty_of(ratio);
        TEST_ASSERT_DOUBLE_WITHIN(0.501, 7500.0 * ratio, (double)got.a_cnt);
        TEST_ASSERT_DOUBLE_WITHIN(0.501, 7500.0 * (1.0 - ratio), (double)got.b_cnt);
        TEST_ASSERT_EQUAL_UINT(3750U, got.c_cnt);
    }
}

/* Every value that comes out is one that the driver passes, and no other such value is nearer. */
static void test_pulses_that_are_too_short_go_to_the_nearest_that_is_not(void)
{
    config.pulse_min_cnt = 300U;
    for (int n = 0; n <= 7500; n++) {
        const board_duty_t got     = duty_of((double)n / 7500.0);
        int                nearest = -1;
        for (int out = 0; out <= 7500; out++) {
            const bool passes = (out == 0) || (out == 7500) || ((out >= 300) && (out <= 7200));
            const int  off    = (out > n) ? (out - n) : (n - out);
            const int  best   = (nearest > n) ? (nearest - n) : (n - nearest);
            if (passes && ((nearest < 0) || (off < best))) {
                nearest = out;
            }
        }
        if ((n != 150) && (n != 7350)) { /* in the middle of two */
            TEST_ASSERT_EQUAL_INT(nearest, (int)got.a_cnt);
        }
    }
}

static void test_bootstrap_supplies_get_a_largest_duty(void)
{
    config.duty_max_cnt  = 7200U;
    config.pulse_min_cnt = 100U;
    for (int n = 0; n <= 7500; n++) {
        TEST_ASSERT_TRUE(duty_of((double)n / 7500.0).a_cnt <= 7200U);
    }
    TEST_ASSERT_EQUAL_UINT(7200U, duty_of(1.0).a_cnt);
    TEST_ASSERT_EQUAL_UINT(7199U, duty_of(7199.0 / 7500.0).a_cnt);
}

static void test_a_precharge_bounds_the_speed_of_a_start(void)
{
    TEST_ASSERT_TRUE(app_gate_may_start(&config, 1.0e4f));
    config.precharge_ticks         = 10U;
    config.precharge_speed_e_radps = 200.0f;
    TEST_ASSERT_TRUE(app_gate_may_start(&config, -199.0f));
    TEST_ASSERT_FALSE(app_gate_may_start(&config, 201.0f));
    TEST_ASSERT_FALSE(app_gate_may_start(&config, -201.0f));
}

static void test_constants_out_of_range_are_refused(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_gate_check(&config, board_config.board.duty_full_cnt));
    config.duty_max_cnt = 7501U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                          app_gate_check(&config, board_config.board.duty_full_cnt));
    config.duty_max_cnt = 3749U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                          app_gate_check(&config, board_config.board.duty_full_cnt));
    setUp();
    config.pulse_min_cnt = 1876U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                          app_gate_check(&config, board_config.board.duty_full_cnt));
    setUp();
    config.precharge_ticks = 1U; /* and no speed that it allows */
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                          app_gate_check(&config, board_config.board.duty_full_cnt));
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        config.precharge_speed_e_radps = support_not_finite[k];
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                              app_gate_check(&config, board_config.board.duty_full_cnt));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_duty_becomes_the_nearest_compare_value);
    RUN_TEST(test_pulses_that_are_too_short_go_to_the_nearest_that_is_not);
    RUN_TEST(test_bootstrap_supplies_get_a_largest_duty);
    RUN_TEST(test_a_precharge_bounds_the_speed_of_a_start);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
