/* SPDX-License-Identifier: MIT */
#include "base.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_CONSTANT 1.4e-7 /* ratio; worst 2.8e-8, half a unit in the last place */

void setUp(void) {}
void tearDown(void) {}

static void test_clamp_matches_oracle_over_sweep(void)
{
    for (int step = -400; step <= 400; step++) {
        const float  x        = 0.01f * (float)step;
        const double expected = support_limit((double)x, -1.5, 2.25);

        const float y = base_clamp(x, -1.5f, 2.25f);

        TEST_ASSERT_TRUE((double)y == expected);
    }
}

static void test_clamp_keeps_a_number_on_either_limit(void)
{
    TEST_ASSERT_TRUE(base_clamp(-1.5f, -1.5f, 2.25f) == -1.5f);
    TEST_ASSERT_TRUE(base_clamp(2.25f, -1.5f, 2.25f) == 2.25f);
}

static void test_clamp_limits_the_next_number_beyond(void)
{
    TEST_ASSERT_TRUE(base_clamp(nextafterf(-1.5f, -9.0f), -1.5f, 2.25f) == -1.5f);
    TEST_ASSERT_TRUE(base_clamp(nextafterf(2.25f, 9.0f), -1.5f, 2.25f) == 2.25f);
}

static void test_clamp_to_a_single_value(void)
{
    for (int step = -3; step <= 3; step++) {
        TEST_ASSERT_TRUE(base_clamp((float)step, 1.0f, 1.0f) == 1.0f);
    }
}

static void test_clamp_limits_infinities(void)
{
    TEST_ASSERT_TRUE(base_clamp(INFINITY, -1.0f, 2.0f) == 2.0f);
    TEST_ASSERT_TRUE(base_clamp(-INFINITY, -1.0f, 2.0f) == -1.0f);
}

static void test_clamp_turns_nan_into_the_lower_limit(void)
{
    TEST_ASSERT_TRUE(base_clamp(NAN, -1.0f, 2.0f) == -1.0f);
    TEST_ASSERT_TRUE(base_clamp(-NAN, 1.0f, 2.0f) == 1.0f);
}

static void test_in_range_matches_oracle_over_sweep(void)
{
    for (int step = -400; step <= 400; step++) {
        const float x        = 0.01f * (float)step;
        const bool  expected = fabs((double)x - 0.375) <= 1.875; /* -1.5 .. 2.25 */

        TEST_ASSERT_TRUE(base_in_range(x, -1.5f, 2.25f) == expected);
    }
}

static void test_range_includes_its_limits_and_ends_there(void)
{
    TEST_ASSERT_TRUE(base_in_range(-1.5f, -1.5f, 2.25f));
    TEST_ASSERT_TRUE(base_in_range(2.25f, -1.5f, 2.25f));
    TEST_ASSERT_FALSE(base_in_range(nextafterf(-1.5f, -9.0f), -1.5f, 2.25f));
    TEST_ASSERT_FALSE(base_in_range(nextafterf(2.25f, 9.0f), -1.5f, 2.25f));
}

static void test_nothing_but_finite_numbers_is_in_range(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        TEST_ASSERT_FALSE(base_in_range(support_not_finite[i], -3.0e38f, 3.0e38f));
    }
}

static void test_nothing_is_in_a_range_without_limits(void)
{
    TEST_ASSERT_FALSE(base_in_range(0.0f, NAN, 1.0f));
    TEST_ASSERT_FALSE(base_in_range(0.0f, -1.0f, NAN));
}

static void test_nothing_is_in_a_reversed_range(void)
{
    TEST_ASSERT_FALSE(base_in_range(0.0f, 1.0f, -1.0f));
}

static void test_constants_are_the_nearest_floats(void)
{
    const double pi = acos(-1.0);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_CONSTANT, 1.0, (double)BASE_PI / pi);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_CONSTANT, 1.0, (double)BASE_TWO_PI / (2.0 * pi));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_CONSTANT, 1.0, (double)BASE_SQRT3 / sqrt(3.0));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_CONSTANT, 1.0, (double)BASE_1_SQRT3 * sqrt(3.0));
}

static void test_min_and_max_pick_one_of_the_two(void)
{
    for (int i = -20; i <= 20; i++) {
        for (int k = -20; k <= 20; k++) {
            const float a = 0.1f * (float)i;
            const float b = 0.1f * (float)k;

            TEST_ASSERT_TRUE((double)base_min(a, b) == fmin((double)a, (double)b));
            TEST_ASSERT_TRUE((double)base_max(a, b) == fmax((double)a, (double)b));
        }
    }
}

static void test_min_and_max_take_the_second_when_the_first_is_not_a_number(void)
{
    TEST_ASSERT_TRUE(base_min(NAN, 1.5f) == 1.5f);
    TEST_ASSERT_TRUE(base_max(NAN, -1.5f) == -1.5f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_clamp_matches_oracle_over_sweep);
    RUN_TEST(test_clamp_keeps_a_number_on_either_limit);
    RUN_TEST(test_clamp_limits_the_next_number_beyond);
    RUN_TEST(test_clamp_to_a_single_value);
    RUN_TEST(test_clamp_limits_infinities);
    RUN_TEST(test_clamp_turns_nan_into_the_lower_limit);
    RUN_TEST(test_in_range_matches_oracle_over_sweep);
    RUN_TEST(test_range_includes_its_limits_and_ends_there);
    RUN_TEST(test_nothing_but_finite_numbers_is_in_range);
    RUN_TEST(test_nothing_is_in_a_range_without_limits);
    RUN_TEST(test_nothing_is_in_a_reversed_range);
    RUN_TEST(test_min_and_max_pick_one_of_the_two);
    RUN_TEST(test_min_and_max_take_the_second_when_the_first_is_not_a_number);
    RUN_TEST(test_constants_are_the_nearest_floats);
    return UNITY_END();
}
