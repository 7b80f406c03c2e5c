/* SPDX-License-Identifier: MIT */
#include "feedforward.h"

#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_V   8.0e-4 /* V, summands up to 1.2 kV; worst 1.6e-4 */
#define TOL_Aps 1.0e-2 /* A/s, summands up to 1e4 A/s; worst 2.0e-3 */

#define CASES 5000

static support_random_t random_state;
static motor_reduced_t  motor;
static current_ref_t    ref;
static nodo_meas_t      y;
static nodo_t           est;
static float            w_d_e_radps;

static void draw_case(void)
{
    ref.i_A.d       = support_uniform(&random_state, -4.0f, 0.0f);
    ref.i_A.q       = support_uniform(&random_state, -4.0f, 4.0f);
    ref.i_dot_Aps.d = support_uniform(&random_state, -2.0e3f, 2.0e3f);
    ref.i_dot_Aps.q = support_uniform(&random_state, -2.0e3f, 2.0e3f);
    y               = support_random_meas(&random_state);
    est             = support_random_estimate(&random_state);
    w_d_e_radps     = support_uniform(&random_state, -1500.0f, 1500.0f);
}

void setUp(void)
{
    random_state.state = 7u;
    motor              = support_odd_motor();
    draw_case();
}

void tearDown(void) {}

/* Oracle: the sums of (41) as printed, with the error products, less the disturbances of (42). */
static double oracle_q_V(void)
{
    const double w_d   = (double)w_d_e_radps;
    const double w     = (double)y.omega_e_radps;
    const double e_w   = w - w_d;
    const double e_id  = (double)y.id_A - (double)ref.i_A.d;
    const double cross = (e_id * w_d) + (w * (double)ref.i_A.d) + (e_id * e_w);
    const double u_ff  = ((double)motor.l4 * (double)ref.i_A.q) + ((double)motor.l5 * w_d) +
                        (double)ref.i_dot_Aps.q + ((double)motor.l10 * cross);
    return (u_ff / (double)motor.l6) - ((double)est.d_q / (double)motor.l6);
}

static double oracle_d_V(void)
{
    const double w_d  = (double)w_d_e_radps;
    const double w    = (double)y.omega_e_radps;
    const double e_w  = w - w_d;
    const double e_iq = (double)y.iq_A - (double)ref.i_A.q;
    const double l9   = (double)motor.l9;
    const double u_ff = ((double)motor.l7 * (double)ref.i_A.d) + (double)ref.i_dot_Aps.d -
                        (l9 * e_iq * w_d) - (l9 * w * (double)ref.i_A.q) - (l9 * e_iq * e_w);
    return (u_ff / (double)motor.l8) - ((double)est.d_d / (double)motor.l8);
}

/* Current equations of (4), in double, for the voltage that is applied. */
static double iq_dot_Aps(dq_t v_V)
{
    return (-(double)motor.l4 * (double)y.iq_A) - ((double)motor.l5 * (double)y.omega_e_radps) -
           ((double)motor.l10 * (double)y.omega_e_radps * (double)y.id_A) +
           ((double)motor.l6 * (double)v_V.q) + (double)est.d_q;
}

static double id_dot_Aps(dq_t v_V)
{
    return (-(double)motor.l7 * (double)y.id_A) +
           ((double)motor.l9 * (double)y.omega_e_radps * (double)y.iq_A) +
           ((double)motor.l8 * (double)v_V.d) + (double)est.d_d;
}

static void test_feedforward_matches_printed_sums(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_case();

        const dq_t u_V = feedforward_V(&motor, &ref, w_d_e_radps, &y, &est);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, oracle_q_V(), (double)u_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, oracle_d_V(), (double)u_V.d);
    }
}

static void test_feedforward_matches_printed_sums_for_the_shipped_motor(void)
{
    motor = speed_tables_drive.motor;
    for (int n = 0; n < CASES; n++) {
        draw_case();

        const dq_t u_V = feedforward_V(&motor, &ref, w_d_e_radps, &y, &est);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, oracle_q_V(), (double)u_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, oracle_d_V(), (double)u_V.d);
    }
}

/* (10): what is left of the current equations is linear in the errors and free of cross coupling. */
static void test_feedforward_leaves_the_error_dynamics(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_case();
        const double e_w  = (double)y.omega_e_radps - (double)w_d_e_radps;
        const double e_iq = (double)y.iq_A - (double)ref.i_A.q;
        const double e_id = (double)y.id_A - (double)ref.i_A.d;

        const dq_t u_V = feedforward_V(&motor, &ref, w_d_e_radps, &y, &est);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, (-(double)motor.l5 * e_w) - ((double)motor.l4 * e_iq),
                                  iq_dot_Aps(u_V) - (double)ref.i_dot_Aps.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, -(double)motor.l7 * e_id,
                                  id_dot_Aps(u_V) - (double)ref.i_dot_Aps.d);
    }
}

static void test_hold_voltage_keeps_the_q_current(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_case();

        const dq_t h_V = {.d = 0.0f, .q = feedforward_hold_q_V(&motor, &y, est.d_q)};

        TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, 0.0, iq_dot_Aps(h_V));
    }
}

static void test_hold_voltage_of_the_shipped_motor_is_mostly_its_back_emf(void)
{
    motor = speed_tables_drive.motor;
    for (int speed = -1500; speed <= 1500; speed += 100) {
        y.omega_e_radps = (float)speed;
        y.iq_A          = 0.0f;
        y.id_A          = 0.0f;

        const float h_V = feedforward_hold_q_V(&motor, &y, 0.0f);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 0.193 * (double)speed, (double)h_V);
    }
}

static void test_feedforward_without_errors_or_derivatives_is_the_hold_voltage(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_case();
        ref.i_A.d       = y.id_A;
        ref.i_A.q       = y.iq_A;
        ref.i_dot_Aps.d = 0.0f;
        ref.i_dot_Aps.q = 0.0f;

        const dq_t  u_V   = feedforward_V(&motor, &ref, y.omega_e_radps, &y, &est);
        const float h_q_V = feedforward_hold_q_V(&motor, &y, est.d_q);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)h_q_V, (double)u_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, 0.0, id_dot_Aps(u_V));
    }
}

static void test_rest_without_disturbance_needs_no_voltage(void)
{
    const nodo_meas_t   rest          = {0.0f, 0.0f, 0.0f};
    const nodo_t        nothing       = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const current_ref_t nothing_asked = {.iq_circle_A = 1.0f};
    ref                               = nothing_asked;

    const dq_t  u_V   = feedforward_V(&motor, &ref, 0.0f, &rest, &nothing);
    const float h_q_V = feedforward_hold_q_V(&motor, &rest, 0.0f);

    TEST_ASSERT_TRUE((u_V.d == 0.0f) && (u_V.q == 0.0f) && (h_q_V == 0.0f));
}

/* Running backwards with mirrored q quantities mirrors v_q and leaves v_d. */
static void test_reversed_rotation_mirrors_the_q_axis(void)
{
    const dq_t  forwards_V  = feedforward_V(&motor, &ref, w_d_e_radps, &y, &est);
    const float hold_V      = feedforward_hold_q_V(&motor, &y, est.d_q);
    ref.i_A.q               = -ref.i_A.q;
    ref.i_dot_Aps.q         = -ref.i_dot_Aps.q;
    y.omega_e_radps         = -y.omega_e_radps;
    y.iq_A                  = -y.iq_A;
    est.d_q                 = -est.d_q;
    const dq_t  backwards_V = feedforward_V(&motor, &ref, -w_d_e_radps, &y, &est);
    const float hold_back_V = feedforward_hold_q_V(&motor, &y, est.d_q);

    TEST_ASSERT_TRUE((backwards_V.d == forwards_V.d) && (backwards_V.q == -forwards_V.q));
    TEST_ASSERT_TRUE(hold_back_V == -hold_V);
}

static void test_not_a_number_is_not_hidden(void)
{
    est.d_q = NAN;
    est.d_d = NAN;

    const dq_t  u_V   = feedforward_V(&motor, &ref, w_d_e_radps, &y, &est);
    const float h_q_V = feedforward_hold_q_V(&motor, &y, est.d_q);

    TEST_ASSERT_TRUE(isnan(u_V.d) && isnan(u_V.q) && isnan(h_q_V));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_feedforward_matches_printed_sums);
    RUN_TEST(test_feedforward_matches_printed_sums_for_the_shipped_motor);
    RUN_TEST(test_feedforward_leaves_the_error_dynamics);
    RUN_TEST(test_hold_voltage_keeps_the_q_current);
    RUN_TEST(test_hold_voltage_of_the_shipped_motor_is_mostly_its_back_emf);
    RUN_TEST(test_feedforward_without_errors_or_derivatives_is_the_hold_voltage);
    RUN_TEST(test_rest_without_disturbance_needs_no_voltage);
    RUN_TEST(test_reversed_rotation_mirrors_the_q_axis);
    RUN_TEST(test_not_a_number_is_not_hidden);
    return UNITY_END();
}
