/* SPDX-License-Identifier: MIT */
#include "law_pid.h"

#include "drive_tick.h"
#include "gain_tables.h"
#include "law_answer.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_V 1.6e-5 /* V, voltages up to 100 V; worst 2.0e-6 */

static law_pid_config_t config;
static drive_config_t   drive; /* the shipped motor's limits and constants around the law above */
static law_state_t      state;
static law_pid_state_t *const s = &state.pid;
static drive_sample_t         sample;
static law_input_t            in;

void setUp(void)
{
    const law_pid_config_t c = {.pid   = {.kp = 0.9f, .ki_per_tick = 0.0075f, .kd_tick = 20.0f},
                                .id_pi = {.kp = 120.0f, .ki_per_tick = 0.024f, .kd_tick = 0.0f}};
    /* At this angle the d axis is phase a: id = -0.3 A, iq = (ia + 2 ib) / sqrt(3) = 1.2 A. */
    const drive_sample_t at      = {.ia_A          = -0.3f,
                                    .ib_A          = 1.18923f,
                                    .dc_link_V     = 295.0f,
                                    .theta_e_rad   = 0.0f,
                                    .omega_e_radps = 200.0f,
                                    .valid         = true};
    const law_input_t    no_past = {
           .sample = &sample, .command_e_radps = 210.0f, .v_V = {.d = 0.0f, .q = 0.0f}};

    config          = c;
    sample          = at;
    in              = no_past;
    drive           = gain_tables_drive;
    drive.law       = &law_pid;
    drive.torques   = false;
    drive.constants = &config;
    drive.law->reset(&state, &drive, &sample);
}

void tearDown(void) {}

/* The q voltage that keeps the current where it is: (4) of paper A with the motor's constants in SI units. */
static double hold_V(void)
{
    return (2.48 * 1.2) + (200.0 * (0.193 + (0.07498 * -0.3)));
}

static void test_pid_starts_from_the_back_emf(void)
{
    const law_output_t out = law_answer(&drive, &state, &in);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, hold_V() + (0.9 * 10.0), (double)out.v_V.q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 120.0 * 0.3, (double)out.v_V.d);
}

static void test_answer_tells_what_the_law_acted_on(void)
{
    sample.theta_e_rad = 0.25f;

    const nodo_meas_t  y   = sample_measurement(&sample);
    const law_output_t out = law_answer(&drive, &state, &in);

    TEST_ASSERT_TRUE((out.now.omega_e_radps == 200.0f) && (out.now.iq_A == y.iq_A) &&
                     (out.now.id_A == y.id_A));
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 0.25 + (1.5 * (double)drive.ts_s * 200.0),
                              (double)out.theta_rad);
    TEST_ASSERT_TRUE((out.i_ref_A.d == 0.0f) && (out.i_ref_A.q == 0.0f));
    TEST_ASSERT_TRUE((out.d_omega == 0.0f) && (out.d_q == 0.0f) && (out.d_d == 0.0f));
    TEST_ASSERT_TRUE(out.plausible);
}

static void test_integrals_take_over_what_was_produced_in_full(void)
{
    in.v_V = law_answer(&drive, &state, &in).v_V;

    const law_output_t second = law_answer(&drive, &state, &in);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, hold_V() + (0.0075 * 10.0), (double)s->pid.integral_V);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 0.024 * 0.3, (double)s->id_pi.integral_V);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, hold_V() + (0.9 * 10.0) + (0.0075 * 10.0),
                              (double)second.v_V.q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (120.0 * 0.3) + (0.024 * 0.3), (double)second.v_V.d);
}

/* An axis that was cut does not integrate further, the other does. */
static void test_integral_of_a_limited_axis_stands(void)
{
    const law_output_t first = law_answer(&drive, &state, &in);

    in.v_V   = first.v_V;
    in.v_V.q = 20.0f;
    (void)law_answer(&drive, &state, &in);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, hold_V(), (double)s->pid.integral_V);
    TEST_ASSERT_TRUE(s->id_pi.integral_V > 0.0f);

    setUp();
    in.v_V   = law_answer(&drive, &state, &in).v_V;
    in.v_V.d = 10.0f;
    (void)law_answer(&drive, &state, &in);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, hold_V() + (0.0075 * 10.0), (double)s->pid.integral_V);
    TEST_ASSERT_TRUE(s->id_pi.integral_V == 0.0f);
}

/* The derivative is of the error between two samples. */
static void test_change_of_the_error_adds_its_share(void)
{
    in.v_V               = law_answer(&drive, &state, &in).v_V;
    sample.omega_e_radps = 199.0f;

    const law_output_t second = law_answer(&drive, &state, &in);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, hold_V() + (0.0075 * 10.0) + (0.9 * 11.0) + (20.0 * 1.0),
                              (double)second.v_V.q);
}

static void test_start_forgets_the_past(void)
{
    const law_output_t first = law_answer(&drive, &state, &in);
    for (int n = 0; n < 10; n++) {
        in.v_V = law_answer(&drive, &state, &in).v_V;
    }

    drive.law->reset(&state, &drive, &sample);
    const law_output_t again = law_answer(&drive, &state, &in);

    TEST_ASSERT_TRUE((again.v_V.d == first.v_V.d) && (again.v_V.q == first.v_V.q));
}

static void test_check_wants_every_constant(void)
{
    float *const constants[] = {&config.pid.kp,   &config.pid.ki_per_tick,   &config.pid.kd_tick,
                                &config.id_pi.kp, &config.id_pi.ki_per_tick, &config.id_pi.kd_tick};

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&drive));
    for (int i = 0; i < SUPPORT_COUNT(constants); i++) {
        const float kept = *constants[i];
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            *constants[i] = support_not_finite[k];
            TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
        }
        *constants[i] = -1.0f;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
        *constants[i] = kept;
    }
}

static void test_tick_runs_the_law_on_the_measurement(void)
{
    const drive_command_t command = {.omega_e_radps = 210.0f, .run = true};
    drive_t               d;

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&d, &drive));
    const bridge_t     out  = drive_tick(&d, &sample, &command);
    const law_output_t want = law_answer(&drive, &state, &in);

    TEST_ASSERT_TRUE(out.gate_enable);
    TEST_ASSERT_FALSE(d.v_limited);
    TEST_ASSERT_TRUE((d.v_V.d == want.v_V.d) && (d.v_V.q == want.v_V.q));
    (void)drive_tick(&d, &sample, &command);
    in.v_V = want.v_V;
    TEST_ASSERT_TRUE(d.v_V.q == law_answer(&drive, &state, &in).v_V.q);
}

static void test_tick_trips_when_the_law_gives_no_number(void)
{
    const drive_command_t command = {.omega_e_radps = 210.0f, .run = true};
    drive_t               d;

    (void)drive_init(&d, &drive);
    (void)drive_tick(&d, &sample, &command);
    d.law.pid.pid.integral_V = NAN;

    TEST_ASSERT_FALSE(drive_tick(&d, &sample, &command).gate_enable);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NUMERIC, d.fault);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_pid_starts_from_the_back_emf);
    RUN_TEST(test_answer_tells_what_the_law_acted_on);
    RUN_TEST(test_integrals_take_over_what_was_produced_in_full);
    RUN_TEST(test_integral_of_a_limited_axis_stands);
    RUN_TEST(test_change_of_the_error_adds_its_share);
    RUN_TEST(test_start_forgets_the_past);
    RUN_TEST(test_check_wants_every_constant);
    RUN_TEST(test_tick_runs_the_law_on_the_measurement);
    RUN_TEST(test_tick_trips_when_the_law_gives_no_number);
    return UNITY_END();
}
