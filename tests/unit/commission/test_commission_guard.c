/* SPDX-License-Identifier: MIT */
#include "commission_guard.h"

#include "unit_support.h"
#include "unity.h"

#define TS_s    2.0e-4f
#define BOUND_A 3.0f
#define L_H     0.075f
#define R_Ohm   2.5f

static const commission_config_t config = {.ts_s = TS_s, .current_max_A = BOUND_A};
static commission_guard_t        guard;
static commission_result_t       known;
static float                     true_A; /* along alpha, without delay */

void setUp(void)
{
    const commission_result_t k = {.r_Ohm           = {R_Ohm, 0.0f},
                                   .ld_H            = {L_H, 0.0f},
                                   .lq_H            = {L_H, 0.0f},
                                   .counts_per_turn = 10000,
                                   .pole_pairs      = 2,
                                   .direction       = 1};
    known                       = k;
    true_A                      = 0.0f;
    commission_guard_start(&guard);
}

void tearDown(void) {}

typedef enum { LOOK, VECTOR, ROTOR, MAP } rule_t;

/* One period with this voltage along alpha. The sensors show gain times the current. */
static bool period(rule_t rule, float v_V, float gain, float offset_A)
{
    const commission_admittance_t y = {1.0f / L_H, 0.0f, 1.0f / L_H, 1.0f};
    true_A += TS_s * (v_V - (R_Ohm * true_A)) / L_H;
    const commission_signal_t s = {.i_A = {(gain * true_A) + offset_A, 0.0f}, .v_V = {v_V, 0.0f}};
    switch ((int)rule) {
    case LOOK:
        return commission_guard_look(&guard, &config, &s, &y);
    case VECTOR:
        return commission_guard_vector(&guard, &config, &s, &known);
    case MAP:
        return commission_guard_rotor(&guard, &config, &s, &known, COMMISSION_GUARD_MAP_MEAN);
    default:
        return commission_guard_rotor(&guard, &config, &s, &known, COMMISSION_GUARD_SPIN_MEAN);
    }
}

/* A square wave of 12 periods, 0.8 of the bound high. */
static float wave_V(int k)
{
    return (((k / 12) % 2) == 0) ? 75.0f : -75.0f;
}

static void test_a_live_sensor_passes(void)
{
    for (int rule = 0; rule <= MAP; rule++) {
        setUp();
        true_A = -0.4f * BOUND_A;
        for (int k = 0; k < 5000; k++) {
            TEST_ASSERT_TRUE(period((rule_t)rule, wave_V(k), 1.0f, 0.0f));
        }
    }
}

/* From now on the sensor shows nothing, or what it showed last. The voltage stays. */
static void expect_end(rule_t rule, float gain, bool frozen)
{
    setUp();
    true_A = -0.4f * BOUND_A;
    for (int k = 0; k < 24; k++) {
        TEST_ASSERT_TRUE(period(rule, wave_V(k), 1.0f, 0.0f));
    }
    const float last_A = true_A;
    for (int k = 0; k < 20; k++) {
        if (!period(rule, 150.0f, gain, frozen ? last_A : 0.0f)) {
            return;
        }
        TEST_ASSERT_TRUE(fabsf(true_A) < (1.5f * BOUND_A));
    }
    TEST_FAIL_MESSAGE("not found");
}

static void test_a_voltage_without_current_ends_it_below_the_bound(void)
{
    for (int rule = 0; rule <= MAP; rule++) {
        expect_end((rule_t)rule, 0.0f, false);
        expect_end((rule_t)rule, 0.0f, true);
        expect_end((rule_t)rule, -1.0f, false);
    }
}

/* Periods until a voltage that brings no measured current ends it. */
static int periods_with(rule_t rule, float v_V)
{
    int k = 0;
    setUp();
    while (period(rule, v_V, 0.0f, 0.0f) && (k < 2000)) {
        k++;
    }
    return k;
}

/* 20 V against 0.24 and 0.4 of R times the bound, 1.8 V and 3 V, in a mean of 0.1 s. */
static void test_a_mean_voltage_that_r_does_not_explain_ends_it(void)
{
    TEST_ASSERT_INT_WITHIN(2, 47, periods_with(MAP, 20.0f));
    TEST_ASSERT_INT_WITHIN(2, 81, periods_with(ROTOR, 20.0f));
    TEST_ASSERT_INT_WITHIN(100, 2000, periods_with(MAP, 1.7f));
    TEST_ASSERT_INT_WITHIN(100, 2000, periods_with(ROTOR, 2.9f));
}

/* 30 V in a sum of 24 periods against half of L times the bound: 0.1125 Wb of 0.144 Wb. */
static void test_flux_of_24_periods_ends_it(void)
{
    TEST_ASSERT_INT_WITHIN(2, 36, periods_with(ROTOR, 30.0f));
}

static void test_a_slow_voltage_is_no_matter_of_the_vector_rule(void)
{
    for (int k = 0; k < 5000; k++) {
        TEST_ASSERT_TRUE(period(VECTOR, 0.002f * (float)k, 1.0f, 0.0f));
    }
}

static void test_what_is_not_a_number_ends_it(void)
{
    for (int rule = 0; rule <= MAP; rule++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            setUp();
            TEST_ASSERT_TRUE(period((rule_t)rule, 0.0f, 1.0f, 0.0f));
            TEST_ASSERT_FALSE(period((rule_t)rule, support_not_finite[k], 1.0f, 0.0f));
        }
    }
}

static void test_look_agrees_with_the_check(void)
{
    const commission_admittance_t y = {1.0f / L_H, 0.0f, 1.0f / L_H, 1.0f};

    TEST_ASSERT_TRUE(commission_guard_agrees(&y, &known));
    known.ld_H.value = known.lq_H.value = 0.5f * L_H;
    TEST_ASSERT_FALSE(commission_guard_agrees(&y, &known));
    known.ld_H.value = known.lq_H.value = 2.0f * L_H;
    TEST_ASSERT_FALSE(commission_guard_agrees(&y, &known));
    known.ld_H.value = 0.0f;
    TEST_ASSERT_FALSE(commission_guard_agrees(&y, &known));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_live_sensor_passes);
    RUN_TEST(test_a_voltage_without_current_ends_it_below_the_bound);
    RUN_TEST(test_a_mean_voltage_that_r_does_not_explain_ends_it);
    RUN_TEST(test_flux_of_24_periods_ends_it);
    RUN_TEST(test_a_slow_voltage_is_no_matter_of_the_vector_rule);
    RUN_TEST(test_what_is_not_a_number_ends_it);
    RUN_TEST(test_look_agrees_with_the_check);
    return UNITY_END();
}
