/* SPDX-License-Identifier: MIT */
#include "app_setpoint.h"

#include "app_control.h"
#include "unit_support.h"
#include "unity.h"

#define NEW      APP_CONTROL_NEW_SETPOINT
#define AT_ONCE  APP_CONTROL_AT_ONCE
#define RELATIVE APP_CONTROL_RELATIVE

static app_setpoint_t setpoint;
static app_objects_t  wanted;
static app_position_t position;

void setUp(void)
{
    const app_angle_t angle = {.pole_pairs = 2U, .positions = 10000U, .rad_per_cnt = 1.2566371e-3f};
    const app_objects_t nothing = {.controlword = APP_CONTROL_ENABLE_OPERATION};

    app_position_init(&position, &angle);
    position.known  = true;
    position.actual = app_position_at(&position, 123);
    wanted          = nothing;
    app_setpoint_start(&setpoint, &wanted, &position);
}

void tearDown(void) {}

static void tick(int bits, int32_t target_cnt, bool arrived)
{
    wanted.controlword = (uint16_t)(APP_CONTROL_ENABLE_OPERATION | bits);
    wanted.target_cnt  = target_cnt;
    app_setpoint_tick(&setpoint, &wanted, &position, arrived);
}

static void assert_goes_to(int32_t counts)
{
    TEST_ASSERT_EQUAL_INT32(counts, setpoint.now.target_cnt);
    TEST_ASSERT_EQUAL_INT32(counts, app_position_cnt(&position, &setpoint.target));
}

static void test_a_run_begins_where_the_shaft_is(void)
{
    assert_goes_to(123);
    tick(0, 5000, true);
    assert_goes_to(123);
    TEST_ASSERT_FALSE(setpoint.acknowledged);
}

static void test_a_bit_that_was_there_before_the_run_is_no_set_point(void)
{
    tick(NEW, 5000, true);
    assert_goes_to(123);
    tick(0, 5000, true);
    tick(NEW, 5000, true);
    assert_goes_to(5000);
}

static void test_a_set_point_is_taken_when_its_bit_rises_and_acknowledged_until_it_falls(void)
{
    tick(0, 0, true);
    tick(NEW, 5000, true);
    assert_goes_to(5000);
    TEST_ASSERT_TRUE(setpoint.acknowledged);
    tick(NEW, 7000, false); /* no new one: the bit did not rise */
    assert_goes_to(5000);
    TEST_ASSERT_TRUE(setpoint.acknowledged);
    tick(0, 7000, false);
    TEST_ASSERT_FALSE(setpoint.acknowledged);
}

static void test_one_set_point_waits_and_a_third_has_no_room(void)
{
    tick(0, 0, true);
    tick(NEW, 5000, true);
    tick(0, 0, false);
    tick(NEW, 6000, false);
    assert_goes_to(5000);
    TEST_ASSERT_TRUE(setpoint.acknowledged);
    tick(0, 0, false);
    TEST_ASSERT_TRUE(setpoint.acknowledged); /* no room */
    tick(NEW, 7000, false);
    tick(0, 0, true); /* arrived: the next begins */
    assert_goes_to(6000);
    TEST_ASSERT_FALSE(setpoint.acknowledged);
    tick(0, 0, true);
    assert_goes_to(6000); /* the third was not taken */
}

static void test_a_set_point_that_comes_as_the_next_begins_waits(void)
{
    tick(0, 0, true);
    tick(NEW, 5000, true);
    tick(0, 0, false);
    tick(NEW, 6000, false);
    tick(0, 0, false);
    tick(NEW, 7000, true);
    assert_goes_to(6000);
    TEST_ASSERT_TRUE(setpoint.waits);
    tick(0, 0, true);
    assert_goes_to(7000);
}

static void test_at_once_takes_the_place_of_what_is_on_the_way_and_of_what_waits(void)
{
    tick(0, 0, true);
    tick(NEW, 5000, true);
    tick(0, 0, false);
    tick(NEW, 6000, false);
    tick(0, 0, false);
    tick(NEW | AT_ONCE, -400, false);
    assert_goes_to(-400);
    TEST_ASSERT_FALSE(setpoint.waits);
}

static void test_relative_counts_from_the_set_point_before(void)
{
    tick(0, 0, true);
    tick(NEW | RELATIVE, 1000, true);
    assert_goes_to(1123);
    tick(0, 0, false);
    tick(NEW | RELATIVE, -100, false); /* waits */
    tick(0, 0, true);
    assert_goes_to(1023);
    tick(NEW | RELATIVE | AT_ONCE, 10, false);
    assert_goes_to(1033);
}

static void test_targets_are_held_within_what_can_be_counted(void)
{
    tick(0, 0, true);
    tick(NEW, INT32_MAX, true);
    assert_goes_to(APP_POSITION_CNT_MAX);
    tick(0, 0, true);
    tick(NEW | RELATIVE, INT32_MAX, true);
    assert_goes_to(APP_POSITION_CNT_MAX);
    tick(0, 0, true);
    tick(NEW | AT_ONCE, INT32_MIN, false);
    assert_goes_to(-APP_POSITION_CNT_MAX);
}

static void test_a_set_point_has_the_profile_of_its_time(void)
{
    wanted.profile_e_radps = 200.0f;
    wanted.accel_e_radps2  = 1000.0f;
    tick(0, 0, true);
    tick(NEW, 5000, true);
    tick(0, 0, false);
    wanted.profile_e_radps = 50.0f;
    wanted.decel_e_radps2  = 700.0f;
    wanted.jerk_e_radps3   = 8.0e4f;
    TEST_ASSERT_TRUE(base_within(setpoint.now.profile.speed_e_radps - 200.0f, 0.0f));
    TEST_ASSERT_TRUE(base_within(setpoint.now.profile.accel_e_radps2 - 1000.0f, 0.0f));
    TEST_ASSERT_TRUE(setpoint.now.profile.decel_e_radps2 > 1.0e8f); /* 0: the drive's own */
    tick(NEW, 6000, false);
    tick(0, 0, true);
    TEST_ASSERT_TRUE(base_within(setpoint.now.profile.speed_e_radps - 50.0f, 0.0f));
    TEST_ASSERT_TRUE(base_within(setpoint.now.profile.decel_e_radps2 - 700.0f, 0.0f));
    TEST_ASSERT_TRUE(base_within(setpoint.now.profile.jerk_e_radps3 - 8.0e4f, 0.0f));
}

static void test_a_set_point_keeps_within_the_limits(void)
{
    wanted.limits    = true;
    wanted.least_cnt = -100;
    wanted.most_cnt  = 900;
    tick(0, 0, true);
    tick(NEW, 901, true);
    assert_goes_to(900);
    TEST_ASSERT_TRUE(setpoint.now.limited);
    tick(0, 0, true);
    tick(NEW | RELATIVE, -1100, true);
    assert_goes_to(-100);
    TEST_ASSERT_TRUE(setpoint.now.limited);
    tick(0, 0, true);
    tick(NEW | RELATIVE, 1000, true); /* from the limit */
    assert_goes_to(900);
    TEST_ASSERT_FALSE(setpoint.now.limited);
    wanted.limits = false;
    tick(0, 0, true);
    tick(NEW, 5000, true);
    assert_goes_to(5000);
    TEST_ASSERT_FALSE(setpoint.now.limited);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_run_begins_where_the_shaft_is);
    RUN_TEST(test_a_bit_that_was_there_before_the_run_is_no_set_point);
    RUN_TEST(test_a_set_point_is_taken_when_its_bit_rises_and_acknowledged_until_it_falls);
    RUN_TEST(test_one_set_point_waits_and_a_third_has_no_room);
    RUN_TEST(test_a_set_point_that_comes_as_the_next_begins_waits);
    RUN_TEST(test_at_once_takes_the_place_of_what_is_on_the_way_and_of_what_waits);
    RUN_TEST(test_relative_counts_from_the_set_point_before);
    RUN_TEST(test_targets_are_held_within_what_can_be_counted);
    RUN_TEST(test_a_set_point_has_the_profile_of_its_time);
    RUN_TEST(test_a_set_point_keeps_within_the_limits);
    return UNITY_END();
}
