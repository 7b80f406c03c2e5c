/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "unit_support.h"
#include "unity.h"

#define SMALLEST 1.0e-12f

void setUp(void) {}
void tearDown(void) {}

static float above(float x)
{
    return nextafterf(x, INFINITY);
}

static float below(float x)
{
    return nextafterf(x, -INFINITY);
}

static void test_largest_is_far_from_overflow(void)
{
    TEST_ASSERT_TRUE(CHECK_LARGEST == 1.0e12f);
    TEST_ASSERT_TRUE(isfinite(CHECK_LARGEST * CHECK_LARGEST * CHECK_LARGEST));
}

static void test_positive_begins_above_zero_and_ends_at_the_largest(void)
{
    TEST_ASSERT_TRUE(check_positive(SMALLEST));
    TEST_ASSERT_TRUE(check_positive(1.0f));
    TEST_ASSERT_TRUE(check_positive(CHECK_LARGEST));

    TEST_ASSERT_FALSE(check_positive(below(SMALLEST)));
    TEST_ASSERT_FALSE(check_positive(0.0f));
    TEST_ASSERT_FALSE(check_positive(-1.0f));
    TEST_ASSERT_FALSE(check_positive(above(CHECK_LARGEST)));
}

static void test_not_negative_begins_at_zero_and_ends_at_the_largest(void)
{
    TEST_ASSERT_TRUE(check_not_negative(0.0f));
    TEST_ASSERT_TRUE(check_not_negative(-0.0f));
    TEST_ASSERT_TRUE(check_not_negative(CHECK_LARGEST));

    TEST_ASSERT_FALSE(check_not_negative(below(0.0f)));
    TEST_ASSERT_FALSE(check_not_negative(-1.0f));
    TEST_ASSERT_FALSE(check_not_negative(above(CHECK_LARGEST)));
}

static void test_single_numbers_that_are_not_finite_are_refused(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        TEST_ASSERT_FALSE(check_positive(support_not_finite[k]));
        TEST_ASSERT_FALSE(check_not_negative(support_not_finite[k]));
    }
}

static void test_every_number_of_a_list_counts(void)
{
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            float x[] = {1.0f, -2.0f, 0.0f, CHECK_LARGEST, -CHECK_LARGEST};
            TEST_ASSERT_TRUE(check_finite(x, 5));

            x[i] = support_not_finite[k];

            TEST_ASSERT_FALSE(check_finite(x, 5));
            TEST_ASSERT_TRUE(check_finite(x, (int16_t)i)); /* up to there */
            TEST_ASSERT_FALSE(check_finite(x, (int16_t)(i + 1)));
        }
    }
}

static void test_list_ends_at_the_largest_on_both_sides(void)
{
    const float too_large = above(CHECK_LARGEST);
    const float too_small = -too_large;

    TEST_ASSERT_FALSE(check_finite(&too_large, 1));
    TEST_ASSERT_FALSE(check_finite(&too_small, 1));
}

static void test_empty_list_and_table_are_in_order(void)
{
    const float bad[1][CHECK_COLUMNS] = {{NAN, NAN, NAN}};

    TEST_ASSERT_TRUE(check_finite(bad[0], 0));
    TEST_ASSERT_TRUE(check_rows(bad, 0));
}

static void test_every_entry_of_the_first_rows_counts(void)
{
    for (int i = 0; i < 4 * CHECK_COLUMNS; i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            const int row                     = i / CHECK_COLUMNS;
            float     table[4][CHECK_COLUMNS] = {{0.0f}};
            TEST_ASSERT_TRUE(check_rows((const float(*)[CHECK_COLUMNS])table, 4));

            table[row][i % CHECK_COLUMNS] = support_not_finite[k];

            TEST_ASSERT_FALSE(check_rows((const float(*)[CHECK_COLUMNS])table, 4));
            TEST_ASSERT_FALSE(check_rows((const float(*)[CHECK_COLUMNS])table, (int16_t)(row + 1)));
            TEST_ASSERT_TRUE(check_rows((const float(*)[CHECK_COLUMNS])table, (int16_t)row));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_largest_is_far_from_overflow);
    RUN_TEST(test_positive_begins_above_zero_and_ends_at_the_largest);
    RUN_TEST(test_not_negative_begins_at_zero_and_ends_at_the_largest);
    RUN_TEST(test_single_numbers_that_are_not_finite_are_refused);
    RUN_TEST(test_every_number_of_a_list_counts);
    RUN_TEST(test_list_ends_at_the_largest_on_both_sides);
    RUN_TEST(test_empty_list_and_table_are_in_order);
    RUN_TEST(test_every_entry_of_the_first_rows_counts);
    return UNITY_END();
}
