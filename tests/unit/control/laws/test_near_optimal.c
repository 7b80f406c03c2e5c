/* SPDX-License-Identifier: MIT */
#include "near_optimal.h"

#include "feedforward.h"
#include "law_constants.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"
#include "voltage.h"

#define TOL_V     8.0e-5 /* V, summands up to 400 V; worst 1.6e-5 */
#define TOL_RADPS 2.0e-6 /* rad/s, errors up to 0.3 rad/s; worst 3.8e-7 */
#define TOL_FAR_V 2.0e-2 /* V, summands up to 2 kV; worst 3e-3 */
#define TOL_A     6.0e-7 /* A; worst 1.2e-7 */

#define CASES 2000

static support_random_t             random_state;
static test_constants_t             constants;
static drive_config_t               drive;
static near_optimal_config_t *const config = &constants.near_optimal;
static near_optimal_t               state;
static nodo_t                       est;
static near_optimal_view_t          view;
static drive_sample_t               sample;
static law_input_t                  in;

/* A state near its reference, with currents that the limits allow. */
static void draw(void)
{
    view.now.omega_e_radps = support_uniform(&random_state, -900.0f, 900.0f);
    view.now.iq_A          = support_uniform(&random_state, -2.0f, 2.0f);
    view.now.id_A          = support_uniform(&random_state, -1.0f, 0.0f);
    est.d_omega            = support_uniform(&random_state, -3.0e3f, 3.0e3f);
    est.d_q                = support_uniform(&random_state, -20.0f, 20.0f);
    est.d_d                = support_uniform(&random_state, -20.0f, 20.0f);
    in.command_e_radps     = support_uniform(&random_state, -900.0f, 900.0f);
    sample.dc_link_V       = support_uniform(&random_state, 200.0f, 398.0f);
}

void setUp(void)
{
    const near_optimal_view_t of_est  = {.est         = &est,
                                         .now         = {300.0f, 0.5f, -0.1f},
                                         .d_omega_dot = 0.0f,
                                         .theta_rad   = 0.7f,
                                         .plausible   = true};
    const nodo_t              nothing = {0.0f, 0.0f, 0.0f, 300.0f, 0.5f, -0.1f};
    const drive_sample_t of_295V = {.dc_link_V = 295.0f, .omega_e_radps = 300.0f, .valid = true};
    const law_input_t    hold    = {
              .sample = &sample, .command_e_radps = 300.0f, .v_V = {.d = 0.0f, .q = 0.0f}};

    random_state.state = 47u;
    drive              = law_constants_copy(&constants, &speed_tables_drive);
    est                = nothing;
    view               = of_est;
    sample             = of_295V;
    in                 = hold;
    near_optimal_reset(&state, config, 300.0f);
}

void tearDown(void) {}

static nosc_error_t error(void)
{
    return near_optimal_error(&state, config, &drive, &view, &in);
}

static law_output_t answer(const nosc_error_t *e, dq_t feedback_V)
{
    law_output_t out;

    near_optimal_answer(&state, config, &drive.motor, &view, e, feedback_V, &in, &out);
    return out;
}

static void test_references_start_at_the_present_speed_without_current(void)
{
    for (int n = 0; n < 100; n++) {
        in.command_e_radps = 500.0f;
        (void)error();
    }
    TEST_ASSERT_TRUE(state.speed_ref.omega_e_radps > 300.0f);

    near_optimal_reset(&state, config, -250.0f);

    TEST_ASSERT_TRUE(state.speed_ref.omega_e_radps == -250.0f);
    TEST_ASSERT_TRUE((state.speed_ref.omega_dot_e_radps2 == 0.0f) &&
                     (state.speed_ref.omega_2dot_e_radps3 == 0.0f));
    TEST_ASSERT_TRUE((state.current_ref.i_A.d == 0.0f) && (state.current_ref.i_A.q == 0.0f));
    TEST_ASSERT_TRUE((state.current_ref.iq_lo_A == 0.0f) && (state.current_ref.iq_hi_A == 0.0f));
}

/* Speed reference from the limits that the references of the last period leave, then those of this one. */
static void test_references_are_made_of_the_view(void)
{
    for (int n = 0; n < CASES; n++) {
        draw();
        view.d_omega_dot      = support_uniform(&random_state, -1.0e5f, 1.0e5f);
        speed_ref_t   speed   = state.speed_ref;
        current_ref_t current = state.current_ref;
        const float   w       = view.now.omega_e_radps;
        const float   asked_A = nosc_speed_current_A(&config->nosc, w - speed.omega_e_radps);
        const current_ref_input_t from   = {.est        = &est,
                                            .state      = &view.now,
                                            .iq_speed_A = asked_A,
                                            .dc_link_V  = sample.dc_link_V,
                                            .v_max_Aps =
                                                config->current_ref.circle_ApVs * sample.dc_link_V,
                                            .d_omega_dot = view.d_omega_dot};
        const speed_ref_limits_t  limits = current_ref_speed_limits(
             &current, &config->current_ref, &drive.motor, &from, in.command_e_radps);
        speed_ref_update(&speed, &limits, in.command_e_radps, w, drive.ts_s);
        current_ref_update(&current, &config->current_ref, &drive.motor, &speed, &from);

        (void)error();

        TEST_ASSERT_TRUE(state.speed_ref.omega_e_radps == speed.omega_e_radps);
        TEST_ASSERT_TRUE((state.current_ref.i_A.d == current.i_A.d) &&
                         (state.current_ref.i_A.q == current.i_A.q));
        TEST_ASSERT_TRUE((state.current_ref.i_dot_Aps.d == current.i_dot_Aps.d) &&
                         (state.current_ref.i_dot_Aps.q == current.i_dot_Aps.q));
        TEST_ASSERT_TRUE((state.current_ref.iq_lo_A == current.iq_lo_A) &&
                         (state.current_ref.iq_hi_A == current.iq_hi_A));
    }
}

/* Oracle: the q current that the speed error asks for, cut to what EQ-NOSC-3 allows, turned back into a speed. */
static void test_error_is_what_is_seen_less_the_reference(void)
{
    const double ratio =
        (double)config->nosc.lambda[0][0][0] / (double)config->nosc.lambda[0][0][1];
    const double most  = (double)config->nosc.iq_speed_max_A;
    int          cut   = 0;
    int          whole = 0;

    for (int n = 0; n < CASES; n++) {
        draw();
        if (n % 2 == 0) { /* as close as a loop keeps it */
            view.now.omega_e_radps =
                state.speed_ref.omega_e_radps + support_uniform(&random_state, -2.0f, 2.0f);
        }

        const nosc_error_t e = error();

        const current_ref_t *ref = &state.current_ref;
        const double e_w   = (double)view.now.omega_e_radps - (double)state.speed_ref.omega_e_radps;
        const double iqr   = (double)ref->i_A.q;
        const double asked = iqr - (ratio * e_w);
        const double given = support_limit(support_limit(asked, iqr - most, iqr + most),
                                           (double)ref->iq_lo_A, (double)ref->iq_hi_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS, (iqr - given) / ratio, (double)e.omega_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (double)view.now.iq_A - iqr, (double)e.iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (double)view.now.id_A - (double)ref->i_A.d,
                                  (double)e.id_A);
        cut += (given != asked) ? 1 : 0;
        whole += ((given == asked) && (e_w != 0.0)) ? 1 : 0;
    }
    TEST_ASSERT_TRUE((cut > 100) && (whole > 100));
}

/* EQ-DRIVE-1: feed-forward to the reference as far as it is followed, plus the feedback. */
static void test_answer_is_feedback_plus_feedforward(void)
{
    for (int n = 0; n < CASES; n++) {
        draw();
        const nosc_error_t e   = error();
        const dq_t         fb  = {.d = support_uniform(&random_state, -100.0f, 100.0f),
                                  .q = support_uniform(&random_state, -100.0f, 100.0f)};
        const float        w_d = view.now.omega_e_radps - e.omega_e_radps;
        const dq_t ff = feedforward_V(&drive.motor, &state.current_ref, w_d, &view.now, &est);

        sample.dc_link_V       = 5000.0f; /* nothing lies outside */
        const law_output_t out = answer(&e, fb);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)fb.d + (double)ff.d, (double)out.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)fb.q + (double)ff.q, (double)out.v_V.q);
    }
}

/* The voltage that holds the currents asked for, (4) at rest, in double. */
static dq_t oracle_hold_V(const nosc_error_t *e, dq_t *asked_A)
{
    const support_motor_t m = support_motor(&drive.motor);
    const double          w = (double)view.now.omega_e_radps;
    const double k  = (double)config->nosc.lambda[0][0][0] / (double)config->nosc.lambda[0][0][1];
    const double iq = (double)state.current_ref.i_A.q - (k * (double)e->omega_e_radps);
    const double id = (double)state.current_ref.i_A.d;
    const double vq = (m.rs_Ohm * iq) + (w * (m.flux_Wb + (m.ld_H * id))) +
                      (m.lq_H * ((double)state.current_ref.i_dot_Aps.q - (double)est.d_q));
    const double vd = (m.rs_Ohm * id) - (w * m.lq_H * iq) +
                      (m.ld_H * ((double)state.current_ref.i_dot_Aps.d - (double)est.d_d));
    asked_A->d     = (float)id;
    asked_A->q     = (float)iq;
    const dq_t h_V = {.d = (float)vd, .q = (float)vq};
    return h_V;
}

/* EQ-VOLTAGE-2 with the gain of the q axis for both axes. The limit is stable: if the holding
 * voltage can be produced, the cut vector does not increase the flux error. */
static void test_answer_out_of_reach_pulls_both_axes_alike(void)
{
    const support_motor_t m      = support_motor(&drive.motor);
    const double          pull   = (double)config->nosc.lambda[0][0][1] / m.lq_H;
    int                   beyond = 0;
    int                   held   = 0;

    for (int n = 0; n < 20 * CASES; n++) {
        draw();
        view.now.iq_A          = support_uniform(&random_state, -8.0f, 8.0f);
        view.now.id_A          = support_uniform(&random_state, -8.0f, 2.0f);
        const nosc_error_t e   = error();
        const dq_t         fb  = nosc_feedback_V(&config->nosc, &e);
        const float        w_d = view.now.omega_e_radps - e.omega_e_radps;
        const dq_t ff = feedforward_V(&drive.motor, &state.current_ref, w_d, &view.now, &est);
        const dq_t u  = {.d = fb.d + ff.d, .q = fb.q + ff.q};
        if (!voltage_is_outside(u, sample.dc_link_V)) {
            continue;
        }
        dq_t         asked_A;
        const dq_t   h   = oracle_hold_V(&e, &asked_A);
        const double x_d = m.ld_H * ((double)view.now.id_A - (double)asked_A.d);
        const double x_q = m.lq_H * ((double)view.now.iq_A - (double)asked_A.q);

        const law_output_t out = answer(&e, fb);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_FAR_V, (double)h.d - (pull * x_d), (double)out.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_FAR_V, (double)h.q - (pull * x_q), (double)out.v_V.q);
        beyond++;
        if (!voltage_is_outside(h, sample.dc_link_V)) {
            for (int turn = 0; turn < 8; turn++) {
                const frames_angle_t at = frames_angle(0.5f * (float)turn);
                const dq_t   v = voltage_produce(out.v_V, at, sample.dc_link_V, turn % 2 == 0).v_V;
                const double grows =
                    (x_d * ((double)v.d - (double)h.d)) + (x_q * ((double)v.q - (double)h.q));
                TEST_ASSERT_TRUE(grows <= 1.0e-4); /* V Wb of up to 900 */
            }
            held++;
        }
    }
    TEST_ASSERT_TRUE((beyond > CASES) && (held > CASES));
}

static void test_answer_tells_what_the_law_knows(void)
{
    const dq_t no_V = {.d = 0.0f, .q = 0.0f};

    for (int n = 0; n < 10; n++) {
        draw();
        view.theta_rad       = 0.1f * (float)n;
        view.plausible       = (n % 2) == 0;
        const nosc_error_t e = error();

        const law_output_t out = answer(&e, no_V);

        TEST_ASSERT_TRUE(out.theta_rad == view.theta_rad);
        TEST_ASSERT_TRUE(out.plausible == view.plausible);
        TEST_ASSERT_TRUE((out.now.omega_e_radps == view.now.omega_e_radps) &&
                         (out.now.iq_A == view.now.iq_A) && (out.now.id_A == view.now.id_A));
        TEST_ASSERT_TRUE((out.i_ref_A.d == state.current_ref.i_A.d) &&
                         (out.i_ref_A.q == state.current_ref.i_A.q));
        TEST_ASSERT_TRUE((out.d_omega == est.d_omega) && (out.d_q == est.d_q) &&
                         (out.d_d == est.d_d));
    }
}

static void test_not_a_number_is_not_hidden(void)
{
    est.d_q               = NAN;
    const dq_t         fb = {.d = NAN, .q = 0.0f};
    const nosc_error_t e  = error();

    const law_output_t out = answer(&e, fb);

    TEST_ASSERT_TRUE(isnan(out.v_V.d) && isnan(out.v_V.q));
}

static void test_check_wants_references_feedback_and_the_limit_of_the_drive(void)
{
    TEST_ASSERT_TRUE(near_optimal_check(config, &drive));
    config->current_ref.l1_min = 0.0f;
    TEST_ASSERT_FALSE(near_optimal_check(config, &drive));
    setUp();
    config->nosc.iq_error_max_A = 0.0f;
    TEST_ASSERT_FALSE(near_optimal_check(config, &drive));
    setUp();
    drive.current_max_A = nextafterf(drive.current_max_A, 0.0f);
    TEST_ASSERT_FALSE(near_optimal_check(config, &drive));
    setUp();
    drive.current_max_A = nextafterf(drive.current_max_A, INFINITY);
    TEST_ASSERT_FALSE(near_optimal_check(config, &drive));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_references_start_at_the_present_speed_without_current);
    RUN_TEST(test_references_are_made_of_the_view);
    RUN_TEST(test_error_is_what_is_seen_less_the_reference);
    RUN_TEST(test_answer_is_feedback_plus_feedforward);
    RUN_TEST(test_answer_out_of_reach_pulls_both_axes_alike);
    RUN_TEST(test_answer_tells_what_the_law_knows);
    RUN_TEST(test_not_a_number_is_not_hidden);
    RUN_TEST(test_check_wants_references_feedback_and_the_limit_of_the_drive);
    return UNITY_END();
}
