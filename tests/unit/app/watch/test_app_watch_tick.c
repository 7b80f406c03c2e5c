/* SPDX-License-Identifier: MIT */
#include "app_watch_tick.h"

#include "board.h"
#include "unity.h"

#define PERIOD  30000U
#define LONGEST 75000U /* two and a half periods: 0.5 ms */

static app_watch_tick_t watch;

void setUp(void)
{
    app_watch_tick_reset(&watch);
}

void tearDown(void) {}

static void test_nothing_is_missing_before_the_first_tick(void)
{
    TEST_ASSERT_FALSE(app_watch_tick_is_missing(&watch, PERIOD, 0U, 0U));
    TEST_ASSERT_FALSE(app_watch_tick_is_missing(&watch, PERIOD, 0U, 100U * PERIOD));
}

static void test_ticks_that_come_are_not_missing(void)
{
    for (uint32_t n = 1U; n < 1000U; n++) {
        TEST_ASSERT_FALSE(app_watch_tick_is_missing(&watch, PERIOD, n, n * PERIOD));
        TEST_ASSERT_FALSE(app_watch_tick_is_missing(&watch, PERIOD, n, (n * PERIOD) + PERIOD - 1U));
    }
}

static void test_a_tick_that_does_not_come_is_missing_after_half_a_millisecond(void)
{
    (void)app_watch_tick_is_missing(&watch, PERIOD, 7U, 1000U);
    TEST_ASSERT_FALSE(app_watch_tick_is_missing(&watch, PERIOD, 7U, 1000U + LONGEST));
    TEST_ASSERT_TRUE(app_watch_tick_is_missing(&watch, PERIOD, 7U, 1000U + LONGEST + 1U));
    TEST_ASSERT_FALSE(app_watch_tick_is_missing(&watch, PERIOD, 8U, 1000U + LONGEST + 2U));
}

static void test_the_cycle_counter_may_wrap(void)
{
    (void)app_watch_tick_is_missing(&watch, PERIOD, 1U, 0xFFFFFFF0U);
    TEST_ASSERT_FALSE(app_watch_tick_is_missing(&watch, PERIOD, 1U, LONGEST - 16U));
    TEST_ASSERT_TRUE(app_watch_tick_is_missing(&watch, PERIOD, 1U, LONGEST - 15U));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_missing_before_the_first_tick);
    RUN_TEST(test_ticks_that_come_are_not_missing);
    RUN_TEST(test_a_tick_that_does_not_come_is_missing_after_half_a_millisecond);
    RUN_TEST(test_the_cycle_counter_may_wrap);
    return UNITY_END();
}
