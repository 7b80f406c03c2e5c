/* SPDX-License-Identifier: MIT */
#include "app_position.h"

#include <stdlib.h>

#include "unit_support.h"
#include "unity.h"

#define TWO_PI 6.283185307179586
#define CASES  3000

static support_random_t    random_state;
static app_position_t      position;
static app_angle_t         angle;
static app_angle_reading_t reading;
static int64_t             count; /* of the shaft, from where it stood at first */

/* An encoder of so many positions on a motor of so many pole pairs; its angle is zero_theta_rad at the edge below zero_cnt. */
static void use(uint16_t positions, uint16_t pole_pairs)
{
    const app_angle_t none = {.pole_pairs = pole_pairs,
                              .positions  = positions,
                              .rad_per_cnt =
                                  (float)(TWO_PI * (double)pole_pairs / (double)positions),
                              .reference      = APP_ANGLE_NONE,
                              .zero_cnt       = (uint16_t)(positions / 3U),
                              .zero_theta_rad = 1.0f};
    angle                  = none;
    count                  = 0;
    app_position_init(&position, &angle);
}

void setUp(void)
{
    random_state.state = 9u;
    use(10000U, 2U);
}

void tearDown(void) {}

/* The middle of the count that the shaft stands in, as app_angle_update() reads it; never more than half an electrical turn
 * from the sample before. */
static void sample_at(int64_t to)
{
    const int64_t n    = (int64_t)angle.positions;
    count              = to;
    angle.before_cnt   = (uint16_t)(((to % n) + n) % n);
    const int64_t from = (int64_t)angle.before_cnt - (int64_t)angle.zero_cnt;
    const double e = 1.0 + ((((double)from + 0.5) * TWO_PI * (double)angle.pole_pairs) / (double)n);
    reading.theta_e_rad = (float)(e - (TWO_PI * floor(e / TWO_PI)));
    app_position_track(&position, &angle, &reading);
}

static void turn_to(int64_t to)
{
    const int64_t step = ((int64_t)angle.positions / (int64_t)angle.pole_pairs / 3) + 1;

    while (count != to) {
        const int64_t left = to - count;
        sample_at(count + ((left > step) ? step : ((left < -step) ? -step : left)));
    }
}

static int32_t shown(void)
{
    return app_position_cnt(&position, &position.actual);
}

static const struct {
    uint16_t positions;
    uint16_t pole_pairs;
} machines[] = {{10000U, 2U}, {4096U, 7U}, {8192U, 3U}, {400U, 64U}, {65532U, 5U}, {1000U, 1U}};

static void test_counts_from_the_zero_over_any_number_of_turns(void)
{
    for (int m = 0; m < SUPPORT_COUNT(machines); m++) {
        use(machines[m].positions, machines[m].pole_pairs);
        sample_at(17);
        angle.reference = APP_ANGLE_ALIGNED;
        sample_at(17);
        TEST_ASSERT_TRUE(position.known);
        const int64_t zero = 17 - (int64_t)shown(); /* a count that is zero_cnt */
        TEST_ASSERT_EQUAL_INT64((int64_t)angle.zero_cnt,
                                ((zero % angle.positions) + angle.positions) % angle.positions);
        TEST_ASSERT_TRUE(llabs(17 - zero) <= (int64_t)angle.positions / 2);
        for (int i = 0; i < 60; i++) {
            turn_to((int64_t)support_uniform(&random_state, -3.0e5f, 3.0e5f));
            TEST_ASSERT_EQUAL_INT64(count - zero, (int64_t)shown());
        }
    }
}

static void test_a_target_is_where_its_counts_are_shown(void)
{
    for (int m = 0; m < SUPPORT_COUNT(machines); m++) {
        use(machines[m].positions, machines[m].pole_pairs);
        angle.reference = APP_ANGLE_INDEX;
        sample_at(1000);
        for (int i = 0; i < CASES; i++) {
            const float   size   = powf(10.0f, support_uniform(&random_state, 0.0f, 9.0f));
            const int32_t wanted = (int32_t)support_uniform(&random_state, -size, size);
            const double  turns =
                (double)wanted * (double)angle.pole_pairs / (double)angle.positions;
            if (fabs(turns) > 0.9e9) {
                continue;
            }
            const position_t at = app_position_at(&position, wanted);
            TEST_ASSERT_TRUE(position_ok(&at));
            TEST_ASSERT_EQUAL_INT32(wanted, app_position_cnt(&position, &at));
            const double e = ((double)(at.turns - position.zero.turns) * TWO_PI) +
                             ((double)at.theta_e_rad - (double)position.zero.theta_e_rad);
            TEST_ASSERT_DOUBLE_WITHIN(0.02 * (double)angle.rad_per_cnt, turns * TWO_PI, e);
        }
    }
}

static void test_the_zero_stays_when_the_reference_gets_better(void)
{
    angle.reference = APP_ANGLE_ALIGNED;
    sample_at(500);
    const int32_t before = shown();
    angle.reference      = APP_ANGLE_INDEX;
    angle.zero_cnt       = 42U;
    angle.zero_theta_rad = reading.theta_e_rad; /* a little off; as a mark would be */
    app_position_track(&position, &angle, &reading);
    TEST_ASSERT_EQUAL_INT32(before, shown());
}

/* A zero that is found during a correction is the one after it. */
static void test_a_correction_does_not_move_the_zero(void)
{
    const app_angle_config_t mark = {.index_theta_e_rad = 1.0f};

    angle.config           = &mark;
    angle.reference        = APP_ANGLE_INDEX;
    angle.correct_ticks    = 300U;
    angle.correct_step_rad = 2.0e-4f;
    angle.zero_theta_rad   = 1.06f;
    sample_at((int64_t)angle.zero_cnt + 400);
    TEST_ASSERT_TRUE(position.known);
    angle.correct_ticks  = 0U;
    angle.zero_theta_rad = 1.0f;
    for (int way = -2000; way <= 2000; way += 100) {
        turn_to((int64_t)angle.zero_cnt + way);
        TEST_ASSERT_EQUAL_INT32(way, shown());
    }
}

static void test_lost_counts_lose_the_zero_until_it_is_found_again(void)
{
    angle.reference = APP_ANGLE_INDEX;
    sample_at(5000);
    turn_to(25000);
    const int32_t far = shown();
    angle.reference   = APP_ANGLE_NONE;
    sample_at(25001);
    TEST_ASSERT_FALSE(position.known);
    angle.reference = APP_ANGLE_INDEX;
    sample_at(25002);
    TEST_ASSERT_TRUE(position.known);
    TEST_ASSERT_EQUAL_INT32(far + 2 - 20000, shown()); /* from the nearest mark */
}

static void test_homing_finds_the_nearest_zero(void)
{
    angle.reference = APP_ANGLE_INDEX;
    sample_at(3333);
    turn_to(3333 + 70000);
    TEST_ASSERT_EQUAL_INT32(70000, shown());
    app_position_forget(&position);
    TEST_ASSERT_FALSE(position.known);
    sample_at(3333 + 70000);
    TEST_ASSERT_EQUAL_INT32(0, shown());
}

static void test_what_is_beyond_all_counts_is_held_at_their_end(void)
{
    const position_t up   = {POSITION_TURNS_MAX, 0.0f};
    const position_t down = {-POSITION_TURNS_MAX, 0.0f};

    use(65532U, 1U);
    TEST_ASSERT_EQUAL_INT32(APP_POSITION_CNT_MAX, app_position_cnt(&position, &up));
    TEST_ASSERT_EQUAL_INT32(-APP_POSITION_CNT_MAX, app_position_cnt(&position, &down));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_counts_from_the_zero_over_any_number_of_turns);
    RUN_TEST(test_a_target_is_where_its_counts_are_shown);
    RUN_TEST(test_the_zero_stays_when_the_reference_gets_better);
    RUN_TEST(test_a_correction_does_not_move_the_zero);
    RUN_TEST(test_lost_counts_lose_the_zero_until_it_is_found_again);
    RUN_TEST(test_homing_finds_the_nearest_zero);
    RUN_TEST(test_what_is_beyond_all_counts_is_held_at_their_end);
    return UNITY_END();
}
