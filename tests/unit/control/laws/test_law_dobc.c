/* SPDX-License-Identifier: MIT */
#include "law_dobc.h"

#include "drive_tick.h"
#include "gain_tables.h"
#include "law_answer.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_V 1.6e-5 /* V, voltages up to 100 V; worst 3.2e-6 */

static law_dobc_config_t config;
static drive_config_t    drive; /* the shipped motor's limits and constants around the law above */
static law_state_t       state;
static law_dobc_state_t *const s = &state.dobc;
static drive_sample_t          sample;
static law_input_t             in;

void setUp(void)
{
    const law_dobc_config_t c = {.dobc  = {.n_x        = 2,
                                           .direct_Vs  = 0.084f,
                                           .ld_H       = 0.026f,
                                           .k_omega_Vs = 0.6f,
                                           .k_x        = {21.0f, 0.026f},
                                           .m          = {{0.9f, 7.0e-5f}, {-20.0f, 1.0f}},
                                           .g          = {0.3f, 15.0f},
                                           .h          = {-3.0e-3f, 0.04f}},
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
    drive.law       = &law_dobc;
    drive.torques   = false;
    drive.constants = &config;
    drive.law->reset(&state, &drive, &sample);
}

void tearDown(void) {}

static void test_law_adds_direct_and_indirect_voltage(void)
{
    const law_output_t out = law_answer(&drive, &state, &in);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, ((0.084 + (0.026 * -0.3)) * 200.0) + (0.6 * 10.0),
                              (double)out.v_V.q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 120.0 * 0.3, (double)out.v_V.d);
}

/* It acts on the measurement; it has no reference, no estimate of disturbances, and doubts no angle. */
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

/* EQ-DOBC-3 sees u_qi alone: what the limits left without the direct part of the voltage that they limited. */
static void test_next_step_takes_over_what_the_limits_left(void)
{
    const double       per_Vs   = 0.084 + (0.026 * -0.3);
    const double       ui_V     = 20.0 - (per_Vs * 200.0);
    const law_output_t first    = law_answer(&drive, &state, &in);
    dobc_t             expected = s->dobc;

    TEST_ASSERT_TRUE(fabs((double)first.v_V.q - 20.0) > 1.0);
    in.v_V.d             = 10.0f;
    in.v_V.q             = 20.0f;
    sample.omega_e_radps = 190.0f; /* another direct part from here on, and an error of 20 rad/s */
    expected.ui_V        = (float)ui_V;
    const float        u_V    = dobc_update(&expected, &config.dobc, 20.0f);
    const law_output_t second = law_answer(&drive, &state, &in);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, ui_V, (double)s->dobc.ui_V);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)u_V + (per_Vs * 190.0), (double)second.v_V.q);
    TEST_ASSERT_TRUE(s->id_pi.integral_V == 0.0f); /* 36 V asked for and cut to 10 V */
}

static void test_d_axis_integrates_what_was_produced_in_full(void)
{
    const law_output_t first = law_answer(&drive, &state, &in);
    in.v_V                   = first.v_V;

    const law_output_t second = law_answer(&drive, &state, &in);

    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 0.024 * 0.3, (double)s->id_pi.integral_V);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (120.0 * 0.3) + (0.024 * 0.3), (double)second.v_V.d);
}

static void test_start_forgets_the_past(void)
{
    const law_output_t first = law_answer(&drive, &state, &in);
    for (int n = 0; n < 10; n++) {
        in.v_V = law_answer(&drive, &state, &in).v_V;
    }

    drive.law->reset(&state, &drive, &sample);
    in.v_V.d                 = 0.0f;
    in.v_V.q                 = 0.0f;
    const law_output_t again = law_answer(&drive, &state, &in);

    TEST_ASSERT_TRUE((again.v_V.d == first.v_V.d) && (again.v_V.q == first.v_V.q));
    TEST_ASSERT_TRUE((s->dobc.x[0] == 0.0f) && (s->id_pi.integral_V == 0.0f));
}

/* Whatever the memory held before. */
static void test_start_knows_no_direct_voltage(void)
{
    s->direct_V = 50.0f;

    drive.law->reset(&state, &drive, &sample);

    TEST_ASSERT_TRUE(s->direct_V == 0.0f);
}

static void test_check_wants_every_constant(void)
{
    float *const constants[] = {
        &config.dobc.k_omega_Vs,   &config.dobc.direct_Vs, &config.dobc.ld_H, &config.dobc.k_x[1],
        &config.dobc.m[1][1],      &config.dobc.g[1],      &config.dobc.h[1], &config.id_pi.kp,
        &config.id_pi.ki_per_tick, &config.id_pi.kd_tick};

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&drive));
    for (int i = 0; i < SUPPORT_COUNT(constants); i++) {
        const float kept = *constants[i];
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            *constants[i] = support_not_finite[k];
            TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
        }
        *constants[i] = kept;
    }
    for (int k = 0; k < 2; k++) {
        config.dobc.n_x = (k == 0) ? 0 : DOBC_N_X_MAX + 1;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
    }
}

/* Beyond n_x the tables may hold anything. */
static void test_check_looks_at_the_states_in_use(void)
{
    config.dobc.k_x[2]  = NAN;
    config.dobc.m[0][2] = NAN;
    config.dobc.m[2][0] = NAN;
    config.dobc.g[2]    = NAN;
    config.dobc.h[2]    = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&drive));

    config.dobc.n_x = DOBC_N_X_MAX;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
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
    TEST_ASSERT_TRUE(d.answer.now.omega_e_radps == 200.0f);
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
    d.law.dobc.dobc.x[0] = NAN;

    TEST_ASSERT_FALSE(drive_tick(&d, &sample, &command).gate_enable);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NUMERIC, d.fault);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_law_adds_direct_and_indirect_voltage);
    RUN_TEST(test_answer_tells_what_the_law_acted_on);
    RUN_TEST(test_next_step_takes_over_what_the_limits_left);
    RUN_TEST(test_d_axis_integrates_what_was_produced_in_full);
    RUN_TEST(test_start_forgets_the_past);
    RUN_TEST(test_start_knows_no_direct_voltage);
    RUN_TEST(test_check_wants_every_constant);
    RUN_TEST(test_check_looks_at_the_states_in_use);
    RUN_TEST(test_tick_runs_the_law_on_the_measurement);
    RUN_TEST(test_tick_trips_when_the_law_gives_no_number);
    return UNITY_END();
}
