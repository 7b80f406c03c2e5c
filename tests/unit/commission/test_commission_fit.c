/* SPDX-License-Identifier: MIT */
#include "commission_fit.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_EXACT 2.0e-5 /* measured 3e-6: sums of 200 terms in single precision */
#define RUNS      300
#define EQUATIONS 200

static support_random_t random_state;

void setUp(void)
{
    random_state.state = 5u;
}

void tearDown(void) {}

static commission_fit_t drawn(float x0, float x1, float noise)
{
    commission_fit_t f;
    commission_fit_reset(&f);
    for (int k = 0; k < EQUATIONS; k++) {
        const float a = support_uniform(&random_state, -1.0f, 2.0f);
        const float b = support_uniform(&random_state, -1.0f, 1.0f);
        const float e = noise * support_uniform(&random_state, -1.0f, 1.0f);
        commission_fit_add(&f, a, b, (x0 * a) + (x1 * b) + e);
    }
    return f;
}

static void test_exact_equations_give_both_unknowns(void)
{
    const commission_fit_t    f = drawn(3.6f, -0.7f, 0.0f);
    const commission_fitted_t x = commission_fit_solve(&f);

    TEST_ASSERT_TRUE(x.valid);
    TEST_ASSERT_DOUBLE_WITHIN(3.6 * TOL_EXACT, 3.6, (double)x.x0);
    TEST_ASSERT_DOUBLE_WITHIN(3.6 * TOL_EXACT, -0.7, (double)x.x1);
}

/* 95 of 100 results are within twice the standard deviation, the share of a normal distribution. */
static void test_error_is_twice_the_scatter_of_many_fits(void)
{
    int within0 = 0;
    int within1 = 0;
    for (int run = 0; run < RUNS; run++) {
        const commission_fit_t    f = drawn(1.0f, 2.0f, 0.3f);
        const commission_fitted_t x = commission_fit_solve(&f);
        within0 += (fabsf(x.x0 - 1.0f) <= x.error0) ? 1 : 0;
        within1 += (fabsf(x.x1 - 2.0f) <= x.error1) ? 1 : 0;
    }

    TEST_ASSERT_INT_WITHIN(12, 286, within0);
    TEST_ASSERT_INT_WITHIN(12, 286, within1);
}

static void test_columns_that_are_the_same_are_refused(void)
{
    commission_fit_t f;
    commission_fit_reset(&f);
    for (int k = 1; k < 20; k++) {
        commission_fit_add(&f, (float)k, 2.0f * (float)k, (float)k);
    }

    TEST_ASSERT_FALSE(commission_fit_solve(&f).valid);
}

static void test_too_few_and_no_numbers_are_refused(void)
{
    commission_fit_t f;
    commission_fit_reset(&f);
    TEST_ASSERT_FALSE(commission_fit_solve(&f).valid);

    commission_fit_add(&f, 1.0f, 1.0f, 1.0f);
    TEST_ASSERT_FALSE(commission_fit_solve(&f).valid);

    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        f = drawn(1.0f, 1.0f, 0.0f);
        commission_fit_add(&f, support_not_finite[k], 1.0f, 1.0f);
        TEST_ASSERT_FALSE(commission_fit_solve(&f).valid);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_exact_equations_give_both_unknowns);
    RUN_TEST(test_error_is_twice_the_scatter_of_many_fits);
    RUN_TEST(test_columns_that_are_the_same_are_refused);
    RUN_TEST(test_too_few_and_no_numbers_are_refused);
    return UNITY_END();
}
