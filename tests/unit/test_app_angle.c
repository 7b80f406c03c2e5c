/* SPDX-License-Identifier: MIT */
#include "app_angle.h"

#include <string.h>

#include "board_config.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_RAD   2.0e-6 /* rad, up to 2 pi; worst 5e-7 */
#define TOL_RADPS 1.0e-2 /* rad/s, up to 31 krad/s; worst 2e-3 */
#define TS_S      200.0e-6f

static const double two_pi = 6.283185307179586;

static app_angle_config_t config;
static app_angle_t        angle;

void setUp(void)
{
    (void)memset(&angle, 0xFF, sizeof angle); /* init has to set everything */
    config = board_config.angle;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_angle_init(&angle, &config, TS_S));
}

void tearDown(void) {}

static app_angle_reading_t at(int position)
{
    return app_angle_update(&angle, (uint16_t)position, false, 0U);
}

static app_angle_reading_t at_with_index(int position, int index)
{
    return app_angle_update(&angle, (uint16_t)position, true, (uint16_t)index);
}

static void start_over(uint16_t pole_pairs, float index_theta_rad)
{
    config.pole_pairs        = pole_pairs;
    config.index_theta_e_rad = index_theta_rad;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_angle_init(&angle, &config, TS_S));
}

static void assert_angle(double expected_rad, float actual_rad)
{
    TEST_ASSERT_TRUE(base_in_range(actual_rad, 0.0f, BASE_TWO_PI));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, 0.0, remainder((double)actual_rad - expected_rad, two_pi));
}

static void test_angle_means_nothing_before_the_first_index(void)
{
    for (int position = 0; position < 10000; position += 7) {
        (void)at(position);
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
    }
}

static void test_index_refers_the_angle_at_every_position(void)
{
    static const int   pairs[] = {1, 2, 3, 7, 64};
    static const float marks[] = {0.0f, 0.7f, 3.2f, 6.28f};
    for (int p = 0; p < SUPPORT_COUNT(pairs); p++) {
        for (int k = 0; k < SUPPORT_COUNT(marks); k++) {
            for (int index = 0; index < 10000; index += 3333) {
                start_over((uint16_t)pairs[p], marks[k]);
                (void)at_with_index(index, index);
                TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
                for (int position = 0; position < 10000; position += 11) {
                    const double turns = ((double)(position - index) + 0.5) / 10000.0;
                    assert_angle((double)marks[k] + (pairs[p] * two_pi * turns),
                                 at(position).theta_e_rad);
                }
            }
        }
    }
}

static void test_speed_is_the_difference_of_positions_either_way_round(void)
{
    static const int from[] = {0, 1, 4999, 5000, 9998, 9999};
    for (int i = 0; i < SUPPORT_COUNT(from); i++) {
        for (int step = -4999; step <= 4999; step += 17) {
            setUp();
            (void)at(from[i]);
            const app_angle_reading_t r = at((from[i] + step + 10000) % 10000);
            TEST_ASSERT_TRUE(r.speed_valid);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS, 2.0 * step * two_pi / (10000.0 * 200.0e-6),
                                      (double)r.omega_e_radps);
        }
    }
}

static void test_first_sample_has_no_speed(void)
{
    const app_angle_reading_t r = at(5000);

    TEST_ASSERT_FALSE(r.speed_valid);
    TEST_ASSERT_TRUE(r.omega_e_radps == 0.0f);
}

static void test_dropped_reference_takes_angle_and_speed_away(void)
{
    (void)at_with_index(100, 50);
    app_angle_drop(&angle);

    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
    TEST_ASSERT_FALSE(at(200).speed_valid);
    TEST_ASSERT_TRUE(at(201).speed_valid);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
}

static void test_alignment_forgets_the_angle_of_the_index(void)
{
    start_over(2U, 1.5f);
    (void)at_with_index(100, 100);
    app_angle_align(&angle, 700U);
    assert_angle(2.0 * two_pi * 0.5 / 10000.0, at(700).theta_e_rad);
}

static void test_before_any_reference_the_position_itself_is_shown(void)
{
    assert_angle(2.0 * two_pi * 10.5 / 10000.0, at(10).theta_e_rad);
}

static void test_alignment_puts_the_zero_here_until_the_index(void)
{
    (void)at(4321);
    app_angle_align(&angle, 4321U);

    TEST_ASSERT_EQUAL_INT(APP_ANGLE_ALIGNED, angle.reference);
    assert_angle(2.0 * two_pi * 0.5 / 10000.0, at(4321).theta_e_rad);
    assert_angle(2.0 * two_pi * 100.5 / 10000.0, at(4421).theta_e_rad);
    assert_angle(2.0 * two_pi * -99.5 / 10000.0, at(4221).theta_e_rad);
}

/* After alignment the index may be at any of the pole pairs. */
static void test_index_after_alignment_takes_over_within_its_bound(void)
{
    for (int pair = 0; pair < 2; pair++) {
        for (int error = -110; error <= 110; error++) {
            setUp();
            const int index = (4000 + (5000 * pair) + error) % 10000;
            (void)at(4000);
            app_angle_align(&angle, 4000U);

            const app_angle_reading_t r = at_with_index((index + 10) % 10000, index);

            if ((error >= -99) && (error <= 99)) {
                TEST_ASSERT_FALSE(r.index_fault);
                TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
                assert_angle(2.0 * two_pi * 10.5 / 10000.0, r.theta_e_rad);
            }
            if ((error < -101) || (error > 101)) {
                TEST_ASSERT_TRUE(r.index_fault);
                TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
            }
        }
    }
}

static void test_index_after_alignment_knows_its_own_angle(void)
{
    start_over(2U, 1.5f);
    const int mark = 2000 + (int)lround(1.5 / (2.0 * two_pi) * 10000.0);
    (void)at(2000);
    app_angle_align(&angle, 2000U);

    TEST_ASSERT_FALSE(at_with_index(mark, mark).index_fault);

    start_over(2U, 1.5f);
    app_angle_align(&angle, 2000U);
    TEST_ASSERT_TRUE(at_with_index(2000, 2000).index_fault);
    TEST_ASSERT_EQUAL_UINT(0U, angle.corrections);
}

static void test_later_index_corrects_or_faults_by_its_distance(void)
{
    for (int error = -5000; error <= 5000; error++) {
        setUp();
        (void)at_with_index(9990, 9990);
        const int                 index    = (9990 + error + 10000) % 10000;
        const int                 position = (index + 20) % 10000;
        const app_angle_reading_t r        = at_with_index(position, index);

        const int distance = (error < 0) ? -error : error;
        if (distance <= 4) {
            TEST_ASSERT_FALSE(r.index_fault);
            TEST_ASSERT_EQUAL_UINT(0U, angle.corrections);
            assert_angle(2.0 * two_pi * (20.5 + error) / 10000.0, r.theta_e_rad);
        } else if (distance <= 100) {
            TEST_ASSERT_FALSE(r.index_fault);
            TEST_ASSERT_EQUAL_UINT(1U, angle.corrections);
            assert_angle(2.0 * two_pi * 20.5 / 10000.0, r.theta_e_rad);
        } else {
            TEST_ASSERT_TRUE(r.index_fault);
            TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
        }
    }
}

static void test_correction_does_not_show_in_the_speed(void)
{
    (void)at_with_index(100, 0);
    const app_angle_reading_t r = at_with_index(110, 80);

    TEST_ASSERT_EQUAL_UINT(1U, angle.corrections);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS, 2.0 * 10.0 * two_pi / 2.0, (double)r.omega_e_radps);
}

static void test_corrections_are_counted_until_the_start(void)
{
    (void)at_with_index(0, 0);
    for (int n = 1; n <= 5; n++) {
        (void)at_with_index(10 * n, 10 * n);
        TEST_ASSERT_EQUAL_UINT((unsigned)n, angle.corrections);
    }
    setUp();
    TEST_ASSERT_EQUAL_UINT(0U, angle.corrections);
}

static void test_index_fault_lasts_one_sample(void)
{
    (void)at_with_index(0, 0);
    TEST_ASSERT_TRUE(at_with_index(1000, 1000).index_fault);
    TEST_ASSERT_FALSE(at(1001).index_fault);
    TEST_ASSERT_FALSE(at_with_index(1010, 1005).index_fault);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
}

static ctl_status_t init(void)
{
    return app_angle_init(&angle, &config, TS_S);
}

static void test_constants_out_of_range_are_refused(void)
{
    config.pole_pairs = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.pole_pairs = 65U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.index_theta_e_rad = BASE_TWO_PI;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.index_theta_e_rad = -0.001f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.index_theta_e_rad = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.index_correct_max_cnt = (uint16_t)(config.index_tolerance_cnt - 1U);
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.index_correct_max_cnt = config.index_tolerance_cnt;
    TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    config.index_correct_max_cnt = 2500U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_angle_init(&angle, &config, 0.0f));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_angle_init(&angle, &config, NAN));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angle_means_nothing_before_the_first_index);
    RUN_TEST(test_index_refers_the_angle_at_every_position);
    RUN_TEST(test_speed_is_the_difference_of_positions_either_way_round);
    RUN_TEST(test_first_sample_has_no_speed);
    RUN_TEST(test_dropped_reference_takes_angle_and_speed_away);
    RUN_TEST(test_alignment_forgets_the_angle_of_the_index);
    RUN_TEST(test_before_any_reference_the_position_itself_is_shown);
    RUN_TEST(test_alignment_puts_the_zero_here_until_the_index);
    RUN_TEST(test_index_after_alignment_takes_over_within_its_bound);
    RUN_TEST(test_index_after_alignment_knows_its_own_angle);
    RUN_TEST(test_later_index_corrects_or_faults_by_its_distance);
    RUN_TEST(test_correction_does_not_show_in_the_speed);
    RUN_TEST(test_corrections_are_counted_until_the_start);
    RUN_TEST(test_index_fault_lasts_one_sample);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
