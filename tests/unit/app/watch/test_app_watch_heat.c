/* SPDX-License-Identifier: MIT */
#include "app_watch_heat.h"

#include "unity.h"

#define TS_s  200.0e-6f
#define MAX_A 4.0f

static const app_watch_heat_config_t config = {
    .motor_A = 2.6f, .motor_s = 1.0f, .inverter_A = 5.0f, .inverter_s = 0.1f};
static app_watch_heat_t heat;

void setUp(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_watch_heat_init(&heat, &config, MAX_A, TS_s));
}

void tearDown(void) {}

/* A vector of that length along phase b; so many seconds. */
static bool flow(float i_A, float time_s, float warmth)
{
    bool ok = true;
    for (float t = 0.0f; t < time_s; t += TS_s) {
        ok = app_watch_heat_tick(&heat, -0.5f * i_A, i_A, warmth);
    }
    return ok;
}

static void test_warms_up_like_the_square_with_its_time_constant(void)
{
    TEST_ASSERT_TRUE(flow(2.6f, 1.0f, 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 1.0f - 0.367879f, heat.motor.x);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 0.2704f, heat.inverter.x); /* (2.6 / 5)^2 */
    TEST_ASSERT_TRUE(heat.derating == 0.0f);
}

static void test_the_limit_comes_down_to_what_may_flow_for_ever(void)
{
    float i_A = MAX_A;
    for (int n = 0; n < 50000; n++) { /* a drive that follows */
        TEST_ASSERT_TRUE(app_watch_heat_tick(&heat, -0.5f * i_A, i_A, 0.0f));
        i_A = MAX_A * (1.0f - heat.derating);
    }
    TEST_ASSERT_FLOAT_WITHIN(0.05f, 2.65f, i_A);
    TEST_ASSERT_TRUE(heat.motor.x <= 1.05f);
}

static void test_a_current_that_does_not_follow_is_a_fault(void)
{
    /* 2.37 of the square: 1.1 after ln(2.37 / 1.27) = 0.62 s. */
    TEST_ASSERT_TRUE(flow(MAX_A, 0.60f, 0.0f));
    TEST_ASSERT_FALSE(flow(MAX_A, 0.05f, 0.0f));
}

/* An inverter for 2 A with a motor for 8 A: 4 of the square, 1.1 after 0.1 s ln(4 / 2.9) = 32 ms. */
static void test_the_inverter_alone_derates_and_is_a_fault(void)
{
    const app_watch_heat_config_t small = {
        .motor_A = 8.0f, .motor_s = 1.0f, .inverter_A = 2.0f, .inverter_s = 0.1f};

    TEST_ASSERT_EQUAL_INT(CTL_OK, app_watch_heat_init(&heat, &small, MAX_A, TS_s));
    TEST_ASSERT_TRUE(flow(MAX_A, 0.030f, 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.5f, heat.derating); /* 2 A of 4 A remain */
    TEST_ASSERT_FALSE(flow(MAX_A, 0.004f, 0.0f));
    TEST_ASSERT_TRUE(heat.motor.x < 0.1f);
}

static void test_a_warm_heat_sink_halves_the_limit(void)
{
    TEST_ASSERT_TRUE(flow(0.0f, TS_s, 0.5f));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.25f, heat.derating);
    TEST_ASSERT_TRUE(flow(0.0f, TS_s, 7.0f));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.5f, heat.derating);
    TEST_ASSERT_TRUE(flow(0.0f, TS_s, -1.0f));
    TEST_ASSERT_TRUE(heat.derating == 0.0f);
}

static void test_a_current_that_is_no_number_is_a_fault(void)
{
    TEST_ASSERT_FALSE(app_watch_heat_tick(&heat, NAN, 0.0f, 0.0f));
}

static void test_bad_constants_are_refused(void)
{
    app_watch_heat_config_t bad = config;
    bad.motor_A                 = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_watch_heat_init(&heat, &bad, MAX_A, TS_s));
    bad            = config;
    bad.inverter_s = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_watch_heat_init(&heat, &bad, MAX_A, TS_s));
    bad         = config;
    bad.motor_s = TS_s; /* the filter would jump */
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_watch_heat_init(&heat, &bad, MAX_A, TS_s));
    bad            = config;
    bad.inverter_s = TS_s;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_watch_heat_init(&heat, &bad, MAX_A, TS_s));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_warms_up_like_the_square_with_its_time_constant);
    RUN_TEST(test_the_limit_comes_down_to_what_may_flow_for_ever);
    RUN_TEST(test_a_current_that_does_not_follow_is_a_fault);
    RUN_TEST(test_the_inverter_alone_derates_and_is_a_fault);
    RUN_TEST(test_a_warm_heat_sink_halves_the_limit);
    RUN_TEST(test_a_current_that_is_no_number_is_a_fault);
    RUN_TEST(test_bad_constants_are_refused);
    return UNITY_END();
}
