/* SPDX-License-Identifier: MIT */
#include "nodo_encoder.h"

#include "gain_tables.h"
#include "law_constants.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_CORRECT 3.0e-6 /* of the sum of the absolute summands */
#define TOL_PREDICT 1.5e-6 /* likewise */
#define TOL_ANGLE   1.0e-6 /* rad within +-pi */

#define CASES 3000
#define TS_s  2.0e-4f

enum { N_X = NODO_ENCODER_N_X, N_Y = NODO_ENCODER_N_Y };

static const double turn_rad = 6.283185307179586;

static support_random_t     random_state;
static nodo_encoder_gains_t gains;
static motor_reduced_t      motor;
static nodo_t               x;
static float                theta_rad;

void setUp(void)
{
    random_state.state = 31u;
    gains              = law_constants_noc(&gain_tables_drive)->nodo;
    motor              = gain_tables_drive.motor;
    x                  = support_random_estimate(&random_state);
    theta_rad          = 0.5f;
}

void tearDown(void) {}

typedef struct {
    double at[N_X];
} state_t;

static state_t state_of(const nodo_t *estimate, float angle)
{
    const state_t s = {{(double)estimate->d_omega, (double)estimate->d_q, (double)estimate->d_d,
                        (double)estimate->omega_e_radps, (double)estimate->iq_A,
                        (double)estimate->id_A, (double)angle}};
    return s;
}

static double wrapped(double angle)
{
    return remainder(angle, turn_rad);
}

/* The last entry is an angle: compared around the circle. */
static void assert_state(const state_t *expected, const state_t *size, double tolerance)
{
    const state_t now = state_of(&x, theta_rad);
    for (int row = 0; row < N_X - 1; row++) {
        TEST_ASSERT_DOUBLE_WITHIN(tolerance * (size->at[row] + 1.0e-9), expected->at[row],
                                  now.at[row]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(TOL_ANGLE + (tolerance * size->at[N_X - 1]), 0.0,
                              wrapped(now.at[N_X - 1] - expected->at[N_X - 1]));
}

static void draw_gains(int16_t order)
{
    gains.order    = order;
    gains.iq_max_A = support_uniform(&random_state, 2.0f, 8.0f);
    for (int n = 0; n <= NODO_ORDER_MAX; n++) {
        for (int i = 0; i < N_X * N_Y; i++) {
            gains.gain[n][i / N_Y][i % N_Y] = (n > order) ? NAN
                                              : support_parity(i / N_Y, i % N_Y, 1, n)
                                                  ? support_uniform(&random_state, -3.0e3f, 3.0e3f)
                                                  : 0.0f;
        }
    }
}

typedef struct {
    dq_t  i_A;
    float angle_error;
} innovation_t;

static innovation_t draw_innovation(void)
{
    innovation_t y;
    y.i_A.d       = support_uniform(&random_state, -8.0f, 8.0f);
    y.i_A.q       = support_uniform(&random_state, -8.0f, 8.0f);
    y.angle_error = support_uniform(&random_state, -0.3f, 0.3f);
    return y;
}

static void correct(innovation_t y)
{
    nodo_encoder_correct(&x, &theta_rad, &gains, y.i_A, y.angle_error, TS_s);
}

/* Oracle for EQ-NODO-ENCODER-1 and 3: L formed as a matrix, power by power, times y - C x^. */
static state_t oracle_correct(innovation_t y, state_t *size)
{
    const state_t before = state_of(&x, theta_rad);
    const double  iq = support_limit(before.at[4], -(double)gains.iq_max_A, (double)gains.iq_max_A);
    const double  r[N_Y] = {(double)y.i_A.q - before.at[4], (double)y.i_A.d - before.at[5],
                            (double)y.angle_error};
    state_t       after  = before;
    for (int row = 0; row < N_X; row++) {
        size->at[row] = fabs(before.at[row]);
        for (int column = 0; column < N_Y; column++) {
            double l = 0.0;
            for (int n = 0; n <= gains.order; n++) {
                const double term = pow(iq, (double)n) * (double)gains.gain[n][row][column];
                l += term;
                size->at[row] += (double)TS_s * fabs(term * r[column]);
            }
            after.at[row] += (double)TS_s * l * r[column];
        }
    }
    return after;
}

static void test_correction_matches_matrices(void)
{
    for (int n = 0; n < CASES; n++) {
        state_t size;
        draw_gains((int16_t)(n % (NODO_ORDER_MAX + 1)));
        x         = support_random_estimate(&random_state);
        theta_rad = support_uniform(&random_state, -3.1f, 3.1f);
        gains.gain[0][N_X - 1][0] *= 1.0e-3f;
        const innovation_t y        = draw_innovation();
        const state_t      expected = oracle_correct(y, &size);

        if (fabs(expected.at[N_X - 1]) < 9.0) { /* the angle stays within the range of one wrap */
            correct(y);
            assert_state(&expected, &size, TOL_CORRECT);
        }
    }
}

static void test_correction_with_the_gains_of_a_drive_matches_matrices(void)
{
    for (int n = 0; n < CASES; n++) {
        state_t size;
        x                           = support_random_estimate(&random_state);
        theta_rad                   = support_uniform(&random_state, -3.1f, 3.1f);
        const innovation_t y        = draw_innovation();
        const state_t      expected = oracle_correct(y, &size);

        correct(y);

        assert_state(&expected, &size, TOL_CORRECT);
    }
}

static void test_perfect_estimate_is_not_corrected(void)
{
    const nodo_t       before = x;
    const innovation_t y      = {{.d = x.id_A, .q = x.iq_A}, 0.0f};

    correct(y);

    TEST_ASSERT_TRUE((x.d_omega == before.d_omega) && (x.d_q == before.d_q) &&
                     (x.d_d == before.d_d));
    TEST_ASSERT_TRUE((x.omega_e_radps == before.omega_e_radps) && (x.iq_A == before.iq_A) &&
                     (x.id_A == before.id_A) && (theta_rad == 0.5f));
}

/* Change by a correction of the present estimate. */
static state_t change(innovation_t y)
{
    const nodo_t  start  = x;
    const state_t before = state_of(&x, theta_rad);
    correct(y);
    state_t difference = state_of(&x, theta_rad);
    for (int row = 0; row < N_X; row++) {
        difference.at[row] -= before.at[row];
    }
    x         = start;
    theta_rad = 0.5f;
    return difference;
}

static void test_correction_is_linear_in_the_innovation(void)
{
    const nodo_t still = {0.0f, 0.0f, 0.0f, 0.0f, 3.0f, -1.0f};
    x                  = still; /* small numbers, so that differences keep their digits */
    for (int n = 0; n < CASES; n++) {
        const innovation_t a    = draw_innovation();
        const innovation_t b    = draw_innovation();
        const innovation_t both = {
            {.d = a.i_A.d + b.i_A.d - x.id_A, .q = a.i_A.q + b.i_A.q - x.iq_A},
            a.angle_error + b.angle_error};

        const state_t of_a    = change(a);
        const state_t of_b    = change(b);
        const state_t of_both = change(both);

        for (int row = 0; row < N_X; row++) {
            const double size = fabs(of_a.at[row]) + fabs(of_b.at[row]);
            TEST_ASSERT_DOUBLE_WITHIN((1.0e-4 * size) + 2.0e-3, of_a.at[row] + of_b.at[row],
                                      of_both.at[row]);
        }
    }
}

/* Beyond iq_max_A the gain is held, the innovation is not. */
static void test_series_is_held_beyond_its_range(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        draw_gains(3);
        gains.iq_max_A            = 4.0f;
        x.iq_A                    = 4.0f * (float)sign;
        const innovation_t at     = {{.d = x.id_A + 0.5f, .q = x.iq_A + 0.25f}, 0.01f};
        const state_t      held   = change(at);
        x.iq_A                    = 7.0f * (float)sign;
        const innovation_t beyond = {{.d = x.id_A + 0.5f, .q = x.iq_A + 0.25f}, 0.01f};

        const state_t out = change(beyond);

        for (int row = 0; row < N_X; row++) {
            TEST_ASSERT_DOUBLE_WITHIN(1.0e-3 + (1.0e-5 * fabs(held.at[row])), held.at[row],
                                      out.at[row]);
        }
    }
}

static void test_powers_beyond_the_order_are_not_used(void)
{
    draw_gains(2); /* the powers above are not numbers */
    correct(draw_innovation());

    TEST_ASSERT_TRUE(isfinite(x.d_omega) && isfinite(x.iq_A) && isfinite(theta_rad));
}

/* EQ-MOTOR-2 in double. */
static state_t derivative(const state_t *s, dq_t v_V)
{
    const double w = s->at[3], iq = s->at[4], id = s->at[5];
    state_t      f = {{0.0}};
    f.at[3] =
        ((double)motor.l1 * iq) - ((double)motor.l2 * w) + ((double)motor.l11 * iq * id) + s->at[0];
    f.at[4] = ((double)motor.l6 * (double)v_V.q) - ((double)motor.l4 * iq) -
              ((double)motor.l5 * w) - ((double)motor.l10 * id * w) + s->at[1];
    f.at[5] = ((double)motor.l8 * (double)v_V.d) - ((double)motor.l7 * id) +
              ((double)motor.l9 * iq * w) + s->at[2];
    f.at[6] = w;
    return f;
}

static state_t advanced(const state_t *s, const state_t *f, double h)
{
    state_t out = *s;
    for (int row = 0; row < N_X; row++) {
        out.at[row] += h * f->at[row];
    }
    return out;
}

static state_t midpoint(const state_t *s, dq_t v_V, double h)
{
    const state_t f0     = derivative(s, v_V);
    const state_t middle = advanced(s, &f0, 0.5 * h);
    const state_t f1     = derivative(&middle, v_V);
    return advanced(s, &f1, h);
}

/* The motor itself: two hundred midpoint steps. */
static state_t motor_after(const state_t *s, dq_t v_V, double h)
{
    state_t out = *s;
    for (int n = 0; n < 200; n++) {
        out = midpoint(&out, v_V, h / 200.0);
    }
    return out;
}

static dq_t draw_voltage(void)
{
    dq_t v_V;
    v_V.d = support_uniform(&random_state, -170.0f, 170.0f);
    v_V.q = support_uniform(&random_state, -170.0f, 170.0f);
    return v_V;
}

static void test_prediction_matches_the_midpoint_rule(void)
{
    for (int odd = 0; odd < 2; odd++) {
        motor = (odd == 0) ? gain_tables_drive.motor : support_odd_motor();
        for (int n = 0; n < CASES; n++) {
            state_t size           = {{1.0e-3, 1.0e-3, 1.0e-3, 4.0e3, 2.0e1, 2.0e1, 1.0}};
            x                      = support_random_estimate(&random_state);
            theta_rad              = support_uniform(&random_state, -3.1f, 3.1f);
            const dq_t    v_V      = draw_voltage();
            const state_t before   = state_of(&x, theta_rad);
            const state_t expected = midpoint(&before, v_V, (double)TS_s);

            nodo_encoder_predict(&x, &theta_rad, &motor, v_V, TS_s);

            assert_state(&expected, &size, TOL_PREDICT);
        }
    }
}

static void test_prediction_keeps_the_disturbances(void)
{
    const nodo_t before = x;

    nodo_encoder_predict(&x, &theta_rad, &motor, draw_voltage(), TS_s);

    TEST_ASSERT_TRUE((x.d_omega == before.d_omega) && (x.d_q == before.d_q) &&
                     (x.d_d == before.d_d));
}

/* Largest distance from the motor over random operating points, per row. */
static state_t worst_prediction(float ts_s)
{
    state_t worst      = {{0.0}};
    random_state.state = 5u;
    for (int n = 0; n < 100; n++) {
        x                    = support_random_estimate(&random_state);
        theta_rad            = 0.0f;
        const dq_t    v_V    = draw_voltage();
        const state_t before = state_of(&x, theta_rad);
        const state_t truth  = motor_after(&before, v_V, (double)ts_s);

        nodo_encoder_predict(&x, &theta_rad, &motor, v_V, ts_s);

        const state_t now = state_of(&x, theta_rad);
        for (int row = 0; row < N_X; row++) {
            worst.at[row] = fmax(worst.at[row], fabs(now.at[row] - truth.at[row]));
        }
    }
    return worst;
}

/* One step is wrong by a multiple of Ts^3: half the period, an eighth of the error. */
static void test_error_of_the_prediction_falls_with_the_third_power_of_the_period(void)
{
    const state_t whole = worst_prediction(2.0e-4f);
    const state_t half  = worst_prediction(1.0e-4f);

    for (int row = 3; row < N_X; row++) {
        const double ratio = whole.at[row] / half.at[row];
        TEST_ASSERT_TRUE((ratio > 7.2) && (ratio < 9.6));
    }
}

/* At the control period of a drive: bounds of the third order, wide operating range. */
static void test_prediction_is_close_to_the_motor(void)
{
    const state_t worst = worst_prediction(TS_s);

    TEST_ASSERT_TRUE(worst.at[3] < 1.0e-1);
    TEST_ASSERT_TRUE(worst.at[4] < 5.0e-2);
    TEST_ASSERT_TRUE(worst.at[5] < 5.0e-2);
    TEST_ASSERT_TRUE(worst.at[6] < 1.0e-4);
}

static void test_prediction_carries_the_angle_across_half_a_turn(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        const nodo_t coasting = {0.0f, 0.0f, 0.0f, 1000.0f * (float)direction, 0.0f, 0.0f};
        x                     = coasting;
        theta_rad             = 3.1f * (float)direction;

        nodo_encoder_predict(&x, &theta_rad, &motor, draw_voltage(), TS_s);

        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, (3.3 - turn_rad) * (double)direction, (double)theta_rad);
    }
}

static void test_correction_carries_the_angle_across_half_a_turn(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        x.iq_A         = 0.0f;
        theta_rad      = 3.14f * (float)direction;
        innovation_t y = {{.d = x.id_A, .q = x.iq_A}, 0.1f * (float)direction};
        const double step =
            (double)TS_s * (double)gains.gain[0][N_X - 1][2] * (double)y.angle_error;

        correct(y);

        TEST_ASSERT_DOUBLE_WITHIN(
            TOL_ANGLE, (3.14 * (double)direction) + step - (turn_rad * (double)direction),
            (double)theta_rad);
    }
}

/* Rotation reversed: speed, q quantities and angle change sign, the d axis stays. */
static void test_reversed_rotation_mirrors_the_estimates(void)
{
    for (int n = 0; n < CASES; n++) {
        x                              = support_random_estimate(&random_state);
        theta_rad                      = support_uniform(&random_state, -3.0f, 3.0f);
        const nodo_t       start       = x;
        const float        start_angle = theta_rad;
        const innovation_t y           = draw_innovation();
        const dq_t         v_V         = draw_voltage();
        correct(y);
        nodo_encoder_predict(&x, &theta_rad, &motor, v_V, TS_s);
        const nodo_t forwards       = x;
        const float  forwards_angle = theta_rad;

        const nodo_t       mirrored = {-start.d_omega,       -start.d_q,  start.d_d,
                                       -start.omega_e_radps, -start.iq_A, start.id_A};
        const innovation_t y_m      = {{.d = y.i_A.d, .q = -y.i_A.q}, -y.angle_error};
        const dq_t         v_m_V    = {.d = v_V.d, .q = -v_V.q};
        x                           = mirrored;
        theta_rad                   = -start_angle;
        correct(y_m);
        nodo_encoder_predict(&x, &theta_rad, &motor, v_m_V, TS_s);

        TEST_ASSERT_TRUE((x.d_omega == -forwards.d_omega) && (x.d_q == -forwards.d_q) &&
                         (x.d_d == forwards.d_d));
        TEST_ASSERT_TRUE((x.omega_e_radps == -forwards.omega_e_radps) &&
                         (x.iq_A == -forwards.iq_A) && (x.id_A == forwards.id_A));
        TEST_ASSERT_TRUE(theta_rad == -forwards_angle);
    }
}

/* Gains and prediction together: a motor under a load that the observer is not told is found. */
static void test_observer_finds_disturbances_and_state_of_a_motor(void)
{
    const nodo_t nothing = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    state_t      truth   = {{-1500.0, 200.0, -150.0, 250.0, 1.0, -0.4, 1.0}};
    x                    = nothing;
    x.omega_e_radps      = 240.0f;
    theta_rad            = 1.05f;
    for (int n = 0; n < 2500; n++) {
        /* about the voltage that holds the currents, moving a little */
        dq_t v_V;
        v_V.q =
            (float)(((21.77 * 0.9) + (1.694 * truth.at[3]) - (0.658 * 0.4 * truth.at[3])) / 8.779);
        v_V.d = (float)(((33.08 * -0.4) - (1.519 * 0.9 * truth.at[3])) / 13.34);
        v_V.q += support_uniform(&random_state, -5.0f, 5.0f);
        const innovation_t y = {{.d = (float)truth.at[5], .q = (float)truth.at[4]},
                                (float)wrapped(truth.at[6] - (double)theta_rad)};
        correct(y);
        nodo_encoder_predict(&x, &theta_rad, &motor, v_V, TS_s);
        truth       = motor_after(&truth, v_V, (double)TS_s);
        truth.at[6] = wrapped(truth.at[6]);
    }

    TEST_ASSERT_DOUBLE_WITHIN(30.0, -1500.0, (double)x.d_omega);
    TEST_ASSERT_DOUBLE_WITHIN(10.0, 200.0, (double)x.d_q);
    TEST_ASSERT_DOUBLE_WITHIN(10.0, -150.0, (double)x.d_d);
    TEST_ASSERT_DOUBLE_WITHIN(0.3, truth.at[3], (double)x.omega_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, 0.0, wrapped(truth.at[6] - (double)theta_rad));
}

static void test_not_a_number_is_not_hidden(void)
{
    innovation_t y = draw_innovation();
    y.angle_error  = NAN;
    correct(y);
    TEST_ASSERT_TRUE(isnan(x.omega_e_radps) && isnan(theta_rad));

    setUp();
    const dq_t bad_V = {.d = NAN, .q = NAN};
    nodo_encoder_predict(&x, &theta_rad, &motor, bad_V, TS_s);
    TEST_ASSERT_TRUE(isnan(x.iq_A) && isnan(x.id_A));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_correction_matches_matrices);
    RUN_TEST(test_correction_with_the_gains_of_a_drive_matches_matrices);
    RUN_TEST(test_perfect_estimate_is_not_corrected);
    RUN_TEST(test_correction_is_linear_in_the_innovation);
    RUN_TEST(test_series_is_held_beyond_its_range);
    RUN_TEST(test_powers_beyond_the_order_are_not_used);
    RUN_TEST(test_prediction_matches_the_midpoint_rule);
    RUN_TEST(test_prediction_keeps_the_disturbances);
    RUN_TEST(test_error_of_the_prediction_falls_with_the_third_power_of_the_period);
    RUN_TEST(test_prediction_is_close_to_the_motor);
    RUN_TEST(test_prediction_carries_the_angle_across_half_a_turn);
    RUN_TEST(test_correction_carries_the_angle_across_half_a_turn);
    RUN_TEST(test_reversed_rotation_mirrors_the_estimates);
    RUN_TEST(test_observer_finds_disturbances_and_state_of_a_motor);
    RUN_TEST(test_not_a_number_is_not_hidden);
    return UNITY_END();
}
