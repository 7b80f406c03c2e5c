/* SPDX-License-Identifier: MIT */
#include "app_units.h"

#include "app_position.h"
#include "unit_support.h"
#include "unity.h"

#define TURN 10000U

static app_units_t       units;
static app_units_scale_t scale;

void setUp(void)
{
    units = app_units_default();
    TEST_ASSERT_TRUE(app_units_reduce(&units, TURN, &scale));
}

void tearDown(void) {}

static bool reduces(uint32_t motor, uint32_t shaft, uint32_t feed, uint32_t feed_shaft)
{
    units.gear_motor = (uint16_t)motor;
    units.gear_shaft = (uint16_t)shaft;
    units.feed       = feed;
    units.feed_shaft = (uint16_t)feed_shaft;
    return app_units_reduce(&units, TURN, &scale);
}

static void test_units_are_counts_by_default(void)
{
    const int32_t some[] = {0, 1, -1, 12345, -1000000000, 2147483647};

    TEST_ASSERT_TRUE((scale.num == 1U) && (scale.den == 1U) && !scale.reversed);
    for (int n = 0; n < SUPPORT_COUNT(some); n++) {
        TEST_ASSERT_EQUAL_INT32(some[n], app_units_cnt(&scale, some[n]));
        TEST_ASSERT_EQUAL_INT32(some[n], app_units_of(&scale, some[n]));
    }
}

static void test_a_spindle_behind_a_gear_counts_micrometres(void)
{
    TEST_ASSERT_TRUE(reduces(46U, 9U, 5000U, 1U));
    TEST_ASSERT_EQUAL_UINT32(92U, scale.num); /* 10000 46 / (9 5000) */
    TEST_ASSERT_EQUAL_UINT32(9U, scale.den);
    TEST_ASSERT_EQUAL_INT32(51111, app_units_cnt(&scale, 5000)); /* 51111.1 */
    TEST_ASSERT_EQUAL_INT32(-51111, app_units_cnt(&scale, -5000));
    TEST_ASSERT_EQUAL_INT32(5000, app_units_of(&scale, 51111));
}

static void test_a_gear_alone_counts_at_the_shaft(void)
{
    TEST_ASSERT_TRUE(reduces(5U, 1U, 0U, 1U));
    TEST_ASSERT_EQUAL_INT32(50000, app_units_cnt(&scale, (int32_t)TURN));
}

/* Oracle: the nearest whole number n has |2 x num - 2 n den| <= den; limited to 32 bits. */
static bool is_nearest(int32_t x, uint32_t num, uint32_t den, int32_t n)
{
    const int64_t off  = (2 * (int64_t)x * (int64_t)num) - (2 * (int64_t)n * (int64_t)den);
    const int64_t wide = (int64_t)den;

    return ((off <= wide) && (off >= -wide)) || ((n == 2147483647) && (off > 0)) ||
           ((n == -2147483647) && (off < 0));
}

static void test_both_directions_round_to_the_nearest_and_limit(void)
{
    const uint32_t gears[] = {1U, 2U, 3U, 7U, 46U, 1000U, 65535U};
    const uint32_t feeds[] = {0U, 1U, 360U, 4096U, 5000U, 360000U, 1000000U};
    const int32_t  some[]  = {0,   1,    -1,     2,       3,         7,         -13,
                              999, 4095, -65537, 1000003, -20000001, 1000000000};

    for (int g = 0; g < SUPPORT_COUNT(gears); g++) {
        for (int s = 0; s < SUPPORT_COUNT(gears); s++) {
            for (int f = 0; f < SUPPORT_COUNT(feeds); f++) {
                TEST_ASSERT_TRUE(reduces(gears[g], gears[s], feeds[f], 1U));
                for (int n = 0; n < SUPPORT_COUNT(some); n++) {
                    const int32_t counts = app_units_cnt(&scale, some[n]);
                    const int32_t back   = app_units_of(&scale, counts);

                    TEST_ASSERT_TRUE(is_nearest(some[n], scale.num, scale.den, counts));
                    TEST_ASSERT_TRUE(is_nearest(counts, scale.den, scale.num, back));
                    if ((scale.num >= scale.den) && (counts < 2147483647) &&
                        (counts > -2147483647)) {
                        TEST_ASSERT_EQUAL_INT32(some[n], back);
                    }
                }
            }
        }
    }
}

static void test_reduces_to_the_lowest_terms(void)
{
    TEST_ASSERT_TRUE(reduces(1000U, 2500U, 4000U, 6U)); /* 60000000 / 10000000 */
    TEST_ASSERT_TRUE((scale.num == 6U) && (scale.den == 1U));
}

static void test_refuses_what_is_no_ratio(void)
{
    const app_units_scale_t before = scale;

    TEST_ASSERT_FALSE(reduces(0U, 1U, 0U, 1U));
    TEST_ASSERT_FALSE(reduces(1U, 0U, 0U, 1U));
    TEST_ASSERT_FALSE(reduces(1U, 1U, 0U, 0U));
    TEST_ASSERT_FALSE(reduces(1U, 1U, (uint32_t)APP_UNITS_FEED_MAX + 1U, 1U));
    TEST_ASSERT_FALSE(reduces(65521U, 65519U, 999999937U, 1U)); /* primes: too many digits */
    TEST_ASSERT_FALSE(reduces(65521U, 1U, 1U, 65519U));
    TEST_ASSERT_TRUE((before.num == scale.num) && (before.den == scale.den));
}

static void test_the_polarity_turns_positions_round(void)
{
    units.polarity = APP_UNITS_REVERSES_SPEED | APP_UNITS_REVERSES_TORQUE;
    TEST_ASSERT_TRUE(reduces(1U, 1U, 0U, 1U) && !scale.reversed);
    units.polarity = APP_UNITS_REVERSES_POSITION;
    TEST_ASSERT_TRUE(reduces(1U, 1U, 0U, 1U) && scale.reversed);
    TEST_ASSERT_EQUAL_INT32(-77, app_units_cnt(&scale, 77));
    TEST_ASSERT_EQUAL_INT32(77, app_units_of(&scale, -77));
}

static void test_a_position_must_fit_the_counts(void)
{
    app_units_positions_t p = {.target = 250000000};

    TEST_ASSERT_TRUE(reduces(4U, 1U, 0U, 1U));
    TEST_ASSERT_TRUE(app_units_fit(&scale, &p));
    p.target++;
    TEST_ASSERT_FALSE(app_units_fit(&scale, &p));
    p.target = 0;
    p.offset = -250000001;
    TEST_ASSERT_FALSE(app_units_fit(&scale, &p));
    p.offset = 0;
    p.least  = -250000001;
    TEST_ASSERT_FALSE(app_units_fit(&scale, &p));
    p.least = 0;
    p.most  = 2147483647;
    TEST_ASSERT_FALSE(app_units_fit(&scale, &p));
    p.most             = 0;
    p.following_window = 250000001U;
    TEST_ASSERT_FALSE(app_units_fit(&scale, &p));
}

static void test_objects_get_counts(void)
{
    app_units_positions_t p = {
        .target = 100, .offset = -10, .least = -500, .most = 800, .following_window = 7U};
    app_objects_t o = {.limits = false};

    TEST_ASSERT_TRUE(reduces(3U, 1U, 0U, 1U));
    app_units_apply(&scale, &p, &o);
    TEST_ASSERT_TRUE((o.target_cnt == 300) && (o.offset_cnt == -30));
    TEST_ASSERT_TRUE(o.limits && (o.least_cnt == -1500) && (o.most_cnt == 2400));
    TEST_ASSERT_EQUAL_UINT32(21U, o.following_window_cnt);
    units.polarity = APP_UNITS_REVERSES_POSITION;
    TEST_ASSERT_TRUE(reduces(3U, 1U, 0U, 1U));
    app_units_apply(&scale, &p, &o);
    TEST_ASSERT_TRUE((o.target_cnt == -300) && (o.least_cnt == -2400) && (o.most_cnt == 1500));
    TEST_ASSERT_EQUAL_UINT32(21U, o.following_window_cnt);
    p.most = -500;
    app_units_apply(&scale, &p, &o);
    TEST_ASSERT_FALSE(o.limits); /* no room between them: none */
}

static void test_a_window_finer_than_a_count_is_one(void)
{
    TEST_ASSERT_TRUE(reduces(1U, 1U, 1000000U, 1U)); /* a hundred units are a count */
    TEST_ASSERT_EQUAL_UINT32(1U, app_units_window_cnt(&scale, 3U));
    TEST_ASSERT_EQUAL_UINT32(0U, app_units_window_cnt(&scale, 0U));
    TEST_ASSERT_EQUAL_UINT32(3U, app_units_window_cnt(&scale, 300U));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_units_are_counts_by_default);
    RUN_TEST(test_a_spindle_behind_a_gear_counts_micrometres);
    RUN_TEST(test_a_gear_alone_counts_at_the_shaft);
    RUN_TEST(test_both_directions_round_to_the_nearest_and_limit);
    RUN_TEST(test_reduces_to_the_lowest_terms);
    RUN_TEST(test_refuses_what_is_no_ratio);
    RUN_TEST(test_the_polarity_turns_positions_round);
    RUN_TEST(test_a_position_must_fit_the_counts);
    RUN_TEST(test_objects_get_counts);
    RUN_TEST(test_a_window_finer_than_a_count_is_one);
    return UNITY_END();
}
