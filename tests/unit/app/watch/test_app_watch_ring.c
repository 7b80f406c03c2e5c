/* SPDX-License-Identifier: MIT */
#include "app_watch_ring.h"

#include "unit_support.h"
#include "unity.h"

#define PI     3.14159265358979324
#define TS_s   2.0e-4
#define MOST_A 4.0f

static app_watch_ring_t watch;
static support_random_t random_state;
static uint32_t         ticks;

void setUp(void)
{
    random_state.state = 3u;
    ticks              = 4294966000u; /* wraps within a second */
    app_watch_ring_reset(&watch);
}

void tearDown(void) {}

/* A current of 1.3 A and an oscillation; the background sees every `each`-th tick. @return seconds until the report, -1: none. */
static double heard(double hz, double amplitude_A, double noise_A, double time_s, uint32_t each)
{
    double at_s = -1.0;
    for (uint32_t k = 0u; (double)k * TS_s < time_s; k += each) {
        const double t = (double)k * TS_s;
        const double x = amplitude_A * sin(2.0 * PI * hz * t);
        const double n = noise_A * (double)support_uniform(&random_state, -1.0f, 1.0f);
        const app_watch_ring_seen_t seen = {ticks, true, (float)(1.3 + x + n)};
        app_watch_ring_see(&watch, &seen, MOST_A, (float)TS_s);
        ticks += each;
        if (watch.rings && (at_s < 0.0)) {
            at_s = t;
        }
    }
    return at_s;
}

static void test_an_oscillation_is_reported_with_its_frequency(void)
{
    static const double hz[] = {42.0, 60.0, 120.0, 222.0, 400.0, 590.0};
    for (int k = 0; k < SUPPORT_COUNT(hz); k++) {
        setUp();
        const double at_s = heard(hz[k], 0.4, 0.08, 0.7, 1u); /* 0.1 of the largest */
        TEST_ASSERT_TRUE((at_s > 0.29) && (at_s < 0.5));
        TEST_ASSERT_DOUBLE_WITHIN(0.06 * hz[k], hz[k], watch.hz);
    }
    setUp();
    TEST_ASSERT_TRUE(heard(120.0, 0.32, 0.0, 0.7, 3u) > 0.3);
    TEST_ASSERT_DOUBLE_WITHIN(8.0, 120.0, watch.hz);
}

static void test_what_is_small_slow_or_noise_is_not(void)
{
    TEST_ASSERT_TRUE(heard(120.0, 0.19, 0.0, 2.0, 1u) < 0.0);
    setUp();
    TEST_ASSERT_TRUE(heard(30.0, 1.0, 0.0, 2.0, 1u) < 0.0);
    setUp();
    TEST_ASSERT_TRUE(heard(800.0, 1.0, 0.0, 2.0, 1u) < 0.0);
    setUp();
    TEST_ASSERT_TRUE(heard(120.0, 0.0, 1.0, 5.0, 1u) < 0.0);
    TEST_ASSERT_TRUE(watch.hz == 0.0f);
}

/* The bit stays for two seconds, the frequency until the next one; a run that ends begins anew. */
static void test_the_report_ends_and_the_frequency_stays(void)
{
    TEST_ASSERT_TRUE(heard(120.0, 0.4, 0.0, 0.5, 1u) > 0.0);
    TEST_ASSERT_TRUE(heard(120.0, 0.0, 0.0, 1.8, 1u) > -0.5);
    TEST_ASSERT_TRUE(watch.rings);
    (void)heard(120.0, 0.0, 0.0, 0.5, 1u);
    TEST_ASSERT_FALSE(watch.rings);
    TEST_ASSERT_DOUBLE_WITHIN(5.0, 120.0, watch.hz);
}

static void test_each_run_begins_anew(void)
{
    for (int k = 0; k < 10; k++) {
        const app_watch_ring_seen_t off = {ticks, false, 0.0f};
        TEST_ASSERT_TRUE(heard(120.0, 0.4, 0.0, 0.2, 1u) < 0.0);
        app_watch_ring_see(&watch, &off, MOST_A, (float)TS_s);
    }
}

static void test_what_is_no_number_is_no_oscillation(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        setUp();
        for (int i = 0; i < 3000; i++) {
            const app_watch_ring_seen_t seen = {ticks, true,
                                                ((i / 20) % 2 == 0) ? support_not_finite[k] : 0.0f};
            app_watch_ring_see(&watch, &seen, MOST_A, (float)TS_s);
            ticks++;
        }
        TEST_ASSERT_FALSE(watch.rings);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_oscillation_is_reported_with_its_frequency);
    RUN_TEST(test_what_is_small_slow_or_noise_is_not);
    RUN_TEST(test_the_report_ends_and_the_frequency_stays);
    RUN_TEST(test_each_run_begins_anew);
    RUN_TEST(test_what_is_no_number_is_no_oscillation);
    return UNITY_END();
}
