/* SPDX-License-Identifier: MIT */
#include "nodo.h"

#include "law_constants.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

/* Relative to the largest summand of a row, which determines the rounding error. */
#define TOL_RELATIVE 1.4e-6 /* worst 2.7e-7 */

#define TOL_DISTURBANCE 5.0e-5 /* ratio, of a constant disturbance after 0.2 s; worst 1.0e-5 */

#define CASES 500
#define TS_s  2.0e-4f

static support_random_t random_state;
static nodo_gains_t     gains;
static motor_reduced_t  motor;

/* No zero but those of parity: an exchange of rows, columns or powers shows. */
static void fill_gains(int16_t order)
{
    gains.order          = order;
    gains.iq_max_A       = 1.5f;
    gains.iq_certified_A = 2.5f;
    for (int16_t n = 0; n <= NODO_ORDER_MAX; n++) {
        for (int row = 0; row < NODO_N_X; row++) {
            for (int column = 0; column < NODO_N_Y; column++) {
                gains.gain[n][row][column] = support_parity(row, column, 2, n)
                                                 ? support_uniform(&random_state, -1.0e4f, 1.0e4f)
                                                 : 0.0f;
            }
        }
    }
}

void setUp(void)
{
    random_state.state = 11u;
    motor              = support_odd_motor();
    fill_gains(NODO_ORDER_MAX);
}

void tearDown(void) {}

/* Oracle: x^ + Ts (A_d(iq^) x^ + u_d + L(iq^) (y - C_d x^)).
 * The matrices of (27), (28), (31), (39) are formed in double. `magnitude` is the sum of absolute
 * values. */
typedef struct {
    double x[NODO_N_X];
    double magnitude[NODO_N_X];
} oracle_t;

static void oracle_add(oracle_t *o, int row, double term)
{
    o->x[row] += term;
    o->magnitude[row] += fabs(term);
}

static oracle_t oracle_update(const nodo_t *est, const nodo_meas_t *y, dq_t v_V, double ts_s)
{
    const double x[NODO_N_X] = {(double)est->d_omega,       (double)est->d_q,  (double)est->d_d,
                                (double)est->omega_e_radps, (double)est->iq_A, (double)est->id_A};
    const double measured[NODO_N_Y] = {(double)y->omega_e_radps, (double)y->iq_A, (double)y->id_A};
    const double iq                 = x[4];
    const double held = support_limit(iq, -(double)gains.iq_max_A, (double)gains.iq_max_A);
    const double certified =
        support_limit(iq, -(double)gains.iq_certified_A, (double)gains.iq_certified_A);

    const double a_d[NODO_N_X][NODO_N_X] = {
        {0.0},
        {0.0},
        {0.0},
        {1.0, 0.0, 0.0, -(double)motor.l2, (double)motor.l1, (double)motor.l11 * certified},
        {0.0, 1.0, 0.0, -(double)motor.l5, -(double)motor.l4, 0.0},
        {0.0, 0.0, 1.0, (double)motor.l9 * certified, 0.0, -(double)motor.l7}};
    const double coupling      = -(double)motor.l10 * measured[2] * measured[0];
    const double u_d[NODO_N_X] = {0.0,
                                  0.0,
                                  0.0,
                                  0.0,
                                  coupling + ((double)motor.l6 * (double)v_V.q),
                                  (double)motor.l8 * (double)v_V.d};

    oracle_t o;
    for (int row = 0; row < NODO_N_X; row++) {
        o.x[row]         = x[row];
        o.magnitude[row] = fabs(x[row]);
        oracle_add(&o, row, ts_s * u_d[row]);
        for (int column = 0; column < NODO_N_X; column++) {
            oracle_add(&o, row, ts_s * a_d[row][column] * x[column]);
        }
        for (int n = 0; n <= gains.order; n++) {
            for (int column = 0; column < NODO_N_Y; column++) {
                const double l_n = (double)gains.gain[n][row][column];
                oracle_add(&o, row,
                           ts_s * l_n * pow(held, (double)n) * (measured[column] - x[3 + column]));
            }
        }
    }
    return o;
}

static void assert_row(const oracle_t *o, int row, float actual)
{
    TEST_ASSERT_DOUBLE_WITHIN(TOL_RELATIVE, 0.0, ((double)actual - o->x[row]) / o->magnitude[row]);
}

static void assert_matches(const oracle_t *o, const nodo_t *x)
{
    assert_row(o, 0, x->d_omega);
    assert_row(o, 1, x->d_q);
    assert_row(o, 2, x->d_d);
    assert_row(o, 3, x->omega_e_radps);
    assert_row(o, 4, x->iq_A);
    assert_row(o, 5, x->id_A);
}

static dq_t random_voltage(void)
{
    dq_t v_V;
    v_V.d = support_uniform(&random_state, -200.0f, 200.0f);
    v_V.q = support_uniform(&random_state, -200.0f, 200.0f);
    return v_V;
}

static void test_reset_takes_the_measurement_and_no_disturbance(void)
{
    const nodo_meas_t y = {.omega_e_radps = 300.0f, .iq_A = 1.5f, .id_A = -0.5f};
    nodo_t            x = support_random_estimate(&random_state);

    nodo_reset(&x, &y);

    TEST_ASSERT_TRUE((x.d_omega == 0.0f) && (x.d_q == 0.0f) && (x.d_d == 0.0f));
    TEST_ASSERT_TRUE((x.omega_e_radps == 300.0f) && (x.iq_A == 1.5f) && (x.id_A == -0.5f));
}

static void test_step_matches_matrix_oracle_for_every_order(void)
{
    for (int16_t order = 0; order <= NODO_ORDER_MAX; order++) {
        fill_gains(order);
        for (int n = 0; n < CASES; n++) {
            const nodo_meas_t y   = support_random_meas(&random_state);
            const dq_t        v_V = random_voltage();
            nodo_t            x   = support_random_estimate(&random_state);
            x.iq_A                = support_uniform(&random_state, -1.5f, 1.5f);
            const oracle_t o      = oracle_update(&x, &y, v_V, (double)TS_s);

            nodo_update(&x, &gains, &motor, &y, v_V, TS_s);

            assert_matches(&o, &x);
        }
    }
}

static void test_step_without_residual_is_the_model_alone(void)
{
    for (int n = 0; n < CASES; n++) {
        const nodo_meas_t y   = support_random_meas(&random_state);
        const dq_t        v_V = random_voltage();
        nodo_t            x   = support_random_estimate(&random_state);
        x.omega_e_radps       = y.omega_e_radps;
        x.iq_A                = y.iq_A;
        x.id_A                = y.id_A;
        const oracle_t o      = oracle_update(&x, &y, v_V, (double)TS_s);

        nodo_update(&x, &gains, &motor, &y, v_V, TS_s);

        assert_matches(&o, &x);
    }
}

static void test_series_is_held_beyond_its_range(void)
{
    gains = law_constants_noc_speed(&speed_tables_drive)->nodo;
    for (int step = -60; step <= 60; step++) {
        const nodo_meas_t y   = {.omega_e_radps = 300.0f, .iq_A = 1.0f, .id_A = -1.0f};
        const dq_t        v_V = {.d = -20.0f, .q = 70.0f};
        nodo_t            x   = {100.0f, 20.0f, -30.0f, 290.0f, 0.25f * (float)step, 0.5f};
        const oracle_t    o   = oracle_update(&x, &y, v_V, (double)TS_s);

        nodo_update(&x, &gains, &motor, &y, v_V, TS_s);

        assert_matches(&o, &x);
    }
}

static void test_estimates_at_rest_stay_at_rest(void)
{
    const nodo_meas_t y    = {0.0f, 0.0f, 0.0f};
    const dq_t        zero = {0.0f, 0.0f};
    nodo_t            x;
    nodo_reset(&x, &y);

    for (int n = 0; n < 100; n++) {
        nodo_update(&x, &gains, &motor, &y, zero, TS_s);
    }

    TEST_ASSERT_TRUE((x.d_omega == 0.0f) && (x.d_q == 0.0f) && (x.d_d == 0.0f));
    TEST_ASSERT_TRUE((x.omega_e_radps == 0.0f) && (x.iq_A == 0.0f) && (x.id_A == 0.0f));
}

/* Mirroring speed, q current, v_q and their disturbances mirrors the shipped observer. */
static void test_reversed_rotation_mirrors_the_estimates(void)
{
    for (int n = 0; n < CASES; n++) {
        const nodo_meas_t y   = support_random_meas(&random_state);
        const dq_t        v_V = random_voltage();
        nodo_t            x   = support_random_estimate(&random_state);
        const nodo_meas_t ym  = {-y.omega_e_radps, -y.iq_A, y.id_A};
        const dq_t        vm  = {.d = v_V.d, .q = -v_V.q};
        nodo_t            xm  = {-x.d_omega, -x.d_q, x.d_d, -x.omega_e_radps, -x.iq_A, x.id_A};

        nodo_update(&x, &law_constants_noc_speed(&speed_tables_drive)->nodo,
                    &speed_tables_drive.motor, &y, v_V, TS_s);
        nodo_update(&xm, &law_constants_noc_speed(&speed_tables_drive)->nodo,
                    &speed_tables_drive.motor, &ym, vm, TS_s);

        TEST_ASSERT_TRUE((xm.d_omega == -x.d_omega) && (xm.d_q == -x.d_q) && (xm.d_d == x.d_d));
        TEST_ASSERT_TRUE((xm.omega_e_radps == -x.omega_e_radps) && (xm.iq_A == -x.iq_A));
        TEST_ASSERT_TRUE(xm.id_A == x.id_A);
    }
}

/* A motor held at 300 rad/s, 1 A and -0.5 A by the voltage that balances three constant disturbances. */
static void test_constant_disturbances_are_found(void)
{
    const motor_reduced_t *m   = &speed_tables_drive.motor;
    const nodo_meas_t      y   = {.omega_e_radps = 300.0f, .iq_A = 1.0f, .id_A = -0.5f};
    const double           w   = 300.0;
    const double           d_w = -((double)m->l1 - ((double)m->l2 * w) - (0.5 * (double)m->l11));
    const double           d_q = 150.0;
    const double           d_d = -80.0;
    const double           v_q =
        ((double)m->l4 + ((double)m->l5 * w) - (0.5 * (double)m->l10 * w) - d_q) / (double)m->l6;
    const double v_d = ((-0.5 * (double)m->l7) - ((double)m->l9 * w) - d_d) / (double)m->l8;
    const dq_t   v_V = {.d = (float)v_d, .q = (float)v_q};
    nodo_t       x;
    nodo_reset(&x, &y);

    for (int n = 0; n < 1000; n++) {
        nodo_update(&x, &law_constants_noc_speed(&speed_tables_drive)->nodo, m, &y, v_V, TS_s);
    }

    TEST_ASSERT_DOUBLE_WITHIN(TOL_DISTURBANCE, 1.0, (double)x.d_omega / d_w);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_DISTURBANCE, 1.0, (double)x.d_q / d_q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_DISTURBANCE, 1.0, (double)x.d_d / d_d);
}

static void test_infinite_estimate_of_the_current_does_not_reach_the_powers(void)
{
    const nodo_meas_t y    = {0.0f, 0.0f, 0.0f};
    const dq_t        zero = {0.0f, 0.0f};
    nodo_t            x    = {0.0f, 0.0f, 0.0f, 0.0f, 1.0e20f, 0.0f};

    nodo_update(&x, &law_constants_noc_speed(&speed_tables_drive)->nodo, &motor, &y, zero, TS_s);

    TEST_ASSERT_TRUE(isfinite(x.d_omega) && isfinite(x.d_q) && isfinite(x.d_d));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_reset_takes_the_measurement_and_no_disturbance);
    RUN_TEST(test_step_matches_matrix_oracle_for_every_order);
    RUN_TEST(test_step_without_residual_is_the_model_alone);
    RUN_TEST(test_series_is_held_beyond_its_range);
    RUN_TEST(test_estimates_at_rest_stay_at_rest);
    RUN_TEST(test_reversed_rotation_mirrors_the_estimates);
    RUN_TEST(test_constant_disturbances_are_found);
    RUN_TEST(test_infinite_estimate_of_the_current_does_not_reach_the_powers);
    return UNITY_END();
}
