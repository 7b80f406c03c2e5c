/* SPDX-License-Identifier: MIT */
#include "commission_angle.h"

#include "unit_support.h"
#include "unity.h"

#define PI      3.14159265358979324
#define TOL_rad 1.0e-6 /* measured 3.4e-7 */
#define TS_s    1.0e-4f

static commission_result_t known;

void setUp(void)
{
    const commission_result_t fresh = {
        .counts_per_turn = 10000, .pole_pairs = 7, .direction = 1, .offset_rad = {0.3f, 0.0f}};
    known = fresh;
}

void tearDown(void) {}

static double oracle_rad(int32_t position, int direction)
{
    const double turns = (position + 0.5) * 7.0 / 10000.0;
    return remainder((direction * turns * 2.0 * PI) + (double)0.3f, 2.0 * PI);
}

static void check_sweep(int direction)
{
    known.direction = (int16_t)direction;
    for (int32_t k = -2000000; k < 2000000; k += 977) {
        const double found = (double)commission_angle_rad(&known, k);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_rad, 0.0,
                                  remainder(found - oracle_rad(k, direction), 2.0 * PI));
        TEST_ASSERT_TRUE(fabs(found) <= (PI + TOL_rad));
    }
}

static void test_angle_of_a_position_both_directions(void)
{
    check_sweep(1);
    check_sweep(-1);
}

/* Speed of a steady acceleration: late by 2 / pole, 50 periods; the prompt one is not. */
static void test_speed_follows_and_the_prompt_one_is_not_late(void)
{
    commission_angle_t a;
    const double       accel = 2000.0;
    commission_angle_start(&a, 0.0f);
    double time_s = 0.0;
    for (int k = 1; k <= 4000; k++) {
        time_s = k * (double)TS_s;
        (void)commission_angle_tick(&a, (float)remainder(0.5 * accel * time_s * time_s, 2.0 * PI),
                                    TS_s);
    }

    const double late_s = 50.0 * (double)TS_s;
    TEST_ASSERT_DOUBLE_WITHIN(0.5, accel * (time_s - late_s), (double)a.omega_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, accel * time_s, (double)a.prompt_e_radps);
}

static void test_angle_of_a_vector_all_round(void)
{
    for (double angle = -PI; angle < PI; angle += 1.0e-3) {
        for (double size = 1.0e-6; size < 1.0e7; size *= 1.0e4) {
            const float y = (float)(size * sin(angle));
            const float x = (float)(size * cos(angle));
            TEST_ASSERT_DOUBLE_WITHIN(
                3.0e-6, 0.0, /* measured 2.0e-6 */
                remainder((double)commission_angle_of(y, x) - atan2((double)y, (double)x),
                          2.0 * PI));
        }
    }
    TEST_ASSERT_TRUE(commission_angle_of(0.0f, 0.0f) == 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angle_of_a_vector_all_round);
    RUN_TEST(test_angle_of_a_position_both_directions);
    RUN_TEST(test_speed_follows_and_the_prompt_one_is_not_late);
    return UNITY_END();
}
