/* SPDX-License-Identifier: MIT */
#include "commission_vector.h"

#include "held_winding.h"
#include "unit_support.h"
#include "unity.h"

#define PI   3.14159265358979324
#define TS_s 2.0e-4

static commission_config_t config;
static commission_result_t known;
static commission_vector_t vector;

void setUp(void)
{
    const commission_config_t c = {.ts_s = (float)TS_s, .current_max_A = 9.0f};
    const commission_result_t k = {.ld_H = {0.036f, 0.0f}, .lq_H = {0.051f, 0.0f}};
    config                      = c;
    known                       = k;
    commission_vector_start(&vector, &config, &known, 0.1f);
}

void tearDown(void) {}

/* Any angle of the vector against the rotor; without knowing the resistance. */
static void test_current_reaches_its_length_without_overshoot(void)
{
    for (double theta = -3.0; theta < 3.0; theta += 0.7) {
        held_winding_t w = {
            .ts_s = TS_s, .angle_rad = 0.4, .r_Ohm = 3.6, .ld_H = 0.036, .lq_H = 0.051};
        ab_t   asked_V = {0.0f, 0.0f};
        double along_A = 0.0;
        setUp();
        for (int k = 0; k < 4000; k++) {
            const commission_signal_t     s = winding_step(&w, asked_V);
            const commission_vector_out_t out =
                commission_vector_tick(&vector, &s, (float)theta, 0.0f, 5.0f);
            asked_V = out.out_V;
            along_A = (double)out.i_A.d;
            TEST_ASSERT_TRUE(hypot(w.id_A, w.iq_A) < 5.5);
        }
        TEST_ASSERT_DOUBLE_WITHIN(0.02, 5.0, along_A);
    }
}

static commission_vector_out_t tick_with(float iq_A, int32_t position_cnt)
{
    const commission_signal_t s = {
        .i_A = {0.0f, iq_A}, .dc_link_V = 540.0f, .position_cnt = position_cnt};
    return commission_vector_tick(&vector, &s, 0.0f, 0.0f, 0.0f);
}

/* Nothing across the vector but the winding, up to three tenths of the bound; beyond it k_p = 0.2 L / Ts. */
static void test_current_across_is_left_to_the_winding_up_to_a_bound(void)
{
    TEST_ASSERT_TRUE(fabsf(tick_with(2.6f, 0).out_V.beta) == 0.0f);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -36.0 * (3.7 - 2.7), (double)tick_with(3.7f, 0).out_V.beta);
}

/* A swing of known period: half of it, and the resistance that is then added. */
static void test_a_swing_is_timed_and_damped(void)
{
    const double half_s = 0.05;
    for (int k = 0; k < 3000; k++) {
        (void)tick_with(0.0f, (int32_t)lround(300.0 * sin(PI * k * TS_s / half_s)));
    }
    /* Six counts of 300 beyond the extreme are 0.064 of a half swing, late at every reversal alike. */
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * half_s, half_s, (double)vector.half_swing_s);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, -PI * 0.051 / half_s, (double)tick_with(1.0f, 0).out_V.beta);
}

static bool strays_with(float id_A, float iq_A, int ticks)
{
    setUp();
    for (int k = 0; k < ticks; k++) {
        const commission_signal_t s = {.i_A = {id_A, iq_A}, .dc_link_V = 540.0f};
        (void)commission_vector_tick(&vector, &s, 0.0f, 0.0f, 0.0f);
    }
    return commission_vector_strays(&vector);
}

/* Bound 9 A: 0.02 of it along the vector, 0.12 across, as means of 16 periods. */
static void test_a_current_off_its_reference_strays(void)
{
    TEST_ASSERT_FALSE(strays_with(0.17f, 1.07f, 200));
    TEST_ASSERT_FALSE(strays_with(-0.17f, -1.07f, 200));
    TEST_ASSERT_TRUE(strays_with(0.19f, 0.0f, 200));
    TEST_ASSERT_TRUE(strays_with(-0.19f, 0.0f, 200));
    TEST_ASSERT_TRUE(strays_with(0.0f, 1.09f, 200));
    TEST_ASSERT_TRUE(strays_with(0.0f, -1.09f, 200));
    TEST_ASSERT_FALSE(strays_with(1.0f, 0.0f, 2));
    TEST_ASSERT_TRUE(strays_with(support_not_finite[0], 0.0f, 2));
}

/* 50 ms of a swing would add 3.2 Ohm; the added voltage is limited. */
static void test_the_added_resistance_takes_a_limited_voltage(void)
{
    commission_vector_allow(&vector, 9.0f, 1.5f, 0.02f);
    vector.half_swing_s = 0.05f;
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -0.32, (double)tick_with(0.1f, 0).out_V.beta);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -1.5, (double)tick_with(2.0f, 0).out_V.beta);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.5, (double)tick_with(-2.0f, 0).out_V.beta);
}

static void test_a_shaft_is_still_when_one_count_is_all(void)
{
    for (int k = 0; k < 1000; k++) {
        (void)tick_with(0.0f, k % 2);
    }
    TEST_ASSERT_TRUE(commission_vector_still(&vector, 0.19f));
    TEST_ASSERT_FALSE(commission_vector_still(&vector, 0.21f));
    (void)tick_with(0.0f, 3);
    TEST_ASSERT_FALSE(commission_vector_still(&vector, 0.001f));
}

/* Shares of the last value after one time constant: 1 - 1/e. */
static void test_means_of_voltage_and_current(void)
{
    for (int k = 0; k < 250; k++) {
        const commission_signal_t s = {
            .i_A = {0.0f, -2.0f}, .v_V = {8.0f, 0.0f}, .dc_link_V = 540.0f};
        (void)commission_vector_tick(&vector, &s, 0.0f, 0.0f, 0.0f);
        if (k == 99) { /* 20 ms */
            TEST_ASSERT_FLOAT_WITHIN(0.03f, 8.0f * 0.632f, vector.brisk_V);
        }
    }
    TEST_ASSERT_FLOAT_WITHIN(0.03f, 8.0f * 0.632f, vector.mean_V);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, -2.0f * 0.632f, vector.cross_A);
}

/* A shaft that has moved within 50 ms may induce any voltage. */
static void test_a_shaft_that_stands_needs_no_more_than_its_voltage(void)
{
    for (int k = 0; k < 2; k++) {
        vector.still_ticks = (k == 0) ? 249 : 251;
        vector.brisk_V     = 4.9f;
        TEST_ASSERT_TRUE(commission_vector_stands(&vector, 5.0f));
        vector.brisk_V = 5.1f;
        TEST_ASSERT_EQUAL_INT(k == 0, commission_vector_stands(&vector, 5.0f));
        vector.brisk_V = -5.1f;
        TEST_ASSERT_EQUAL_INT(k == 0, commission_vector_stands(&vector, 5.0f));
    }
}

static void test_counter_may_wrap(void)
{
    for (int k = 0; k < 500; k++) {
        (void)tick_with(0.0f, (k % 2 == 0) ? INT32_MAX : INT32_MIN);
    }
    TEST_ASSERT_TRUE(commission_vector_still(&vector, 0.09f));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_current_reaches_its_length_without_overshoot);
    RUN_TEST(test_current_across_is_left_to_the_winding_up_to_a_bound);
    RUN_TEST(test_a_swing_is_timed_and_damped);
    RUN_TEST(test_a_current_off_its_reference_strays);
    RUN_TEST(test_the_added_resistance_takes_a_limited_voltage);
    RUN_TEST(test_a_shaft_is_still_when_one_count_is_all);
    RUN_TEST(test_means_of_voltage_and_current);
    RUN_TEST(test_a_shaft_that_stands_needs_no_more_than_its_voltage);
    RUN_TEST(test_counter_may_wrap);
    return UNITY_END();
}
