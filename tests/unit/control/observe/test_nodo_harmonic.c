/* SPDX-License-Identifier: MIT */
#include "nodo_harmonic.h"

#include "gain_tables.h"
#include "harmonic_tables.h"
#include "law_constants.h"
#include "nodo_encoder.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_CORRECT 3.0e-6 /* of the sum of the absolute summands; as test_nodo_encoder.c */
#define TOL_TURN    4.0e-5 /* of a pair's length after a hundred turns; worst 7e-6 */
#define TOL_VIEW    2.0e-5 /* of the sum of the absolute summands */

#define CASES 2000
#define TS_s  2.0e-4f

enum { N_BASE = NODO_HARMONIC_N_BASE, N_G = NODO_HARMONIC_N_G, N_MAX = NODO_HARMONIC_N_X_MAX };

static const double pi = 3.141592653589793;

static support_random_t      random_state;
static nodo_harmonic_gains_t gains;
static motor_reduced_t       motor;
static nodo_harmonic_t       s;

static float draw(float size)
{
    return support_uniform(&random_state, -size, size);
}

/* All channels, with orders that are neighbours, repeated and negative. */
static void draw_gains(float size)
{
    const nodo_harmonic_order_t pairs[NODO_HARMONIC_PAIRS_MAX] = {
        {NODO_HARMONIC_SENSOR, -1.0f},   {NODO_HARMONIC_SENSOR, -2.0f},
        {NODO_HARMONIC_VOLTAGE_Q, 6.0f}, {NODO_HARMONIC_VOLTAGE_D, 6.0f},
        {NODO_HARMONIC_TORQUE, 8.0f},    {NODO_HARMONIC_VOLTAGE_Q, 8.0f},
        {NODO_HARMONIC_TORQUE, 12.0f},   {NODO_HARMONIC_VOLTAGE_D, 2.0f}};

    gains.n_pairs        = NODO_HARMONIC_PAIRS_MAX;
    gains.n_nodes        = 5;
    gains.iq_max_A       = 4.0f;
    gains.nodes_per_root = 0.125f; /* nodes at 0, 64, 256, 576, 1024 rad/s */
    gains.keep           = 1.0f;
    gains.keep_fast      = 1.0f;
    for (int i = 0; i < NODO_HARMONIC_PAIRS_MAX; i++) {
        gains.pair[i] = pairs[i];
    }
    for (int node = 0; node < NODO_HARMONIC_NODES_MAX; node++) {
        for (int i = 0; i < N_MAX * N_G; i++) {
            gains.gain[i / N_G][node][i % N_G] = (node < gains.n_nodes) ? draw(size) : NAN;
        }
    }
}

static void draw_state(void)
{
    s.base            = support_random_estimate(&random_state);
    s.slope           = draw(1.0e4f);
    s.theta_rad       = draw(3.1f);
    s.theta_pairs_rad = frames_wrap(s.theta_rad + draw(0.1f));
    for (int i = 0; i < NODO_HARMONIC_PAIRS_MAX; i++) {
        s.pair[i].a = draw(10.0f);
        s.pair[i].b = draw(10.0f);
    }
}

void setUp(void)
{
    random_state.state = 47u;
    motor              = gain_tables_drive.motor;
    draw_gains(1.0f);
    draw_state();
}

void tearDown(void) {}

static nodo_harmonic_view_t predicted(nodo_harmonic_t *x, const nodo_harmonic_gains_t *g,
                                      const motor_reduced_t *m, dq_t v_V, float ts_s)
{
    nodo_harmonic_view_t view;

    nodo_harmonic_predict(x, g, m, v_V, ts_s, &view);
    return view;
}

/* Rows of the table in double; theta last of the first seven, then slope and pairs. */
typedef struct {
    double at[N_MAX];
} rows_t;

static rows_t rows_of(const nodo_harmonic_t *x)
{
    rows_t r = {{(double)x->base.d_omega, (double)x->base.d_q, (double)x->base.d_d,
                 (double)x->base.omega_e_radps, (double)x->base.iq_A, (double)x->base.id_A,
                 (double)x->theta_rad, (double)x->slope}};
    for (int i = 0; i < NODO_HARMONIC_PAIRS_MAX; i++) {
        r.at[N_BASE + (2 * i)]     = (double)x->pair[i].a;
        r.at[N_BASE + (2 * i) + 1] = (double)x->pair[i].b;
    }
    return r;
}

/* EQ-HARMONIC-3 as a matrix entry, at w >= 0. */
static double oracle_gain(int row, int column, double w, double iq_A)
{
    const double place = fmin((double)gains.nodes_per_root * sqrt(w), gains.n_nodes - 1.0);
    const int    below = (place >= gains.n_nodes - 1.0) ? gains.n_nodes - 2 : (int)place;
    const double share = place - below;
    const double held  = support_limit(iq_A, -(double)gains.iq_max_A, (double)gains.iq_max_A);
    double       sum   = 0.0;
    for (int node = below; node <= below + 1; node++) {
        const float *g = gains.gain[row][node];
        sum += ((node == below) ? (1.0 - share) : share) *
               ((double)g[column] + (held * (double)g[column + 3]));
    }
    return sum;
}

static void assert_corrected_as_the_oracle_says(dq_t i_A, float angle_error)
{
    const rows_t before = rows_of(&s);
    double r[3] = {(double)i_A.q - before.at[4], (double)i_A.d - before.at[5], (double)angle_error};
    double size[3];
    for (int i = 0; i < gains.n_pairs; i++) { /* EQ-HARMONIC-2 */
        if (gains.pair[i].channel == NODO_HARMONIC_SENSOR) {
            r[0] -= before.at[N_BASE + (2 * i) + 1];
            r[1] -= before.at[N_BASE + (2 * i)];
        }
    }
    for (int j = 0; j < 3; j++) {
        size[j] = fabs(r[j]) + ((j < 2) ? 40.0 : 0.0); /* what the residuals are differences of */
    }
    nodo_harmonic_correct(&s, &gains, i_A, angle_error);

    const rows_t after = rows_of(&s);
    for (int row = 0; row < N_BASE + (2 * gains.n_pairs); row++) {
        double expected = before.at[row];
        double allowed  = fabs(before.at[row]);
        for (int j = 0; j < 3; j++) {
            expected += oracle_gain(row, j, before.at[3], before.at[4]) * r[j];
            allowed += 5.0 * size[j]; /* |G_0 + iq G_1| of gains within one and |iq| <= 4 */
        }
        const double off = after.at[row] - expected;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_CORRECT * allowed, 0.0,
                                  (row == 6) ? remainder(off, 2.0 * pi) : off);
    }
}

/* Gains of a size that keeps the corrected angle within one wrap. */
static void small_angle_row(void)
{
    for (int node = 0; node < gains.n_nodes; node++) {
        for (int j = 0; j < N_G; j++) {
            gains.gain[6][node][j] *= 1.0e-2f;
        }
    }
}

static void test_correction_matches_matrices_between_at_and_beyond_the_nodes(void)
{
    const float at_nodes[] = {0.0f, 64.0f, 256.0f, 576.0f, 1024.0f, 1500.0f, 63.9f, 1.0e-6f};
    small_angle_row();
    for (int n = 0; n < CASES; n++) {
        draw_state();
        s.base.omega_e_radps =
            (n < SUPPORT_COUNT(at_nodes)) ? at_nodes[n] : fabsf(s.base.omega_e_radps);
        const dq_t i_A = {.d = draw(8.0f), .q = draw(8.0f)};
        assert_corrected_as_the_oracle_says(i_A, draw(0.3f));
    }
}

static void test_no_node_beyond_the_last_is_read(void)
{
    s.base.omega_e_radps = 1.0e6f; /* the nodes above are not numbers */
    const dq_t i_A       = {.d = 1.0f, .q = 1.0f};
    nodo_harmonic_correct(&s, &gains, i_A, 0.1f);

    TEST_ASSERT_TRUE(isfinite(s.base.d_omega) && isfinite(s.pair[7].b));
}

static void test_gain_is_held_beyond_its_current(void)
{
    const nodo_harmonic_t start = s;
    for (int direction = -1; direction <= 1; direction += 2) {
        nodo_harmonic_t out[2];
        for (int k = 0; k < 2; k++) {
            s              = start;
            s.base.iq_A    = (float)direction * ((k == 0) ? 4.0f : 7.0f);
            const dq_t i_A = {.d = s.base.id_A + 0.5f, .q = s.base.iq_A + 0.25f};
            nodo_harmonic_correct(&s, &gains, i_A, 0.01f);
            out[k] = s;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, (double)out[0].pair[4].a, (double)out[1].pair[4].a);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, (double)out[0].slope, (double)out[1].slope);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, (double)out[0].base.iq_A - 4.0 * direction,
                                  (double)out[1].base.iq_A - 7.0 * direction);
    }
}

/* Equal nodes and no iq: then the gains are Ts L_0 of the encoder form, and so must be the estimates. */
static void test_without_pairs_it_is_the_encoder_form(void)
{
    nodo_encoder_gains_t plain = law_constants_noc(&gain_tables_drive)->nodo;
    plain.order                = 0;
    gains.n_pairs              = 0;
    for (int node = 0; node < gains.n_nodes; node++) {
        for (int row = 0; row < N_BASE; row++) {
            for (int j = 0; j < N_G; j++) {
                const bool used          = (row < NODO_ENCODER_N_X) && (j < 3);
                gains.gain[row][node][j] = used ? (TS_s * plain.gain[0][row][j]) : 0.0f;
            }
        }
    }
    for (int n = 0; n < CASES; n++) {
        draw_state();
        s.slope           = 0.0f;
        nodo_t      x     = s.base;
        float       theta = s.theta_rad;
        const dq_t  i_A   = {.d = x.id_A + draw(0.2f), .q = x.iq_A + draw(0.2f)};
        const dq_t  v_V   = {.d = draw(170.0f), .q = draw(170.0f)};
        const float error = draw(0.02f);

        nodo_encoder_correct(&x, &theta, &plain, i_A, error, TS_s);
        nodo_encoder_predict(&x, &theta, &motor, v_V, TS_s);
        nodo_harmonic_correct(&s, &gains, i_A, error);
        const nodo_harmonic_view_t view = predicted(&s, &gains, &motor, v_V, TS_s);

        TEST_ASSERT_DOUBLE_WITHIN(2.0e-2, (double)x.d_omega, (double)view.total.d_omega); /* 1e4 */
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, (double)x.d_q, (double)view.total.d_q);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, (double)x.d_d, (double)view.total.d_d);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, (double)x.omega_e_radps,
                                  (double)view.total.omega_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (double)x.iq_A, (double)view.total.iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (double)x.id_A, (double)view.total.id_A);
        TEST_ASSERT_DOUBLE_WITHIN(2.0e-6, 0.0,
                                  remainder((double)theta - (double)s.theta_rad, 2.0 * pi));
        TEST_ASSERT_TRUE(view.d_omega_dot == 0.0f);
    }
}

static bool odd_a(int i)
{
    return (gains.pair[i].channel == NODO_HARMONIC_TORQUE) ||
           (gains.pair[i].channel == NODO_HARMONIC_VOLTAGE_Q);
}

static nodo_harmonic_t mirrored(const nodo_harmonic_t *x)
{
    nodo_harmonic_t m    = *x;
    m.base.d_omega       = -x->base.d_omega;
    m.base.d_q           = -x->base.d_q;
    m.base.omega_e_radps = -x->base.omega_e_radps;
    m.base.iq_A          = -x->base.iq_A;
    m.slope              = -x->slope;
    m.theta_rad          = -x->theta_rad;
    m.theta_pairs_rad    = -x->theta_pairs_rad;
    for (int i = 0; i < NODO_HARMONIC_PAIRS_MAX; i++) {
        m.pair[i].a = odd_a(i) ? -x->pair[i].a : x->pair[i].a;
        m.pair[i].b = odd_a(i) ? x->pair[i].b : -x->pair[i].b;
    }
    return m;
}

static void assert_same(const nodo_harmonic_t *x, const nodo_harmonic_t *y)
{
    const rows_t a = rows_of(x);
    const rows_t b = rows_of(y);
    for (int row = 0; row < N_MAX; row++) {
        TEST_ASSERT_TRUE(a.at[row] == b.at[row]);
    }
    TEST_ASSERT_TRUE(x->theta_pairs_rad == y->theta_pairs_rad);
}

/* EQ-HARMONIC-3: rotation reversed, bit for bit, over several periods in a row. */
static void test_reversed_rotation_mirrors_the_estimates(void)
{
    small_angle_row();
    for (int n = 0; n < CASES; n++) {
        draw_state();
        s.base.omega_e_radps += (s.base.omega_e_radps < 0.0f) ? -200.0f : 200.0f;
        nodo_harmonic_t m = mirrored(&s);
        for (int k = 0; k < 3; k++) {
            const dq_t  i_A   = {.d = draw(8.0f), .q = draw(8.0f)};
            const dq_t  i_m_A = {.d = i_A.d, .q = -i_A.q};
            const dq_t  v_V   = {.d = draw(170.0f), .q = draw(170.0f)};
            const dq_t  v_m_V = {.d = v_V.d, .q = -v_V.q};
            const float error = draw(0.1f);

            nodo_harmonic_correct(&s, &gains, i_A, error);
            nodo_harmonic_correct(&m, &gains, i_m_A, -error);
            const nodo_harmonic_view_t v = predicted(&s, &gains, &motor, v_V, TS_s);
            const nodo_harmonic_view_t w = predicted(&m, &gains, &motor, v_m_V, TS_s);

            const nodo_harmonic_t back = mirrored(&m);
            assert_same(&s, &back);
            TEST_ASSERT_TRUE((w.total.d_omega == -v.total.d_omega) &&
                             (w.total.d_q == -v.total.d_q) && (w.total.d_d == v.total.d_d) &&
                             (w.d_omega_dot == -v.d_omega_dot));
        }
    }
}

/* The base coasts: no disturbance, no current, no friction. */
static void coast_at(float omega_e_radps)
{
    const nodo_meas_t y = {omega_e_radps, 0.0f, 0.0f};
    motor.l2            = 0.0f;
    nodo_harmonic_reset(&s, &y, 0.3f);
}

/* EQ-HARMONIC-1: the phase of a pair against the angle never moves, whatever corrects the angle. */
static void test_pairs_stay_locked_to_the_angle(void)
{
    double order_angle = 0.0; /* of the pairs, since the start, in double */
    coast_at(700.0f);
    for (int i = 0; i < gains.n_pairs; i++) {
        s.pair[i].a = 0.6f;
        s.pair[i].b = 0.8f;
    }
    for (int k = 0; k < 5000; k++) { /* 111 turns */
        const double before  = (double)s.theta_pairs_rad;
        const dq_t   v_V     = {.d = 0.0f, .q = 0.0f};
        s.theta_rad          = frames_wrap(s.theta_rad + draw(0.02f));
        s.base.omega_e_radps = 700.0f;
        s.base.iq_A = s.base.id_A = 0.0f;
        for (int i = 0; i < gains.n_pairs; i++) { /* keep the motor where it is */
            s.base.d_omega = s.base.d_q = s.base.d_d = 0.0f;
        }
        (void)predicted(&s, &gains, &motor, v_V, TS_s);
        order_angle += remainder((double)s.theta_pairs_rad - before, 2.0 * pi);
    }
    TEST_ASSERT_TRUE(order_angle > 600.0);
    for (int i = 0; i < gains.n_pairs; i++) {
        const double turn  = (double)gains.pair[i].order * ((double)s.theta_pairs_rad - 0.3);
        const double a     = (0.6 * cos(turn)) - (0.8 * sin(turn));
        const double b     = (0.6 * sin(turn)) + (0.8 * cos(turn));
        const double drift = TOL_TURN * fmax(1.0, fabs((double)gains.pair[i].order)) * 10.0;
        TEST_ASSERT_DOUBLE_WITHIN(drift, a, (double)s.pair[i].a);
        TEST_ASSERT_DOUBLE_WITHIN(drift, b, (double)s.pair[i].b);
    }
    /* The pairs are predicted to the angle that the next correction moves: at most one correction behind. */
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 0.0,
                              remainder((double)s.theta_rad - (double)s.theta_pairs_rad, 2.0 * pi));
}

static void test_pairs_fade_with_keep_once_per_period(void)
{
    const nodo_harmonic_t start = s;
    const dq_t            v_V   = {.d = 3.0f, .q = 5.0f};
    nodo_harmonic_t       whole;
    (void)predicted(&s, &gains, &motor, v_V, TS_s);
    whole           = s;
    s               = start;
    gains.keep      = 0.5f;
    gains.keep_fast = 0.5f; /* some of the drawn speeds are beyond the limit */
    (void)predicted(&s, &gains, &motor, v_V, TS_s);
    for (int i = 0; i < gains.n_pairs; i++) {
        TEST_ASSERT_TRUE(s.pair[i].a == 0.5f * whole.pair[i].a);
        TEST_ASSERT_TRUE(s.pair[i].b == 0.5f * whole.pair[i].b);
    }
}

static void test_a_pair_that_turns_too_fast_is_given_up(void)
{
    const dq_t  v_V      = {.d = 0.0f, .q = 0.0f};
    const float speeds[] = {0.99f, 1.01f, -0.99f,
                            -1.01f}; /* radians per period, at the pair's order */

    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        draw_state();
        gains.keep           = 0.75f;
        gains.keep_fast      = 0.25f;
        s.base.omega_e_radps = speeds[i] / (fabsf(gains.pair[0].order) * TS_s);
        s.theta_pairs_rad    = s.theta_rad;
        const double before  = hypot((double)s.pair[0].a, (double)s.pair[0].b);
        (void)predicted(&s, &gains, &motor, v_V, TS_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * before, ((fabsf(speeds[i]) < 1.0f) ? 0.75 : 0.25) * before,
                                  hypot((double)s.pair[0].a, (double)s.pair[0].b));
    }
}

/* EQ-HARMONIC-1, 4 in closed form: what the view shows, and what the motor is predicted with. */
static void test_view_is_the_closed_form(void)
{
    /* Orders that are no product of powers, and the largest one that is. */
    const float others[NODO_HARMONIC_PAIRS_MAX] = {-1.5f, -31.0f, 7.0f,  15.0f,
                                                   31.5f, 32.0f,  31.0f, 0.75f};
    for (int n = 0; n < CASES; n++) {
        for (int i = 0; (n == CASES / 2) && (i < NODO_HARMONIC_PAIRS_MAX); i++) {
            gains.pair[i].order = others[i];
        }
        draw_state();
        s.slope                     = draw(1.0e7f); /* moves the speed within one period */
        const nodo_harmonic_t start = s;
        const dq_t            v_V   = {.d = draw(170.0f), .q = draw(170.0f)};
        const double          w     = (double)s.base.omega_e_radps;
        const double          turn  = remainder(
                      (double)s.theta_rad + ((double)TS_s * w) - (double)s.theta_pairs_rad, 2.0 * pi);
        double added[2][3] = {{0.0}}; /* middle, after; d_w, d_q, d_d */
        double d_dot       = (double)s.slope;
        for (int i = 0; i < gains.n_pairs; i++) {
            const int channel = (int)gains.pair[i].channel - (int)NODO_HARMONIC_TORQUE;
            if (channel >= 0) {
                const double h    = (double)gains.pair[i].order;
                const double size = hypot((double)s.pair[i].a, (double)s.pair[i].b);
                const double at   = atan2((double)s.pair[i].b, (double)s.pair[i].a);
                const double end  = (channel == 0) ? 1.0 : 1.5;
                added[0][channel] += size * cos(at + (0.5 * h * turn));
                added[1][channel] += size * cos(at + (end * h * turn));
                d_dot -= (channel == 0) ? h * w * size * sin(at + (1.5 * h * turn)) : 0.0;
            }
        }
        const nodo_harmonic_view_t view = predicted(&s, &gains, &motor, v_V, TS_s);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_VIEW * 1.0e4,
                                  (double)start.base.d_omega +
                                      ((double)TS_s * (double)start.slope) + added[1][0],
                                  (double)view.total.d_omega);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_VIEW * 1.0e2, (double)start.base.d_q + added[1][1],
                                  (double)view.total.d_q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_VIEW * 1.0e2, (double)start.base.d_d + added[1][2],
                                  (double)view.total.d_d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_VIEW * 5.0e5, d_dot, (double)view.d_omega_dot);

        nodo_t x     = start.base;
        float  theta = start.theta_rad;
        x.d_omega += (float)((0.5 * (double)TS_s * (double)start.slope) + added[0][0]);
        x.d_q += (float)added[0][1];
        x.d_d += (float)added[0][2];
        nodo_encoder_predict(&x, &theta, &motor, v_V, TS_s);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, (double)x.omega_e_radps, (double)s.base.omega_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (double)x.iq_A, (double)s.base.iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (double)x.id_A, (double)s.base.id_A);
        TEST_ASSERT_TRUE((s.base.iq_A == view.total.iq_A) && (s.base.d_q == start.base.d_q));
    }
}

static void test_reset_knows_nothing_of_any_harmonic(void)
{
    const nodo_meas_t y = {300.0f, 1.0f, -0.5f};
    nodo_harmonic_reset(&s, &y, 4.0f);

    TEST_ASSERT_TRUE((s.base.omega_e_radps == 300.0f) && (s.base.iq_A == 1.0f) &&
                     (s.base.id_A == -0.5f) && (s.slope == 0.0f));
    TEST_ASSERT_TRUE((s.base.d_omega == 0.0f) && (s.base.d_q == 0.0f) && (s.base.d_d == 0.0f));
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 4.0 - (2.0 * pi), (double)s.theta_rad);
    TEST_ASSERT_TRUE(s.theta_pairs_rad == s.theta_rad);
    for (int i = 0; i < NODO_HARMONIC_PAIRS_MAX; i++) {
        TEST_ASSERT_TRUE((s.pair[i].a == 0.0f) && (s.pair[i].b == 0.0f));
    }
}

static void test_not_a_number_is_not_hidden(void)
{
    const dq_t bad = {.d = 1.0f, .q = NAN};
    nodo_harmonic_correct(&s, &gains, bad, 0.0f);
    TEST_ASSERT_TRUE(isnan(s.base.omega_e_radps) && isnan(s.theta_rad) && isnan(s.pair[0].a));
}

/* The generated gains on a motor whose current sensors have an offset, constant in the stator
 * frame. The observer finds the offset. Its estimated current is the true one, which no measurement
 * shows. */
static void test_sensor_offset_is_found_and_kept_out_of_the_current(void)
{
    const nodo_harmonic_gains_t *g       = &law_constants_noc_h(&harmonic_tables_drive)->nodo;
    const float                  ts_s    = harmonic_tables_drive.ts_s;
    const double                 alpha_A = 0.05, beta_A = -0.03;
    const nodo_meas_t            start   = {300.0f, 0.0f, 0.0f};
    nodo_t                       truth   = {-500.0f, 0.0f, 0.0f, 300.0f, 0.0f, 0.0f};
    float                        theta   = 0.3f;
    double                       worst_A = 0.0, offset_d_A = 0.0, offset_q_A = 0.0;

    motor = harmonic_tables_drive.motor;
    nodo_harmonic_reset(&s, &start, theta);
    for (int k = 0; k < 20000; k++) { /* 4 s: the slowest mode is the leak's */
        dq_t v_V; /* holds the speed: a weak spring on it makes the current that carries the load */
        v_V.q = (float)((double)((motor.l4 * 0.2f) + (motor.l5 * truth.omega_e_radps)) /
                        (double)motor.l6) +
                (0.2f * (300.0f - truth.omega_e_radps));
        v_V.d = -motor.l9 * truth.iq_A * truth.omega_e_radps / motor.l8;

        const double angle = (double)s.theta_rad;
        offset_d_A         = (alpha_A * cos(angle)) + (beta_A * sin(angle));
        offset_q_A         = (beta_A * cos(angle)) - (alpha_A * sin(angle));
        const dq_t i_A = {.d = truth.id_A + (float)offset_d_A, .q = truth.iq_A + (float)offset_q_A};
        nodo_harmonic_correct(&s, g, i_A, frames_wrap(theta - s.theta_rad));
        if (k >= 19000) {
            worst_A = fmax(worst_A, fabs((double)(s.base.iq_A - truth.iq_A)));
            worst_A = fmax(worst_A, fabs((double)(s.base.id_A - truth.id_A)));
            TEST_ASSERT_DOUBLE_WITHIN(5.0e-3, offset_d_A, (double)(s.pair[0].a + s.pair[1].a));
            TEST_ASSERT_DOUBLE_WITHIN(5.0e-3, offset_q_A, (double)(s.pair[0].b + s.pair[1].b));
        }
        (void)predicted(&s, g, &motor, v_V, ts_s);
        nodo_encoder_predict(&truth, &theta, &motor, v_V, ts_s);
    }
    TEST_ASSERT_EQUAL_INT(NODO_HARMONIC_SENSOR, g->pair[0].channel);
    TEST_ASSERT_TRUE(g->pair[0].order == -1.0f);
    TEST_ASSERT_TRUE(worst_A < 5.0e-3); /* a tenth of the offset */
    TEST_ASSERT_DOUBLE_WITHIN(5.0, -500.0, (double)s.base.d_omega);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_correction_matches_matrices_between_at_and_beyond_the_nodes);
    RUN_TEST(test_no_node_beyond_the_last_is_read);
    RUN_TEST(test_gain_is_held_beyond_its_current);
    RUN_TEST(test_without_pairs_it_is_the_encoder_form);
    RUN_TEST(test_reversed_rotation_mirrors_the_estimates);
    RUN_TEST(test_pairs_stay_locked_to_the_angle);
    RUN_TEST(test_pairs_fade_with_keep_once_per_period);
    RUN_TEST(test_a_pair_that_turns_too_fast_is_given_up);
    RUN_TEST(test_view_is_the_closed_form);
    RUN_TEST(test_reset_knows_nothing_of_any_harmonic);
    RUN_TEST(test_not_a_number_is_not_hidden);
    RUN_TEST(test_sensor_offset_is_found_and_kept_out_of_the_current);
    return UNITY_END();
}
