/* SPDX-License-Identifier: MIT */
#include "double_series.h"

#include "unit_support.h"
#include "unity.h"

/* Relative to the sum of absolute values, which determines the rounding error. */
#define TOL_RELATIVE 1.5e-6

#define ROWS  5
#define CASES 200

static support_random_t random_state;
static float            table[DOUBLE_SERIES_TERMS_MAX * ROWS][DOUBLE_SERIES_COLUMNS];

/* No zero anywhere: an exchange of rows, columns, terms or variables shows. */
void setUp(void)
{
    random_state.state = 29u;
    for (int i = 0; i < DOUBLE_SERIES_TERMS_MAX * ROWS; i++) {
        for (int column = 0; column < DOUBLE_SERIES_COLUMNS; column++) {
            table[i][column] = support_uniform(&random_state, -100.0f, 100.0f);
        }
    }
}

void tearDown(void) {}

static void test_terms_are_numbered_by_degree_then_by_falling_first_power(void)
{
    int expected = 0;
    for (int16_t degree = 0; degree <= DOUBLE_SERIES_ORDER_MAX; degree++) {
        for (int16_t m = 0; m <= degree; m++) {
            TEST_ASSERT_EQUAL_INT(expected++, double_series_index((int16_t)(degree - m), m));
        }
    }
    TEST_ASSERT_EQUAL_INT(DOUBLE_SERIES_TERMS_MAX, expected);
}

/* EQ-DOUBLE-SERIES-1 term by term in double, the terms counted in the documented order. */
static double oracle(int row, int order, double_series_point_t at, const float x[3],
                     double *magnitude)
{
    double y    = 0.0;
    int    term = 0;
    *magnitude  = 1.0e-9;
    for (int degree = 0; degree <= order; degree++) {
        for (int m = 0; m <= degree; m++, term++) {
            const double factor = pow((double)at.s1, degree - m) * pow((double)at.s2, m);
            for (int column = 0; column < 3; column++) {
                const double part =
                    factor * (double)table[(term * ROWS) + row][column] * (double)x[column];
                y += part;
                *magnitude += fabs(part);
            }
        }
    }
    return y;
}

static void test_rows_match_the_sum_of_powers_for_every_order(void)
{
    for (int16_t order = 0; order <= DOUBLE_SERIES_ORDER_MAX; order++) {
        for (int n = 0; n < CASES; n++) {
            const int                   row = n % ROWS;
            const double_series_point_t at  = {support_uniform(&random_state, -2.0f, 2.0f),
                                               support_uniform(&random_state, -2.0f, 2.0f)};
            const float                 x[] = {support_uniform(&random_state, -50.0f, 50.0f),
                                               support_uniform(&random_state, -4.0f, 4.0f),
                                               support_uniform(&random_state, -4.0f, 4.0f)};
            double                      magnitude;
            const double                expected = oracle(row, order, at, x, &magnitude);

            const float y = double_series_row((const float(*)[3]) & table[row], ROWS, order, at, x);

            TEST_ASSERT_DOUBLE_WITHIN(TOL_RELATIVE, 0.0, ((double)y - expected) / magnitude);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_terms_are_numbered_by_degree_then_by_falling_first_power);
    RUN_TEST(test_rows_match_the_sum_of_powers_for_every_order);
    return UNITY_END();
}
