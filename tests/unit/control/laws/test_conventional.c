/* SPDX-License-Identifier: MIT */
#include "conventional.h"

#include "drive_tick.h"
#include "law_constants.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

/* Relative to the sum of absolute values, which determines the rounding error. */
#define TOL_RELATIVE 1.5e-6

#define CASES 300
#define TS_s  2.0e-4f

static support_random_t     random_state;
static conventional_gains_t gains;
static motor_reduced_t      motor;

/* No zero anywhere: an exchange of rows, columns, terms or variables shows. */
static void fill_gains(int16_t order)
{
    gains.nosc_order    = order;
    gains.nodo_order    = order;
    gains.i_error_max_A = 1.5f;
    gains.i_max_A       = 1.25f;
    gains.i_certified_A = 2.5f;
    for (int i = 0; i < DOUBLE_SERIES_TERMS_MAX * NODO_N_X; i++) {
        for (int column = 0; column < 3; column++) {
            gains.gain[i][column] = support_uniform(&random_state, -1.0e4f, 1.0e4f);
            if (i < DOUBLE_SERIES_TERMS_MAX * NOSC_N_U) {
                gains.lambda[i][column] = support_uniform(&random_state, -100.0f, 100.0f);
            }
        }
    }
}

void setUp(void)
{
    random_state.state = 31u;
    motor              = support_odd_motor();
    fill_gains(DOUBLE_SERIES_ORDER_MAX);
}

void tearDown(void) {}

typedef struct {
    double value;
    double magnitude;
} sum_t;

static void add(sum_t *s, double term)
{
    s->value += term;
    s->magnitude += fabs(term);
}

static void assert_sum(sum_t s, float actual)
{
    TEST_ASSERT_DOUBLE_WITHIN(TOL_RELATIVE, 0.0, ((double)actual - s.value) / s.magnitude);
}

/* factor times row `row` of the series at (s1, s2), each within +-limit, applied to x; in double. */
static void add_series(sum_t *s, double factor, float (*table)[3], int rows, int row, int order,
                       double s1, double s2, double limit, const double x[3])
{
    const double a    = support_limit(s1, -limit, limit);
    const double b    = support_limit(s2, -limit, limit);
    int          term = 0;
    for (int degree = 0; degree <= order; degree++) {
        for (int m = 0; m <= degree; m++, term++) {
            for (int column = 0; column < 3; column++) {
                add(s, factor * pow(a, degree - m) * pow(b, m) *
                           (double)table[(term * rows) + row][column] * x[column]);
            }
        }
    }
}

/* EQ-CONVENTIONAL-1 and 2; errors reach beyond the range in which the series is used. */
static void test_feedback_matches_oracle_for_every_order(void)
{
    for (int16_t order = 0; order <= DOUBLE_SERIES_ORDER_MAX; order++) {
        fill_gains(order);
        for (int n = 0; n < CASES; n++) {
            const nosc_error_t e    = {support_uniform(&random_state, -50.0f, 50.0f),
                                       support_uniform(&random_state, -3.0f, 3.0f),
                                       support_uniform(&random_state, -3.0f, 3.0f)};
            const double       x[3] = {(double)e.omega_e_radps, (double)e.iq_A, (double)e.id_A};
            sum_t              q    = {0.0, 1.0e-9};
            sum_t              d    = {0.0, 1.0e-9};
            add_series(&q, -1.0, gains.lambda, 2, 0, order, x[1], x[2], 1.5, x);
            add_series(&d, -1.0, gains.lambda, 2, 1, order, x[1], x[2], 1.5, x);
            add(&q, -(double)motor.l10 * x[2] * x[0] * (double)motor.inv_l6);
            add(&d, (double)motor.l9 * x[1] * x[0] * (double)motor.inv_l8);

            const dq_t u_V = conventional_feedback_V(&gains, &motor, &e);

            assert_sum(q, u_V.q);
            assert_sum(d, u_V.d);
        }
    }
}

/* EQ-CONVENTIONAL-3 row by row. */
static void oracle_update(const nodo_t *est, const nodo_meas_t *y, dq_t v_V, int order, sum_t s[6])
{
    const double x[6] = {(double)est->d_omega,       (double)est->d_q,  (double)est->d_d,
                         (double)est->omega_e_radps, (double)est->iq_A, (double)est->id_A};
    const double ts   = (double)TS_s;
    const double iq   = support_limit(x[4], -2.5, 2.5);
    const double id   = support_limit(x[5], -2.5, 2.5);
    const double r[3] = {(double)y->omega_e_radps - x[3], (double)y->iq_A - x[4],
                         (double)y->id_A - x[5]};
    for (int row = 0; row < 6; row++) {
        s[row].value     = x[row];
        s[row].magnitude = fabs(x[row]) + 1.0e-9;
        add_series(&s[row], ts, gains.gain, 6, row, order, x[4], x[5], 1.25, r);
        if (row >= 3) {
            add(&s[row], ts * x[row - 3]);
        }
    }
    add(&s[3], ts * (double)motor.l1 * x[4]);
    add(&s[3], -ts * (double)motor.l2 * x[3]);
    add(&s[3], ts * (double)motor.l11 * iq * x[5]);
    add(&s[4], ts * (double)motor.l6 * (double)v_V.q);
    add(&s[4], -ts * (double)motor.l4 * x[4]);
    add(&s[4], -ts * (double)motor.l5 * x[3]);
    add(&s[4], -ts * (double)motor.l10 * id * x[3]);
    add(&s[5], ts * (double)motor.l8 * (double)v_V.d);
    add(&s[5], -ts * (double)motor.l7 * x[5]);
    add(&s[5], ts * (double)motor.l9 * iq * x[3]);
}

static void test_observer_step_matches_oracle_for_every_order(void)
{
    for (int16_t order = 0; order <= DOUBLE_SERIES_ORDER_MAX; order++) {
        fill_gains(order);
        for (int n = 0; n < CASES; n++) {
            const nodo_meas_t y   = support_random_meas(&random_state);
            const dq_t        v_V = {support_uniform(&random_state, -200.0f, 200.0f),
                                     support_uniform(&random_state, -200.0f, 200.0f)};
            nodo_t            x   = support_random_estimate(&random_state);
            sum_t             s[6];
            oracle_update(&x, &y, v_V, order, s);

            conventional_update(&x, &gains, &motor, &y, v_V, TS_s);

            assert_sum(s[0], x.d_omega);
            assert_sum(s[1], x.d_q);
            assert_sum(s[2], x.d_d);
            assert_sum(s[3], x.omega_e_radps);
            assert_sum(s[4], x.iq_A);
            assert_sum(s[5], x.id_A);
        }
    }
}

/* Constants of this law: the one-variable gains of the shipped speed form as its terms of order 0. */
static law_conventional_config_t conventional_constants(void)
{
    const law_noc_speed_config_t *from = law_constants_noc_speed(&speed_tables_drive);
    law_conventional_config_t     c    = {.near_optimal = from->near_optimal,
                                          .gains        = {.nosc_order    = 0,
                                                           .nodo_order    = 0,
                                                           .i_error_max_A = 2.0f,
                                                           .i_max_A       = 4.0f,
                                                           .i_certified_A = 8.0f}};
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < NOSC_N_U; row++) {
            c.gains.lambda[row][column] = from->near_optimal.nosc.lambda[0][row][column];
        }
        for (int row = 0; row < NODO_N_X; row++) {
            c.gains.gain[row][column] = from->nodo.gain[0][row][column];
        }
    }
    return c;
}

static drive_config_t conventional_drive(const law_conventional_config_t *constants)
{
    drive_config_t c = speed_tables_drive;
    c.law            = &law_conventional;
    c.constants      = constants;
    return c;
}

static const drive_sample_t sample = {.ia_A          = 0.3f,
                                      .ib_A          = -0.1f,
                                      .dc_link_V     = 295.0f,
                                      .theta_e_rad   = 0.2f,
                                      .omega_e_radps = 300.0f,
                                      .valid         = true};

static void test_tick_runs_the_observer_and_the_feedback_of_this_law(void)
{
    const law_conventional_config_t constants = conventional_constants();
    const drive_config_t            c         = conventional_drive(&constants);
    const drive_command_t           command   = {305.0f, true, 0.0f, NULL};
    test_constants_t                plain;
    const drive_config_t            noc = law_constants_copy(&plain, &speed_tables_drive);
    drive_t                         a;
    drive_t                         b;
    plain.noc_speed.near_optimal.nosc.order = 0;
    plain.noc_speed.nodo.order              = 0;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&a, &c));
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&b, &noc));

    for (int k = 0; k < 3; k++) {
        const nodo_t before = a.law.conventional.observer;
        const dq_t   v_V    = a.v_V;
        (void)drive_tick(&a, &sample, &command);
        (void)drive_tick(&b, &sample, &command);
        nodo_t expected = before;
        if (k > 0) { /* the first tick starts the observer */
            conventional_update(&expected, &constants.gains, &c.motor, &a.answer.now, v_V, c.ts_s);
            TEST_ASSERT_TRUE((expected.iq_A == a.law.conventional.observer.iq_A) &&
                             (expected.id_A == a.law.conventional.observer.id_A) &&
                             (expected.d_omega == a.law.conventional.observer.d_omega));
        }
    }
    TEST_ASSERT_EQUAL_INT(DRIVE_RUN, a.state);
    TEST_ASSERT_TRUE(a.law.conventional.observer.iq_A !=
                     b.law.noc_speed.observer.iq_A); /* l10 id w of the estimates */
    TEST_ASSERT_TRUE(a.v_V.d != b.v_V.d);            /* l9 e_iq e_w is not cancelled */
}

static void test_tick_takes_its_feedback_from_the_table_of_this_law(void)
{
    const drive_command_t           command   = {305.0f, true, 0.0f, NULL};
    const law_conventional_config_t constants = conventional_constants();
    law_conventional_config_t       stiffer   = constants;
    const drive_config_t            c         = conventional_drive(&constants);
    const drive_config_t            stiff     = conventional_drive(&stiffer);
    drive_t                         a;
    drive_t                         b;
    stiffer.gains.lambda[1][2] *= 1.5f; /* v_d per ampere of e_id */
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&a, &c));
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&b, &stiff));

    (void)drive_tick(&a, &sample, &command);
    (void)drive_tick(&b, &sample, &command);

    const double e_id_A = (double)(a.answer.now.id_A - a.answer.i_ref_A.d);
    const double more_V = -0.5 * (double)constants.gains.lambda[1][2] * e_id_A;
    TEST_ASSERT_TRUE(fabs(more_V) > 1.0);
    TEST_ASSERT_FALSE(a.v_limited || b.v_limited);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, more_V, (double)(b.v_V.d - a.v_V.d));
}

static void test_generated_tables_are_accepted_and_hold_both_series(void)
{
    const law_conventional_config_t *c = law_constants_conventional(&conventional_tables_drive);
    drive_t                          d;

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&d, &conventional_tables_drive));
    TEST_ASSERT_TRUE(conventional_tables_drive.law == &law_conventional);
    const conventional_gains_t *g = &c->gains;
    TEST_ASSERT_EQUAL_INT(2, g->nosc_order);
    TEST_ASSERT_EQUAL_INT(2, g->nodo_order);
    for (int column = 0; column < 3; column++) { /* EQ-NOSC-3 reads Lambda_00 */
        TEST_ASSERT_TRUE(g->lambda[0][column] == c->near_optimal.nosc.lambda[0][0][column]);
    }
    for (int term = 0; term < 6; term++) { /* the load alone: d_q and d_d have no gain */
        for (int column = 0; column < 3; column++) {
            TEST_ASSERT_TRUE(g->gain[(term * NODO_N_X) + 1][column] == 0.0f);
            TEST_ASSERT_TRUE(g->gain[(term * NODO_N_X) + 2][column] == 0.0f);
        }
    }
    TEST_ASSERT_TRUE(g->gain[0][0] > 0.0f);
    TEST_ASSERT_TRUE(g->gain[NODO_N_X][2] != 0.0f); /* term e_iq: d_w from the id residual */
}

static void expect_refused(const law_conventional_config_t *constants)
{
    const drive_config_t c = conventional_drive(constants);
    drive_t              d;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&d, &c));
}

static void test_constants_outside_their_range_are_refused(void)
{
    law_conventional_config_t c   = conventional_constants();
    const drive_config_t      all = conventional_drive(&c);
    drive_t                   d;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&d, &all));

    c.gains.nosc_order = DOUBLE_SERIES_ORDER_MAX + 1;
    expect_refused(&c);
    c                  = conventional_constants();
    c.gains.nosc_order = -1;
    expect_refused(&c);
    c                  = conventional_constants();
    c.gains.nodo_order = DOUBLE_SERIES_ORDER_MAX + 1;
    expect_refused(&c);
    c                  = conventional_constants();
    c.gains.nodo_order = -1;
    expect_refused(&c);
    c                     = conventional_constants();
    c.gains.i_error_max_A = 0.0f;
    expect_refused(&c);
    c               = conventional_constants();
    c.gains.i_max_A = NAN;
    expect_refused(&c);
    c                     = conventional_constants();
    c.gains.i_certified_A = 3.9f; /* below i_max_A */
    expect_refused(&c);
    c                                   = conventional_constants();
    c.near_optimal.nosc.lambda[0][0][1] = 0.0f; /* k_iq of EQ-NOSC-3 */
    expect_refused(&c);
    c                                 = conventional_constants();
    c.near_optimal.current_ref.mtpa_A = NAN;
    expect_refused(&c);
}

static void test_every_entry_of_the_tables_in_use_is_checked(void)
{
    for (int i = 0; i < 6 * NODO_N_X; i++) { /* order 2: six terms */
        law_conventional_config_t c = conventional_constants();
        c.gains.nosc_order          = 2;
        c.gains.nodo_order          = 2;
        c.gains.gain[i][i % 3]      = INFINITY;
        expect_refused(&c);
        if (i < 6 * NOSC_N_U) {
            c                        = conventional_constants();
            c.gains.nosc_order       = 2;
            c.gains.lambda[i][i % 3] = NAN;
            expect_refused(&c);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_feedback_matches_oracle_for_every_order);
    RUN_TEST(test_observer_step_matches_oracle_for_every_order);
    RUN_TEST(test_tick_runs_the_observer_and_the_feedback_of_this_law);
    RUN_TEST(test_tick_takes_its_feedback_from_the_table_of_this_law);
    RUN_TEST(test_generated_tables_are_accepted_and_hold_both_series);
    RUN_TEST(test_constants_outside_their_range_are_refused);
    RUN_TEST(test_every_entry_of_the_tables_in_use_is_checked);
    return UNITY_END();
}
