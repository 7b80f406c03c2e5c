/* SPDX-License-Identifier: MIT */
#include "dead_time.h"

#include "bridge.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_DUTY 1.5e-7 /* duties up to 1; one rounding */

#define CASES 5000

static support_random_t   random_state;
static dead_time_config_t config;

void setUp(void)
{
    random_state.state  = 29u;
    config.share        = 0.015f;
    config.inv_fade_1pA = 10.0f; /* fades below 0.1 A */
}

void tearDown(void) {}

static abc_t same(float x)
{
    const abc_t all = {x, x, x};
    return all;
}

static abc_t draw(float lo, float hi)
{
    abc_t x;
    x.a = support_uniform(&random_state, lo, hi);
    x.b = support_uniform(&random_state, lo, hi);
    x.c = support_uniform(&random_state, lo, hi);
    return x;
}

/* Oracle: EQ-DEAD-TIME-1 as a time: the gate loses the dead time when the current flows out of the phase,
 * in proportion below the fading current. */
/* As the bridge gets it. */
static abc_t compensated(const dead_time_config_t *c, abc_t duty, abc_t i_A)
{
    return bridge_closed(dead_time_compensate(c, duty, i_A)).duty;
}

static double oracle(float duty, float i_A)
{
    const double fade_A = 1.0 / (double)config.inv_fade_1pA;
    double       share  = (double)config.share;
    if (fabs((double)i_A) < fade_A) {
        share *= fabs((double)i_A) / fade_A;
    }
    const double out = ((double)i_A < 0.0) ? ((double)duty - share) : ((double)duty + share);
    return support_limit(out, 0.0, 1.0);
}

static void test_every_phase_matches_the_rule(void)
{
    for (int n = 0; n < CASES; n++) {
        const abc_t duty = draw(0.0f, 1.0f);
        const abc_t i_A  = (n % 2 == 0) ? draw(-8.0f, 8.0f) : draw(-0.15f, 0.15f);
        config.share     = support_uniform(&random_state, 0.0f, 0.1f);

        const abc_t out = compensated(&config, duty, i_A);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, oracle(duty.a, i_A.a), (double)out.a);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, oracle(duty.b, i_A.b), (double)out.b);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, oracle(duty.c, i_A.c), (double)out.c);
    }
}

static void test_positive_current_lengthens_and_negative_shortens(void)
{
    const abc_t i_A = {.a = 2.0f, .b = -1.0f, .c = -1.0f};

    const abc_t out = compensated(&config, same(0.5f), i_A);

    TEST_ASSERT_TRUE(out.a == 0.5f + 0.015f);
    TEST_ASSERT_TRUE((out.b == 0.5f - 0.015f) && (out.c == 0.5f - 0.015f));
}

static void test_no_current_changes_nothing(void)
{
    for (int n = 0; n < CASES; n++) {
        const abc_t duty = draw(0.0f, 1.0f);

        const abc_t out = compensated(&config, duty, same(0.0f));

        TEST_ASSERT_TRUE((out.a == duty.a) && (out.b == duty.b) && (out.c == duty.c));
    }
}

static void test_compensation_is_full_from_the_fading_current_on(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const float full = 0.5f + (0.015f * (float)sign);

        TEST_ASSERT_TRUE(compensated(&config, same(0.5f), same(0.101f * (float)sign)).a == full);
        TEST_ASSERT_TRUE(compensated(&config, same(0.5f), same(8.0f * (float)sign)).a == full);
        TEST_ASSERT_DOUBLE_WITHIN(
            TOL_DUTY, 0.5 + (0.0075 * (double)sign),
            (double)compensated(&config, same(0.5f), same(0.05f * (float)sign)).a);
    }
}

static void test_compensation_grows_with_the_current(void)
{
    float before = 0.0f;
    for (int step = -200; step <= 200; step++) {
        const float out = compensated(&config, same(0.5f), same(1.0e-3f * (float)step)).b;

        TEST_ASSERT_TRUE(out >= before);
        before = out;
    }
}

static void test_opposite_currents_give_opposite_changes(void)
{
    for (int n = 0; n < CASES; n++) {
        const abc_t i_A     = draw(-0.2f, 0.2f);
        const abc_t minus_A = {-i_A.a, -i_A.b, -i_A.c};

        const abc_t plus  = compensated(&config, same(0.5f), i_A);
        const abc_t minus = compensated(&config, same(0.5f), minus_A);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 1.0, (double)plus.a + (double)minus.a);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 1.0, (double)plus.b + (double)minus.b);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 1.0, (double)plus.c + (double)minus.c);
    }
}

static void test_phases_do_not_influence_each_other(void)
{
    for (int n = 0; n < CASES; n++) {
        const abc_t duty        = draw(0.0f, 1.0f);
        const abc_t i_A         = draw(-0.2f, 0.2f);
        const abc_t turned_duty = {duty.b, duty.c, duty.a};
        const abc_t turned_i_A  = {i_A.b, i_A.c, i_A.a};

        const abc_t out    = compensated(&config, duty, i_A);
        const abc_t turned = compensated(&config, turned_duty, turned_i_A);

        TEST_ASSERT_TRUE((turned.a == out.b) && (turned.b == out.c) && (turned.c == out.a));
    }
}

static void test_duties_stay_in_range(void)
{
    TEST_ASSERT_TRUE(compensated(&config, same(1.0f), same(5.0f)).a == 1.0f);
    TEST_ASSERT_TRUE(compensated(&config, same(0.99f), same(5.0f)).b == 1.0f);
    TEST_ASSERT_TRUE(compensated(&config, same(0.0f), same(-5.0f)).c == 0.0f);
    TEST_ASSERT_TRUE(compensated(&config, same(0.01f), same(-5.0f)).a == 0.0f);
}

static void test_no_share_switches_the_compensation_off(void)
{
    config.share = 0.0f;
    for (int n = 0; n < CASES; n++) {
        const abc_t duty = draw(0.0f, 1.0f);

        const abc_t out = compensated(&config, duty, draw(-8.0f, 8.0f));

        TEST_ASSERT_TRUE((out.a == duty.a) && (out.b == duty.b) && (out.c == duty.c));
    }
}

static void test_bad_numbers_never_leave_the_range_of_a_duty(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        const float bad = support_not_finite[i];

        const abc_t of_current = compensated(&config, same(0.5f), same(bad));
        const abc_t of_duty    = compensated(&config, same(bad), same(1.0f));

        TEST_ASSERT_TRUE(base_in_range(of_current.a, 0.485f - 1.0e-6f, 0.515f + 1.0e-6f));
        TEST_ASSERT_TRUE(base_in_range(of_duty.b, 0.0f, 1.0f));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_phase_matches_the_rule);
    RUN_TEST(test_positive_current_lengthens_and_negative_shortens);
    RUN_TEST(test_no_current_changes_nothing);
    RUN_TEST(test_compensation_is_full_from_the_fading_current_on);
    RUN_TEST(test_compensation_grows_with_the_current);
    RUN_TEST(test_opposite_currents_give_opposite_changes);
    RUN_TEST(test_phases_do_not_influence_each_other);
    RUN_TEST(test_duties_stay_in_range);
    RUN_TEST(test_no_share_switches_the_compensation_off);
    RUN_TEST(test_bad_numbers_never_leave_the_range_of_a_duty);
    return UNITY_END();
}
