/* SPDX-License-Identifier: MIT */
#include "pid_law.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_V 2.0e-5 /* V, voltages up to 100 V; worst 4e-6 */

static const pid_law_config_t config = {.kp = 0.9f, .ki_per_tick = 0.0075f, .kd_tick = 20.0f};

static pid_law_t pid;

void setUp(void)
{
    pid_law_reset(&pid, 0.0f);
}

void tearDown(void) {}

/* Oracle for EQ-PID-1 and EQ-PID-2 without a limit, in double. */
static void test_unlimited_law_matches_the_sums(void)
{
    const float errors[] = {1.0f, 1.5f, -0.5f, -0.75f, 2.0f, 2.0f};
    double      integral = 12.0;
    double      before   = (double)errors[0];

    pid_law_reset(&pid, 12.0f);
    for (int k = 0; k < SUPPORT_COUNT(errors); k++) {
        const double e        = (double)errors[k];
        const double expected = (0.9 * e) + integral + (20.0 * (e - before));

        const float u_V = pid_law_update(&pid, &config, errors[k]);
        pid_law_realise(&pid, &config, u_V);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, expected, (double)u_V);
        integral += 0.0075 * e;
        before = e;
    }
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, integral, (double)pid.integral_V);
}

static void test_first_update_has_no_derivative(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 0.9 * 50.0, (double)pid_law_update(&pid, &config, 50.0f));
}

static float integral_after_V(float error, float cut_V)
{
    pid_law_reset(&pid, 0.0f);
    const float u_V = pid_law_update(&pid, &config, error);
    pid_law_realise(&pid, &config, u_V - cut_V);
    return pid.integral_V;
}

static void test_integral_rests_where_the_limit_cuts_off_what_the_error_asks_for(void)
{
    TEST_ASSERT_TRUE(integral_after_V(4.0f, 1.0f) == 0.0f);
    TEST_ASSERT_TRUE(integral_after_V(-4.0f, -1.0f) == 0.0f);
}

static void test_integral_runs_back_out_of_a_limit(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-7, -0.03, (double)integral_after_V(-4.0f, 1.0f));
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-7, 0.03, (double)integral_after_V(4.0f, -1.0f));
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-7, 0.03, (double)integral_after_V(4.0f, 0.0f));
}

static void test_not_a_number_is_not_hidden(void)
{
    TEST_ASSERT_TRUE(isnan(pid_law_update(&pid, &config, NAN)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_unlimited_law_matches_the_sums);
    RUN_TEST(test_first_update_has_no_derivative);
    RUN_TEST(test_integral_rests_where_the_limit_cuts_off_what_the_error_asks_for);
    RUN_TEST(test_integral_runs_back_out_of_a_limit);
    RUN_TEST(test_not_a_number_is_not_hidden);
    return UNITY_END();
}
