/* SPDX-License-Identifier: MIT */
#include "nodo_shaft.h"

#include "gain_tables.h"
#include "law_constants.h"
#include "shaft_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_CORRECT 3.0e-6 /* of the sum of the absolute summands; as test_nodo_encoder.c */
#define TOL_PREDICT 3.0e-6 /* likewise */
#define TOL_ANGLE   1.0e-6 /* rad within +-pi */

#define CASES 3000
#define TS_s  2.0e-4f

enum { N_X = 9, N_Y = NODO_ENCODER_N_Y, THETA = 6 };

static support_random_t   random_state;
static nodo_shaft_gains_t gains;
static motor_reduced_t    motor;
static nodo_shaft_t       s;

void setUp(void)
{
    random_state.state = 59u;
    gains              = law_constants_noc_shaft(&shaft_tables_drive)->nodo;
    motor              = shaft_tables_drive.motor;
    s.motor            = support_random_estimate(&random_state);
    s.theta_rad        = 0.5f;
    s.load_e_radps     = s.motor.omega_e_radps + support_uniform(&random_state, -30.0f, 30.0f);
    s.twist_rad        = support_uniform(&random_state, -0.05f, 0.05f);
}

void tearDown(void) {}

typedef struct {
    double at[N_X];
} state_t;

static state_t state_of(const nodo_shaft_t *of)
{
    const nodo_t *m   = &of->motor;
    const state_t now = {{(double)m->d_omega, (double)m->d_q, (double)m->d_d,
                          (double)m->omega_e_radps, (double)m->iq_A, (double)m->id_A,
                          (double)of->theta_rad, (double)of->load_e_radps, (double)of->twist_rad}};
    return now;
}

static void assert_state(const state_t *expected, const state_t *size, double tolerance)
{
    const state_t now = state_of(&s);

    for (int row = 0; row < N_X; row++) {
        const double off = now.at[row] - expected->at[row];

        if (row == THETA) {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_ANGLE + (tolerance * size->at[row]), 0.0,
                                      remainder(off, 6.283185307179586));
        } else {
            TEST_ASSERT_DOUBLE_WITHIN(tolerance * (size->at[row] + 1.0e-9), 0.0, off);
        }
    }
}

static float gain_of(int n, int row, int column)
{
    return (row < NODO_ENCODER_N_X) ? gains.motor.gain[n][row][column]
                                    : gains.load[row - NODO_ENCODER_N_X][n][column];
}

/* EQ-SHAFT-1: L formed as a matrix, times y - C x^. */
static void test_correction_is_the_series_times_the_innovation(void)
{
    for (int k = 0; k < CASES; k++) {
        setUp();
        random_state.state += (uint32_t)(7 * k);
        gains.motor.iq_max_A = support_uniform(&random_state, 2.0f, 8.0f);
        for (int n = 0; n < 2; n++) {
            for (int i = 0; i < N_X * N_Y; i++) {
                const int   row = i / N_Y;
                const float g   = support_parity(row, i % N_Y, 1, n)
                                      ? support_uniform(&random_state, -3.0e3f, 3.0e3f)
                                      : 0.0f;
                if (row < NODO_ENCODER_N_X) {
                    gains.motor.gain[n][row][i % N_Y] = g;
                } else {
                    gains.load[row - NODO_ENCODER_N_X][n][i % N_Y] = g;
                }
            }
        }
        s.motor           = support_random_estimate(&random_state);
        const dq_t   i_A  = {.d = support_uniform(&random_state, -8.0f, 8.0f),
                             .q = support_uniform(&random_state, -8.0f, 8.0f)};
        const float  e    = support_uniform(&random_state, -0.3f, 0.3f);
        state_t      want = state_of(&s);
        state_t      size = want;
        const double iq =
            support_limit(want.at[4], -(double)gains.motor.iq_max_A, (double)gains.motor.iq_max_A);
        const double r[N_Y] = {(double)i_A.q - want.at[4], (double)i_A.d - want.at[5], (double)e};

        for (int row = 0; row < N_X; row++) {
            size.at[row] = fabs(size.at[row]);
            for (int column = 0; column < N_Y; column++) {
                const double l0 = (double)TS_s * (double)gain_of(0, row, column) * r[column];
                const double l1 = (double)TS_s * (double)gain_of(1, row, column) * r[column] * iq;
                want.at[row] += l0 + l1;
                size.at[row] += fabs(l0) + fabs(l1);
            }
        }
        nodo_shaft_correct(&s, &gains, i_A, e, TS_s);
        assert_state(&want, &size, TOL_CORRECT);
    }
}

/* Two masses in SI units, and the currents: paper A (1) with EQ-CERT-9. */
typedef struct {
    double w, iq, id, theta, load, twist;
} plant_t;

static const double resonance = 2.0 * 3.14159265358979 * 220.0; /* of ipmsm_390w_shaft.toml */
static const double damping   = 0.02;
static const double share     = 0.5;

static plant_t rate_of(const plant_t *x, double vq, double vd, double d_omega)
{
    const double r =
        (resonance * resonance * x->twist) + (2.0 * damping * resonance * (x->w - x->load));
    const double a =
        (((double)motor.l1 + ((double)motor.l11 * x->id)) * x->iq) - ((double)motor.l2 * x->w);
    const plant_t f = {.w  = (a / (1.0 - share)) - (share * r),
                       .iq = -((double)motor.l4 * x->iq) -
                             (x->w * ((double)motor.l5 + ((double)motor.l10 * x->id))) +
                             ((double)motor.l6 * vq),
                       .id = -((double)motor.l7 * x->id) + ((double)motor.l9 * x->iq * x->w) +
                             ((double)motor.l8 * vd),
                       .theta = x->w,
                       .load  = ((1.0 - share) * r) + (d_omega / share),
                       .twist = x->w - x->load};
    return f;
}

static plant_t moved(const plant_t *x, const plant_t *f, double t)
{
    const plant_t y = {x->w + (t * f->w),       x->iq + (t * f->iq),
                       x->id + (t * f->id),     x->theta + (t * f->theta),
                       x->load + (t * f->load), x->twist + (t * f->twist)};
    return y;
}

static plant_t after_period(plant_t x, double vq, double vd, double d_omega)
{
    const int    steps = 40;
    const double h     = (double)TS_s / steps;

    for (int n = 0; n < steps; n++) {
        const plant_t k1 = rate_of(&x, vq, vd, d_omega);
        const plant_t x2 = moved(&x, &k1, 0.5 * h);
        const plant_t k2 = rate_of(&x2, vq, vd, d_omega);
        x                = moved(&x, &k2, h);
    }
    return x;
}

/* Voltages that hold the currents: then the torque is constant, and EQ-SHAFT-2 is exact. */
static void test_prediction_follows_two_masses_for_nine_oscillations(void)
{
    const double iq_A    = 1.3;
    const double id_A    = -0.2;
    const double d_omega = -2600.0;
    plant_t      plant   = {.w = 200.0, .iq = iq_A, .id = id_A, .load = 190.0};
    double       swing   = 0.0;

    s.motor.d_omega       = (float)d_omega;
    s.motor.d_q           = 0.0f;
    s.motor.d_d           = 0.0f;
    s.motor.omega_e_radps = 200.0f;
    s.motor.iq_A          = (float)iq_A;
    s.motor.id_A          = (float)id_A;
    s.theta_rad           = 0.0f;
    s.load_e_radps        = 190.0f;
    s.twist_rad           = 0.0f;
    for (int k = 0; k < 200; k++) {
        const double w = plant.w;
        const double vq =
            (((double)motor.l4 * iq_A) + (w * ((double)motor.l5 + ((double)motor.l10 * id_A)))) /
            (double)motor.l6;
        const double vd =
            (((double)motor.l7 * id_A) - ((double)motor.l9 * iq_A * w)) / (double)motor.l8;
        const dq_t v_V = {.d = (float)vd, .q = (float)vq};

        plant = after_period(plant, vq, vd, d_omega);
        nodo_shaft_predict(&s, &gains, &motor, v_V, TS_s);
        TEST_ASSERT_DOUBLE_WITHIN(0.1, plant.w, (double)s.motor.omega_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(0.1, plant.load, (double)s.load_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(2.0e-4, plant.twist, (double)s.twist_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, 0.0,
                                  remainder(plant.theta - (double)s.theta_rad, 6.283185307179586));
        TEST_ASSERT_DOUBLE_WITHIN(0.01, plant.iq, (double)s.motor.iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, plant.id, (double)s.motor.id_A);
        swing = fmax(swing, fabs(plant.w - plant.load));
    }
    TEST_ASSERT_TRUE(swing > 9.0);
}

/* One period from anywhere, in double precision as EQ-SHAFT-2 says. */
static void test_prediction_is_its_equation(void)
{
    for (int k = 0; k < CASES; k++) {
        setUp();
        random_state.state += (uint32_t)(11 * k);
        s.motor           = support_random_estimate(&random_state);
        s.theta_rad       = support_uniform(&random_state, -3.1f, 3.1f);
        s.load_e_radps    = support_uniform(&random_state, -900.0f, 900.0f);
        s.twist_rad       = support_uniform(&random_state, -0.1f, 0.1f);
        const dq_t    v_V = {.d = support_uniform(&random_state, -170.0f, 170.0f),
                             .q = support_uniform(&random_state, -170.0f, 170.0f)};
        const double  ts  = (double)TS_s;
        const state_t x   = state_of(&s);
        const double  uq  = ((double)motor.l6 * (double)v_V.q) + x.at[1];
        const double  ud  = ((double)motor.l8 * (double)v_V.d) + x.at[2];
        double        iq  = x.at[4];
        double        id  = x.at[5];
        double        w   = x.at[3];
        double        f[2];

        state_t want = x;
        for (int half = 1; half <= 2; half++) {
            f[0] =
                uq - ((double)motor.l4 * iq) - (w * ((double)motor.l5 + ((double)motor.l10 * id)));
            f[1] = ud - ((double)motor.l7 * id) + ((double)motor.l9 * iq * w);
            if (half == 1) {
                iq             = x.at[4] + (0.5 * ts * f[0]);
                id             = x.at[5] + (0.5 * ts * f[1]);
                const double a = iq * ((double)motor.l1 + ((double)motor.l11 * id));
                const double from[NODO_SHAFT_N_FROM] = {x.at[3], x.at[7], x.at[8], a, x.at[0]};
                const int    to[NODO_SHAFT_N_STEP]   = {3, 7, 8, 6};
                for (int i = 0; i < NODO_SHAFT_N_STEP; i++) {
                    double sum = (to[i] == THETA) ? x.at[6] : 0.0;
                    for (int j = 0; j < NODO_SHAFT_N_FROM; j++) {
                        sum += (double)gains.step[i][j] * from[j];
                    }
                    want.at[to[i]] = sum;
                }
                w = 0.5 * (x.at[3] + want.at[3]);
            }
        }
        want.at[4] += ts * f[0];
        want.at[5] += ts * f[1];
        const state_t size = {{fabs(x.at[0]), fabs(x.at[1]), fabs(x.at[2]),
                               2000.0 + fabs(x.at[3]) + fabs(x.at[7]), 20.0 + fabs(x.at[4]),
                               20.0 + fabs(x.at[5]), 1.0, 2000.0 + fabs(x.at[7]), 1.0}};

        nodo_shaft_predict(&s, &gains, &motor, v_V, TS_s);
        TEST_ASSERT_TRUE(fabs((double)s.theta_rad) <= 3.1415928);
        assert_state(&want, &size, TOL_PREDICT);
    }
}

static void test_start_is_at_the_measurement_without_twist(void)
{
    const nodo_meas_t y = {.omega_e_radps = 31.0f, .iq_A = 0.5f, .id_A = -0.25f};

    nodo_shaft_reset(&s, &y, 7.0f);
    TEST_ASSERT_TRUE((s.motor.omega_e_radps == 31.0f) && (s.load_e_radps == 31.0f));
    TEST_ASSERT_TRUE((s.twist_rad == 0.0f) && (s.motor.d_omega == 0.0f));
    TEST_ASSERT_TRUE((s.motor.iq_A == 0.5f) && (s.motor.id_A == -0.25f));
    TEST_ASSERT_TRUE(s.theta_rad == frames_wrap(7.0f));
}

static void assert_refused(float *number, float bad)
{
    const float good = *number;

    *number = bad;
    TEST_ASSERT_FALSE(nodo_shaft_check(&gains));
    *number = good;
    TEST_ASSERT_TRUE(nodo_shaft_check(&gains));
}

static void test_check_refuses_what_is_not_finite_or_of_the_other_parity(void)
{
    TEST_ASSERT_TRUE(nodo_shaft_check(&gains));
    for (int i = 0; i < NODO_SHAFT_N_STEP * NODO_SHAFT_N_FROM; i++) {
        assert_refused(&gains.step[i / NODO_SHAFT_N_FROM][i % NODO_SHAFT_N_FROM], NAN);
    }
    for (int i = 0; i < NODO_SHAFT_N_LOAD; i++) {
        for (int column = 0; column < N_Y; column++) {
            assert_refused(&gains.load[i][0][column], NAN);
            assert_refused(&gains.load[i][1][column], INFINITY);
        }
        assert_refused(&gains.load[i][0][1], 1.0f);
        assert_refused(&gains.load[i][1][0], 1.0f);
        assert_refused(&gains.load[i][1][2], 1.0f);
    }
    assert_refused(&gains.motor.iq_max_A, -1.0f);
    gains.motor.order = 0;
    TEST_ASSERT_FALSE(nodo_shaft_check(&gains));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_correction_is_the_series_times_the_innovation);
    RUN_TEST(test_prediction_follows_two_masses_for_nine_oscillations);
    RUN_TEST(test_prediction_is_its_equation);
    RUN_TEST(test_start_is_at_the_measurement_without_twist);
    RUN_TEST(test_check_refuses_what_is_not_finite_or_of_the_other_parity);
    return UNITY_END();
}
