/* SPDX-License-Identifier: MIT */
#include "nosc.h"

#include "law_constants.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

/* Relative to the sum of absolute values, which determines the rounding error. */
#define TOL_RELATIVE 1.3e-6 /* worst 2.6e-7 */
#define TOL_V        1.5e-3 /* V, shipped gains, speed errors up to 50 rad/s; worst 2.9e-4 */
#define TOL_A        3.6e-6 /* A, currents up to 12 A; worst 7.1e-7 */

#define CASES 500

enum { ROW_Q = 0, ROW_D = 1 };

static support_random_t random_state;
static nosc_gains_t     gains;

/* No zero but those of parity: an exchange of rows, columns or powers shows. */
static void fill_gains(int16_t order)
{
    gains.order          = order;
    gains.iq_error_max_A = 1.5f;
    gains.iq_speed_max_A = 100.0f;
    for (int n = 0; n <= NOSC_ORDER_MAX; n++) {
        for (int row = 0; row < NOSC_N_U; row++) {
            for (int column = 0; column < NOSC_N_E; column++) {
                const bool used = ((column == 2) == (row == ROW_D)) == ((n % 2) == 0);
                gains.lambda[n][row][column] =
                    used ? support_uniform(&random_state, -100.0f, 100.0f) : 0.0f;
            }
        }
    }
}

void setUp(void)
{
    random_state.state = 13u;
    fill_gains(NOSC_ORDER_MAX);
}

void tearDown(void) {}

/* Gains of the speed error's current, with the quotients that the tables hold. */
static void set_speed_gains(float k_w, float k_iq)
{
    gains.lambda[0][ROW_Q][0] = k_w;
    gains.lambda[0][ROW_Q][1] = k_iq;
    gains.speed_A_per_radps   = (k_w > 0.0f) ? (k_w / k_iq) : 0.0f;
    gains.speed_radps_per_A   = (k_w > 0.0f) ? (k_iq / k_w) : 0.0f;
}

static nosc_error_t random_error(float iq_max_A)
{
    nosc_error_t e;
    e.omega_e_radps = support_uniform(&random_state, -50.0f, 50.0f);
    e.iq_A          = support_uniform(&random_state, -iq_max_A, iq_max_A);
    e.id_A          = support_uniform(&random_state, -4.0f, 4.0f);
    return e;
}

/* Oracle for (26): forms Lambda(e_iq) power by power, in double. magnitude: sum of absolute values. */
static double oracle_V(const nosc_gains_t *g, int row, const nosc_error_t *e, double *magnitude)
{
    const double error[NOSC_N_E] = {(double)e->omega_e_radps, (double)e->iq_A, (double)e->id_A};
    const double limit           = (double)g->iq_error_max_A;
    const double eiq             = support_limit(error[1], -limit, limit);
    double       u               = 0.0;

    *magnitude = 1.0e-9; /* never zero */
    for (int column = 0; column < NOSC_N_E; column++) {
        for (int n = 0; n <= g->order; n++) {
            const double term =
                (double)g->lambda[n][row][column] * pow(eiq, (double)n) * error[column];
            u -= term;
            *magnitude += fabs(term);
        }
    }
    return u;
}

static void assert_relative(const nosc_gains_t *g, int row, const nosc_error_t *e, float actual)
{
    double       magnitude;
    const double expected = oracle_V(g, row, e, &magnitude);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_RELATIVE, 0.0, ((double)actual - expected) / magnitude);
}

static void test_zero_error_needs_no_voltage(void)
{
    const nosc_error_t e0 = {0.0f, 0.0f, 0.0f};

    const dq_t u_V = nosc_feedback_V(&gains, &e0);

    TEST_ASSERT_TRUE((u_V.d == 0.0f) && (u_V.q == 0.0f)); /* exact by design */
}

static void test_feedback_matches_matrix_oracle_for_every_order(void)
{
    for (int16_t order = 0; order <= NOSC_ORDER_MAX; order++) {
        fill_gains(order);
        for (int n = 0; n < CASES; n++) {
            const nosc_error_t e = random_error(1.5f);

            const dq_t u_V = nosc_feedback_V(&gains, &e);

            assert_relative(&gains, ROW_Q, &e, u_V.q);
            assert_relative(&gains, ROW_D, &e, u_V.d);
        }
    }
}

static void test_gain_is_held_beyond_the_certified_range(void)
{
    for (int step = -60; step <= 60; step++) {
        const nosc_error_t e = {40.0f, 0.1f * (float)step, 0.8f};

        const dq_t u_V = nosc_feedback_V(&gains, &e);

        assert_relative(&gains, ROW_Q, &e, u_V.q);
        assert_relative(&gains, ROW_D, &e, u_V.d);
    }
}

static void test_shipped_series_matches_oracle_in_volts(void)
{
    for (int n = 0; n < CASES; n++) {
        const nosc_gains_t *g = &law_constants_near_optimal(&speed_tables_drive)->nosc;
        const nosc_error_t  e = random_error(8.0f);
        double              magnitude;

        const dq_t u_V = nosc_feedback_V(g, &e);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, oracle_V(g, ROW_Q, &e, &magnitude), (double)u_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, oracle_V(g, ROW_D, &e, &magnitude), (double)u_V.d);
    }
}

static void test_voltage_is_linear_in_speed_and_d_current_errors(void)
{
    for (int n = 0; n < CASES; n++) {
        const nosc_error_t e     = random_error(1.5f);
        const nosc_error_t twice = {2.0f * e.omega_e_radps, e.iq_A, 2.0f * e.id_A};
        const nosc_error_t none  = {0.0f, e.iq_A, 0.0f};
        double             scale;
        (void)oracle_V(&gains, ROW_Q, &twice, &scale);

        const dq_t u_V       = nosc_feedback_V(&gains, &e);
        const dq_t u_twice_V = nosc_feedback_V(&gains, &twice);
        const dq_t u_none_V  = nosc_feedback_V(&gains, &none);

        TEST_ASSERT_DOUBLE_WITHIN(
            TOL_RELATIVE, 0.0,
            ((double)u_twice_V.q - (2.0 * (double)u_V.q) + (double)u_none_V.q) / scale);
    }
}

static void test_reversed_rotation_mirrors_the_shipped_law(void)
{
    for (int n = 0; n < CASES; n++) {
        const nosc_error_t e        = random_error(4.0f);
        const nosc_error_t mirrored = {-e.omega_e_radps, -e.iq_A, e.id_A};

        const dq_t u_V =
            nosc_feedback_V(&law_constants_near_optimal(&speed_tables_drive)->nosc, &e);
        const dq_t m_V =
            nosc_feedback_V(&law_constants_near_optimal(&speed_tables_drive)->nosc, &mirrored);

        TEST_ASSERT_TRUE((m_V.q == -u_V.q) && (m_V.d == u_V.d));
    }
}

static void test_infinite_current_error_does_not_reach_the_powers(void)
{
    const nosc_error_t e = {0.0f, 1.0e30f, 0.0f};

    const dq_t u_V = nosc_feedback_V(&law_constants_near_optimal(&speed_tables_drive)->nosc, &e);

    TEST_ASSERT_TRUE(isfinite(u_V.q) && isfinite(u_V.d));
}

static void test_not_a_number_is_not_hidden(void)
{
    const nosc_error_t bad[] = {{NAN, 0.0f, 0.0f}, {0.0f, NAN, 0.0f}, {0.0f, 0.0f, NAN}};

    for (int i = 0; i < SUPPORT_COUNT(bad); i++) {
        const dq_t u_V = nosc_feedback_V(&gains, &bad[i]);

        TEST_ASSERT_TRUE(isnan(u_V.q) && isnan(u_V.d));
    }
}

/* Oracle for EQ-NOSC-3: without a speed error term, the q current that gives the same v_q at n = 0. */
static void test_speed_current_gives_the_voltage_of_the_speed_error(void)
{
    set_speed_gains(44.5f, 187.0f);
    for (int step = -100; step <= 100; step++) {
        const float e_w = 0.5f * (float)step;

        const float iq_A = nosc_speed_current_A(&gains, e_w);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, -44.5 * (double)e_w / 187.0, (double)iq_A);
    }
}

static void test_quotients_are_those_of_the_gains_or_nothing(void)
{
    nosc_gains_t g = law_constants_near_optimal(&speed_tables_drive)->nosc;
    TEST_ASSERT_TRUE(nosc_check(&g));
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, (double)g.lambda[0][ROW_Q][0] / (double)g.lambda[0][ROW_Q][1],
                              (double)g.speed_A_per_radps);
    g.speed_radps_per_A *= 1.01f;
    TEST_ASSERT_FALSE(nosc_check(&g));
    g.speed_radps_per_A = 0.0f;
    TEST_ASSERT_FALSE(nosc_check(&g));
    g.speed_A_per_radps = 0.0f;
    TEST_ASSERT_TRUE(nosc_check(&g));
    g.lambda[0][ROW_Q][1] = 0.0f;
    TEST_ASSERT_FALSE(nosc_check(&g));
}

/* A number where parity says zero would not be multiplied: the table is of something else. */
static void test_table_against_parity_is_refused(void)
{
    for (int n = 0; n <= 2; n++) {
        for (int i = 0; i < NOSC_N_U * NOSC_N_E; i++) {
            nosc_gains_t g           = law_constants_near_optimal(&speed_tables_drive)->nosc;
            const int    row         = i / NOSC_N_E;
            const int    column      = i % NOSC_N_E;
            const bool   used        = ((column == 2) == (row == ROW_D)) == ((n % 2) == 0);
            g.lambda[n][row][column] = 1.0f;
            TEST_ASSERT_TRUE(nosc_check(&g) == used);
        }
    }
}

/* The q current that row v_q of EQ-NOSC-3 commands, in double. */
static double commanded_A(const nosc_gains_t *g, double e_w, double iq_ref_A)
{
    return iq_ref_A - ((double)g->lambda[0][ROW_Q][0] * e_w / (double)g->lambda[0][ROW_Q][1]);
}

static void test_limited_speed_error_limits_the_commanded_current(void)
{
    const nosc_gains_t *g = &law_constants_near_optimal(&speed_tables_drive)->nosc;
    for (int n = 0; n < CASES; n++) {
        const float        lo       = support_uniform(&random_state, -4.0f, 0.0f);
        const float        hi       = support_uniform(&random_state, 0.0f, 4.0f);
        const float        iq_ref_A = support_uniform(&random_state, lo, hi);
        const nosc_error_t e        = random_error(2.0f);
        const double       most_A   = (double)g->iq_speed_max_A;
        const double       asked_A  = commanded_A(g, (double)e.omega_e_radps, 0.0);
        const double       expected = support_limit(
                  (double)iq_ref_A + support_limit(asked_A, -most_A, most_A), (double)lo, (double)hi);

        const nosc_error_t limited = nosc_limit_speed_error(g, e, iq_ref_A, lo, hi);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, expected,
                                  commanded_A(g, (double)limited.omega_e_radps, (double)iq_ref_A));
        TEST_ASSERT_TRUE((limited.iq_A == e.iq_A) && (limited.id_A == e.id_A));
    }
}

static void test_speed_error_within_the_range_is_untouched(void)
{
    const nosc_gains_t *g = &law_constants_near_optimal(&speed_tables_drive)->nosc;
    for (int step = -50; step <= 50; step++) {
        const nosc_error_t e = {0.08f * (float)step, 0.3f, -0.2f}; /* asks for 0.96 A at most */

        const nosc_error_t limited = nosc_limit_speed_error(g, e, 0.5f, -0.5f, 1.5f);

        TEST_ASSERT_TRUE(limited.omega_e_radps == e.omega_e_radps); /* exact by design */
    }
}

static void test_empty_range_leaves_only_the_reference(void)
{
    const nosc_error_t e = {25.0f, 0.3f, -0.2f};

    const nosc_error_t limited = nosc_limit_speed_error(
        &law_constants_near_optimal(&speed_tables_drive)->nosc, e, 1.0f, 1.0f, 1.0f);

    TEST_ASSERT_TRUE(limited.omega_e_radps == 0.0f);
}

static void test_law_without_speed_gain_limits_nothing(void)
{
    for (int sign = -1; sign <= 0; sign++) {
        const nosc_error_t e = {25.0f, 0.3f, -0.2f};
        set_speed_gains((float)sign, 187.0f);

        const nosc_error_t limited = nosc_limit_speed_error(&gains, e, 1.0f, 2.0f, 3.0f);

        TEST_ASSERT_TRUE(limited.omega_e_radps == e.omega_e_radps);
    }
}

static void test_small_gains_limit_and_ask_like_large_ones(void)
{
    const nosc_error_t e = {25.0f, 0.3f, -0.2f};
    set_speed_gains(0.01f, 0.02f);

    const nosc_error_t limited = nosc_limit_speed_error(&gains, e, 1.0f, 0.0f, 2.0f);
    const float        iq_A    = nosc_speed_current_A(&gains, e.omega_e_radps);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 0.0, commanded_A(&gains, (double)limited.omega_e_radps, 1.0));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, -12.5, (double)iq_A);
    gains.iq_speed_max_A = 3.0f;
    TEST_ASSERT_TRUE(nosc_speed_current_A(&gains, e.omega_e_radps) == -3.0f);
    TEST_ASSERT_TRUE(nosc_speed_current_A(&gains, -e.omega_e_radps) == 3.0f);
}

static void test_bad_speed_error_is_limited_to_the_range(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        const nosc_gains_t *g = &law_constants_near_optimal(&speed_tables_drive)->nosc;
        const nosc_error_t  e = {support_not_finite[i], 0.0f, 0.0f};

        const nosc_error_t limited = nosc_limit_speed_error(g, e, 0.5f, -1.0f, 2.0f);

        const double iq_A = commanded_A(g, (double)limited.omega_e_radps, 0.5);
        TEST_ASSERT_TRUE((iq_A >= -1.0 - TOL_A) && (iq_A <= 2.0 + TOL_A));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_zero_error_needs_no_voltage);
    RUN_TEST(test_feedback_matches_matrix_oracle_for_every_order);
    RUN_TEST(test_gain_is_held_beyond_the_certified_range);
    RUN_TEST(test_shipped_series_matches_oracle_in_volts);
    RUN_TEST(test_voltage_is_linear_in_speed_and_d_current_errors);
    RUN_TEST(test_reversed_rotation_mirrors_the_shipped_law);
    RUN_TEST(test_infinite_current_error_does_not_reach_the_powers);
    RUN_TEST(test_not_a_number_is_not_hidden);
    RUN_TEST(test_speed_current_gives_the_voltage_of_the_speed_error);
    RUN_TEST(test_quotients_are_those_of_the_gains_or_nothing);
    RUN_TEST(test_table_against_parity_is_refused);
    RUN_TEST(test_limited_speed_error_limits_the_commanded_current);
    RUN_TEST(test_speed_error_within_the_range_is_untouched);
    RUN_TEST(test_empty_range_leaves_only_the_reference);
    RUN_TEST(test_law_without_speed_gain_limits_nothing);
    RUN_TEST(test_small_gains_limit_and_ask_like_large_ones);
    RUN_TEST(test_bad_speed_error_is_limited_to_the_range);
    return UNITY_END();
}
