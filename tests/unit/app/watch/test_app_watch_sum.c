/* SPDX-License-Identifier: MIT */
#include "app_watch_sum.h"

#include "unity.h"

#define NOMINAL 2048.0f
#define MOST    100.0f

static app_watch_sum_t watch;
static board_sample_t  raw;

static void read_cnt(uint16_t a, uint16_t b, uint16_t c)
{
    raw.ia_cnt = a;
    raw.ib_cnt = b;
    raw.ic_cnt = c;
}

static bool calibrated(uint16_t count)
{
    app_watch_sum_begin(&watch);
    for (uint16_t n = 0U; n < count; n++) {
        app_watch_sum_add(&watch, &raw);
    }
    return app_watch_sum_set_zero(&watch, count, NOMINAL, MOST);
}

void setUp(void)
{
    app_watch_sum_init(&watch, 3U);
    read_cnt(2048U, 2048U, 2048U);
    TEST_ASSERT_TRUE(calibrated(64U));
}

void tearDown(void) {}

/* 4 % of 4096 codes are 163.84; three samples in a row. */
static void test_the_third_sample_beyond_the_bound_differs(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        read_cnt(2248U, 1948U, (uint16_t)(1948 + (sign * 163)));
        for (int n = 0; n < 10; n++) {
            TEST_ASSERT_FALSE(app_watch_sum_differs(&watch, &raw));
        }
        read_cnt(2248U, 1948U, (uint16_t)(1948 + (sign * 164)));
        TEST_ASSERT_FALSE(app_watch_sum_differs(&watch, &raw));
        TEST_ASSERT_FALSE(app_watch_sum_differs(&watch, &raw));
        TEST_ASSERT_TRUE(app_watch_sum_differs(&watch, &raw));
        TEST_ASSERT_TRUE(app_watch_sum_differs(&watch, &raw));
        read_cnt(2048U, 2048U, 2048U);
        TEST_ASSERT_FALSE(app_watch_sum_differs(&watch, &raw));
    }
}

static void test_each_of_the_three_counts(void)
{
    uint16_t *const codes[] = {&raw.ia_cnt, &raw.ib_cnt, &raw.ic_cnt};

    for (int n = 0; n < 3; n++) {
        setUp();
        *codes[n] = 3000U;
        (void)app_watch_sum_differs(&watch, &raw);
        (void)app_watch_sum_differs(&watch, &raw);
        TEST_ASSERT_TRUE(app_watch_sum_differs(&watch, &raw));
    }
}

static void test_samples_have_to_follow_one_another(void)
{
    for (int n = 0; n < 20; n++) {
        read_cnt(2048U, 2048U, ((n % 3) == 2) ? 2048U : 4095U);
        TEST_ASSERT_FALSE(app_watch_sum_differs(&watch, &raw));
    }
}

static void test_the_zero_is_the_mean_of_a_calibration(void)
{
    read_cnt(2148U, 2148U, 2147U);
    TEST_ASSERT_TRUE(calibrated(1280U));
    TEST_ASSERT_EQUAL_FLOAT(6443.0f, watch.zero_cnt);
    TEST_ASSERT_FALSE(app_watch_sum_differs(&watch, &raw));
    read_cnt(2148U, 2148U, 2149U);
    TEST_ASSERT_FALSE(calibrated(64U));
    read_cnt(1947U, 1948U, 1948U);
    TEST_ASSERT_FALSE(calibrated(64U));
    TEST_ASSERT_FALSE(calibrated(0U));
}

/* Largest sum: 65535 samples of full scale. */
static void test_a_calibration_does_not_wrap(void)
{
    read_cnt(4095U, 4095U, 4095U);
    app_watch_sum_begin(&watch);
    for (uint32_t n = 0UL; n < 65535UL; n++) {
        app_watch_sum_add(&watch, &raw);
    }
    TEST_ASSERT_TRUE(app_watch_sum_set_zero(&watch, 65535U, 4095.0f, MOST));
    TEST_ASSERT_EQUAL_FLOAT(12285.0f, watch.zero_cnt);
}

static void test_two_sensors_have_no_sum(void)
{
    app_watch_sum_init(&watch, 2U);
    read_cnt(0U, 4095U, 0U);
    TEST_ASSERT_TRUE(calibrated(64U));
    for (int n = 0; n < 10; n++) {
        TEST_ASSERT_FALSE(app_watch_sum_differs(&watch, &raw));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_third_sample_beyond_the_bound_differs);
    RUN_TEST(test_each_of_the_three_counts);
    RUN_TEST(test_samples_have_to_follow_one_another);
    RUN_TEST(test_the_zero_is_the_mean_of_a_calibration);
    RUN_TEST(test_a_calibration_does_not_wrap);
    RUN_TEST(test_two_sensors_have_no_sum);
    return UNITY_END();
}
