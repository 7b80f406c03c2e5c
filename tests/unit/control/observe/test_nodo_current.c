/* SPDX-License-Identifier: MIT */
#include "nodo_current.h"

#include "frames.h"
#include "gain_tables.h"
#include "law_constants.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_REL 2.0e-6 /* relative to the largest term of a row; worst 4e-7 */

static nodo_current_gains_t g;
static nodo_current_t       state;
static support_random_t     random_state;

void setUp(void)
{
    g                  = law_constants_noc(&gain_tables_drive)->currents;
    random_state.state = 71u;
    nodo_current_reset(&state);
}

static const motor_reduced_t *motor(void)
{
    return &gain_tables_drive.motor;
}

static bool correct(nodo_t *x, float *theta_rad, dq_t i_A)
{
    return nodo_current_correct(&state, x, theta_rad, &g, motor(), i_A);
}

void tearDown(void) {}

/* EQ-NODO-CURRENT-2 in double: row, column. */
static double gain(double w, int row, int column)
{
    const double place =
        fmin(fmax((double)g.nodes_per_root * (sqrt(fabs(w)) - (double)g.root), 0.0), 4.0);
    const int    node = (place >= 4.0) ? 3 : (int)place;
    const double a    = (double)g.gain[node][row][column];
    const double b    = (double)g.gain[node + 1][row][column];
    return a + ((place - node) * (b - a));
}

static void near(double want, float found, double size)
{
    TEST_ASSERT_DOUBLE_WITHIN(TOL_REL * size, want, (double)found);
}

static void test_correction_is_gain_times_innovation(void)
{
    for (int n = 0; n < 2000; n++) {
        const nodo_t x0  = support_random_estimate(&random_state);
        const dq_t   i_A = {.d = support_uniform(&random_state, -4.0f, 4.0f),
                            .q = support_uniform(&random_state, -4.0f, 4.0f)};
        const double w   = (double)x0.omega_e_radps;
        const double s =
            (w < 0.0) ? -1.0 : 1.0; /* the mirror image changes the sign of id's partners */
        const double rq    = (double)i_A.q - (double)x0.iq_A;
        const double rd    = (double)i_A.d - (double)x0.id_A;
        nodo_t       x     = x0;
        float        theta = 0.4f;
        double       c[5];
        for (int row = 0; row < 5; row++) {
            const double even = (row == 3) ? s : 1.0;
            c[row]            = (even * gain(w, row, 0) * rq) + (even * s * gain(w, row, 1) * rd);
        }
        const double iq = (double)x0.iq_A + c[2];
        const double id = (double)x0.id_A + c[3];

        (void)correct(&x, &theta, i_A);

        near((double)x0.d_omega + c[0], x.d_omega, 3.0e4);
        near(w + c[1], x.omega_e_radps, 2.0e3);
        near(iq - (c[4] * id), x.iq_A, 20.0);
        near(id + (c[4] * iq), x.id_A, 20.0);
        near(0.4 + c[4], theta, 4.0);
    }
}

static void test_angle_stays_within_half_a_turn(void)
{
    nodo_t     x     = {.omega_e_radps = 300.0f};
    float      theta = 3.1f;
    const dq_t i_A   = {.d = 4.0f, .q = -4.0f};
    (void)correct(&x, &theta, i_A);
    TEST_ASSERT_TRUE((theta < 0.0f) && base_within(theta, BASE_PI));
}

/* A loss at this speed. */
static void lose_at(float omega_e_radps)
{
    nodo_t     x     = {.omega_e_radps = omega_e_radps};
    float      theta = 0.0f;
    const dq_t i_A   = {0.0f, 0.0f};

    nodo_current_reset(&state);
    (void)correct(&x, &theta, i_A);
}

/* Without an innovation the speed stays. */
static bool knows(float omega_e_radps)
{
    nodo_t     x     = {.omega_e_radps = omega_e_radps};
    float      theta = 0.0f;
    const dq_t i_A   = {0.0f, 0.0f};

    return correct(&x, &theta, i_A);
}

static void test_currents_know_from_the_minimum_speed_on(void)
{
    static const float slow[] = {0.0f, 1.0e-30f, 40.0f, -40.0f};

    for (int i = 0; i < SUPPORT_COUNT(slow); i++) {
        lose_at(slow[i]);
        TEST_ASSERT_FALSE(knows(slow[i]));
        TEST_ASSERT_FALSE(knows(300.0f)); /* nor later */
        TEST_ASSERT_TRUE((state.q_A == 0.0f) && (state.d == 0.0f));
    }
    lose_at(g.from_e_radps);
    TEST_ASSERT_FALSE(knows(g.from_e_radps));
    lose_at(nextafterf(g.from_e_radps, 1.0e9f));
    TEST_ASSERT_TRUE(knows(g.from_e_radps));
    TEST_ASSERT_FALSE(knows(NAN));
    TEST_ASSERT_FALSE(knows(INFINITY));
}

static void test_a_correction_that_has_begun_goes_on_to_a_quarter_of_that_speed(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const float quarter = 0.25f * (float)sign * g.from_e_radps;

        lose_at((float)sign * 300.0f);
        TEST_ASSERT_FALSE(knows(0.999f * quarter));
        TEST_ASSERT_TRUE(knows(1.001f * quarter));
    }
}

/* Estimates of a steady motor with other L_q and flux, then another speed and current. */
static void test_differences_of_the_motor_hold_for_another_speed_and_current(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const float lq   = 0.3f * motor()->l9;
        const float flux = -0.2f * motor()->l5;
        const float w    = (float)sign * 300.0f;
        nodo_t      x   = {.omega_e_radps = w, .iq_A = 2.0f, .d_q = flux * w, .d_d = lq * w * 2.0f};
        dq_t        i_A = {.d = 0.0f, .q = 2.0f};
        float       theta = 0.0f;
        nodo_current_reset(&state);
        (void)correct(&x, &theta, i_A);

        x.omega_e_radps = 0.5f * w;
        x.iq_A          = -3.0f;
        i_A.q           = -3.0f; /* as expected: nothing else changes */
        (void)correct(&x, &theta, i_A);

        near((double)(flux * 0.5f * w), x.d_q, 100.0);
        TEST_ASSERT_FLOAT_WITHIN(0.03f * fabsf(lq * 0.5f * w * 3.0f), lq * 0.5f * w * -3.0f, x.d_d);
    }
}

static void test_little_current_shows_no_inductance(void)
{
    nodo_t     x     = {.omega_e_radps = 300.0f, .iq_A = 0.01f, .d_q = 50.0f, .d_d = 20.0f};
    float      theta = 0.0f;
    const dq_t i_A   = {.d = 0.0f, .q = 0.01f};

    (void)correct(&x, &theta, i_A);

    TEST_ASSERT_TRUE(base_within(state.d, 0.01f));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 50.0f / 300.0f, state.q_A);
}

static void test_differences_are_limited(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const float d     = (float)sign * 1.0e6f;
        nodo_t      x     = {.omega_e_radps = 300.0f, .iq_A = 2.0f, .d_q = d, .d_d = d};
        float       theta = 0.0f;
        const dq_t  i_A   = {.d = 0.0f, .q = 2.0f};
        nodo_current_reset(&state);

        (void)correct(&x, &theta, i_A);

        TEST_ASSERT_EQUAL_FLOAT((float)sign * 0.3f * motor()->l5, state.q_A);
        TEST_ASSERT_EQUAL_FLOAT((float)sign * 0.5f * motor()->l9, state.d);
    }
}

static void test_constants_out_of_range_are_refused(void)
{
    float *const fields[] = {&g.from_e_radps, &g.root, &g.nodes_per_root, &g.gain[4][4][1]};
    TEST_ASSERT_TRUE(nodo_current_check(&g));
    for (int i = 0; i < SUPPORT_COUNT(fields); i++) {
        const float good = *fields[i];
        *fields[i]       = NAN;
        TEST_ASSERT_FALSE(nodo_current_check(&g));
        *fields[i] = (i < 3) ? 0.0f : INFINITY;
        TEST_ASSERT_FALSE(nodo_current_check(&g));
        *fields[i] = good;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_correction_is_gain_times_innovation);
    RUN_TEST(test_angle_stays_within_half_a_turn);
    RUN_TEST(test_currents_know_from_the_minimum_speed_on);
    RUN_TEST(test_a_correction_that_has_begun_goes_on_to_a_quarter_of_that_speed);
    RUN_TEST(test_differences_of_the_motor_hold_for_another_speed_and_current);
    RUN_TEST(test_little_current_shows_no_inductance);
    RUN_TEST(test_differences_are_limited);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
