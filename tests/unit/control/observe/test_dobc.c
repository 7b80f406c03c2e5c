/* SPDX-License-Identifier: MIT */
#include "dobc.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_RELATIVE 1.5e-6 /* of the sum of absolute values; worst 3e-7 */

#define CASES 300

static support_random_t random_state;
static dobc_config_t    config;
static dobc_t           dobc;

static void fill(float *x, int count)
{
    for (int i = 0; i < count; i++) {
        x[i] = support_uniform(&random_state, -2.0f, 2.0f);
    }
}

/* No zero anywhere, also beyond n_x: an exchange or a step too far shows. */
void setUp(void)
{
    random_state.state = 5u;
    config.n_x         = DOBC_N_X_MAX;
    config.direct_Vs   = 0.0875f;
    config.ld_H        = 0.026f;
    config.k_omega_Vs  = 0.63f;
    fill(config.k_x, DOBC_N_X_MAX);
    fill(config.g, DOBC_N_X_MAX);
    fill(config.h, DOBC_N_X_MAX);
    for (int row = 0; row < DOBC_N_X_MAX; row++) {
        fill(config.m[row], DOBC_N_X_MAX);
    }
    dobc_reset(&dobc);
}

void tearDown(void) {}

/* EQ-DOBC-1 with friction, magnet and coupling. */
static void test_direct_voltage_holds_a_speed(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (0.0875 + (0.026 * -1.5)) * 400.0,
                              (double)dobc_direct_V(&config, 400.0f, -1.5f));
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, -0.0875 * 400.0,
                              (double)dobc_direct_V(&config, -400.0f, 0.0f));
}

/* Oracle for EQ-DOBC-2 and EQ-DOBC-3 in double; every term in `magnitude`. */
static double oracle_V(const dobc_t *s, double e, double step, double *x, double *magnitude)
{
    double u   = (double)config.k_omega_Vs * e;
    *magnitude = fabs(u);
    for (int i = 0; i < config.n_x; i++) {
        double term[2] = {(double)config.g[i] * step, (double)config.h[i] * (double)s->ui_V};
        double size    = fabs(term[0]) + fabs(term[1]);
        x[i]           = term[0] + term[1];
        for (int j = 0; j < config.n_x; j++) {
            x[i] += (double)config.m[i][j] * (double)s->x[j];
            size += fabs((double)config.m[i][j] * (double)s->x[j]);
        }
        u += (double)config.k_x[i] * x[i];
        *magnitude += fabs((double)config.k_x[i]) * size;
    }
    return u;
}

static void assert_one_update(float e_radps, bool first)
{
    const dobc_t before = dobc;
    const double step   = first ? 0.0 : (double)e_radps - (double)before.e_radps;
    double       x[DOBC_N_X_MAX];
    double       magnitude;
    const double expected_V = oracle_V(&before, (double)e_radps, step, x, &magnitude);

    const float u_V = dobc_update(&dobc, &config, e_radps);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_RELATIVE * magnitude, expected_V, (double)u_V);
    for (int i = 0; i < DOBC_N_X_MAX; i++) {
        const double expected = (i < config.n_x) ? x[i] : (double)before.x[i];
        TEST_ASSERT_DOUBLE_WITHIN(TOL_RELATIVE * magnitude, expected, (double)dobc.x[i]);
    }
}

static void test_recursion_matches_its_oracle_for_every_size(void)
{
    for (int16_t n = 1; n <= DOBC_N_X_MAX; n++) {
        config.n_x = n;
        for (int k = 0; k < CASES; k++) {
            dobc_reset(&dobc);
            fill(dobc.x, DOBC_N_X_MAX);
            dobc_realise(&dobc, support_uniform(&random_state, -200.0f, 200.0f));
            dobc.running = true;
            dobc.e_radps = support_uniform(&random_state, -50.0f, 50.0f);
            assert_one_update(support_uniform(&random_state, -50.0f, 50.0f), false);
        }
    }
}

static void test_first_update_makes_no_kick(void)
{
    assert_one_update(200.0f, true);
    TEST_ASSERT_TRUE(dobc.x[0] == 0.0f);
    dobc_realise(&dobc, 3.0f);
    assert_one_update(210.0f, false);
}

static void test_the_realised_voltage_is_what_the_observer_sees(void)
{
    (void)dobc_update(&dobc, &config, 1.0f);
    dobc_realise(&dobc, 0.0f);
    (void)dobc_update(&dobc, &config, 1.0f);
    TEST_ASSERT_TRUE(dobc.x[0] == 0.0f);

    dobc_realise(&dobc, 2.0f);
    (void)dobc_update(&dobc, &config, 1.0f);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 2.0 * (double)config.h[0], (double)dobc.x[0]);
}

static void test_reset_forgets(void)
{
    fill(dobc.x, DOBC_N_X_MAX);
    dobc_realise(&dobc, 9.0f);
    (void)dobc_update(&dobc, &config, 7.0f);

    dobc_reset(&dobc);

    TEST_ASSERT_FALSE(dobc.running);
    TEST_ASSERT_TRUE((dobc.ui_V == 0.0f) && (dobc.e_radps == 0.0f));
    for (int i = 0; i < DOBC_N_X_MAX; i++) {
        TEST_ASSERT_TRUE(dobc.x[i] == 0.0f);
    }
}

static void test_not_a_number_is_not_hidden(void)
{
    TEST_ASSERT_TRUE(isnan(dobc_update(&dobc, &config, NAN)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_direct_voltage_holds_a_speed);
    RUN_TEST(test_recursion_matches_its_oracle_for_every_size);
    RUN_TEST(test_first_update_makes_no_kick);
    RUN_TEST(test_the_realised_voltage_is_what_the_observer_sees);
    RUN_TEST(test_reset_forgets);
    RUN_TEST(test_not_a_number_is_not_hidden);
    return UNITY_END();
}
