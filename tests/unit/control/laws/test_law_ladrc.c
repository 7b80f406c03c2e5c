/* SPDX-License-Identifier: MIT */
#include "law_ladrc.h"

#include "drive_tick.h"
#include "gain_tables.h"
#include "law_answer.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_radps 1.0e-3 /* rad/s at 200 rad/s; worst 2e-4 */

static law_ladrc_config_t config;
static drive_config_t     drive; /* the shipped motor's limits and constants around the law above */
static law_state_t        state;
static law_ladrc_state_t *const s = &state.ladrc;
static drive_sample_t           sample;
static law_input_t              in;

static law_ladrc_gains_t gains(double w_o, double w_c)
{
    const double            beta = exp(-w_o * 2.0e-4);
    const law_ladrc_gains_t g    = {
           {(float)(1.0 - (beta * beta)), (float)((1.0 - beta) * (1.0 - beta) / 2.0e-4)}, (float)w_c};
    return g;
}

void setUp(void)
{
    const law_ladrc_config_t c       = {.foc   = {.d                 = {190.0f, 1.2f, 0.0063f},
                                                  .q                 = {280.0f, 1.2f, 0.0043f},
                                                  .current_max_A     = 4.0f,
                                                  .iq_max_A          = 3.3f,
                                                  .mtpa_A            = 2.5f,
                                                  .id_min_A          = -2.5f,
                                                  .voltage_share     = 0.95f,
                                                  .weakening_A_per_V = 1.0e-3f},
                                        .speed = {.periods        = 3,
                                                  .inv_span_1ps   = 1.0f / 6.0e-4f,
                                                  .edge_gap_max_s = 4.0e-4f,
                                                  .count_rad      = 1.2566371e-3f}};
    const drive_sample_t     at      = {.ia_A          = 0.0f,
                                        .ib_A          = 0.0f,
                                        .dc_link_V     = 295.0f,
                                        .theta_e_rad   = 0.0f,
                                        .edge_gap_s    = 2.0e-4f,
                                        .omega_e_radps = 200.0f,
                                        .valid         = true};
    const law_input_t        no_past = {
               .sample = &sample, .command_e_radps = 200.0f, .v_V = {.d = 0.0f, .q = 0.0f}};

    config          = c;
    config.gains[0] = gains(800.0, 400.0);
    config.gains[1] = gains(1400.0, 700.0);
    sample          = at;
    in              = no_past;
    drive           = gain_tables_drive;
    drive.law       = &law_ladrc;
    drive.torques   = false;
    drive.constants = &config;
    drive.law->reset(&state, &drive, &sample);
}

void tearDown(void) {}

/* With both poles at beta, the error of the prediction after a step f of the disturbance is
 * e(k) = f Ts sum of the double pole's weights = f Ts k beta^(k-1), so z_f(k) = f (1 - beta^k (1 + k (1 - beta) / beta))... of
 * which only this is used: with e(z) = f Ts z / (z - beta)^2, z_f is the sum of its gain times e. */
static void test_disturbance_is_found_with_a_double_pole(void)
{
    const double beta = exp(-1400.0 * 2.0e-4);
    const double f    = 5000.0;
    double       sum  = 0.0;

    (void)law_answer(&drive, &state, &in);
    for (int k = 1; k <= 40; k++) {
        sample.omega_e_radps = 200.0f + (5000.0f * 2.0e-4f * (float)k);
        (void)law_answer(&drive, &state, &in);
        sum += f * 2.0e-4 * (double)k * pow(beta, (double)(k - 1));
        const double found = (1.0 - beta) * (1.0 - beta) / 2.0e-4 * sum;
        TEST_ASSERT_DOUBLE_WITHIN(3.0, found, (double)s->observer.z_f_e_radps2);
    }
    TEST_ASSERT_DOUBLE_WITHIN(10.0, f, (double)s->observer.z_f_e_radps2);
}

/* The measured currents' torque is no disturbance: trapezoid of (l1 + l11 id) iq. */
static void test_torque_is_no_disturbance(void)
{
    double w = 200.0;
    double a = 0.0; /* of the sample before */

    (void)law_answer(&drive, &state, &in);
    for (int k = 1; k <= 50; k++) {
        /* at angle 0 the d axis is phase a: iq = (ia + 2 ib) / sqrt(3) */
        const double iq     = 2.0 * sin(0.2 * k);
        const double id     = -0.5;
        sample.ia_A         = (float)id;
        sample.ib_A         = (float)(0.5 * ((iq * sqrt(3.0)) - id));
        const double torque = 1.5 * 4.0 / 0.00042 * ((0.193 + ((0.07498 - 0.11391) * id)) * iq);
        w += 2.0e-4 * 0.5 * (a + torque);
        a                    = torque;
        sample.omega_e_radps = (float)w;
        (void)law_answer(&drive, &state, &in);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_radps, w, (double)s->observer.z_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(0.5, 0.0, (double)s->observer.z_f_e_radps2);
    }
}

static void test_wish_cancels_the_disturbance(void)
{
    s->observer.z_f_e_radps2 = -1500.0f;
    s->observer.z_e_radps    = 200.0f + (1500.0f * 2.0e-4f); /* its prediction hits the sample */
    in.command_e_radps       = 202.0f;

    const law_output_t out = law_answer(&drive, &state, &in);
    const double       l1  = 1.5 * 4.0 * 0.193 / 0.00042;

    TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, ((700.0 * 2.0) + 1500.0) / l1, (double)out.i_ref_A.q);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, -1500.0, (double)out.d_omega);
    TEST_ASSERT_TRUE((out.d_q == 0.0f) && (out.d_d == 0.0f));
    TEST_ASSERT_TRUE(out.plausible && !out.without_angle && (out.ignored_angles == 0U));
}

static void test_rare_edges_take_the_other_gains(void)
{
    sample.edge_gap_s  = 5.0e-4f;
    in.command_e_radps = 202.0f;

    const law_output_t out = law_answer(&drive, &state, &in);

    TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, 400.0 * 2.0 / (1.5 * 4.0 * 0.193 / 0.00042),
                              (double)out.i_ref_A.q);
}

static void test_start_forgets_the_past(void)
{
    const law_output_t first = law_answer(&drive, &state, &in);
    for (int n = 0; n < 10; n++) {
        sample.omega_e_radps += 1.0f;
        (void)law_answer(&drive, &state, &in);
    }

    sample.omega_e_radps = 200.0f;
    drive.law->reset(&state, &drive, &sample);
    const law_output_t again = law_answer(&drive, &state, &in);

    TEST_ASSERT_TRUE((again.v_V.d == first.v_V.d) && (again.v_V.q == first.v_V.q));
}

static void test_check_wants_every_constant(void)
{
    float *const constants[] = {&config.foc.q.kp_V_per_A,
                                &config.speed.inv_span_1ps,
                                &config.gains[0].observer.gain_w,
                                &config.gains[1].observer.gain_w,
                                &config.gains[0].observer.gain_f_1ps,
                                &config.gains[1].observer.gain_f_1ps,
                                &config.gains[0].w_c_1ps,
                                &config.gains[1].w_c_1ps};

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&drive));
    for (int i = 0; i < SUPPORT_COUNT(constants); i++) {
        const float kept = *constants[i];
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            *constants[i] = support_not_finite[k];
            TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
        }
        *constants[i] = 0.0f;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
        *constants[i] = kept;
    }
}

static void test_tick_trips_when_the_law_gives_no_number(void)
{
    const drive_command_t command = {.omega_e_radps = 205.0f, .run = true};
    drive_t               d;

    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        (void)drive_init(&d, &drive);
        TEST_ASSERT_TRUE(drive_tick(&d, &sample, &command).gate_enable);
        d.law.ladrc.observer.z_f_e_radps2 = support_not_finite[k];
        TEST_ASSERT_FALSE(drive_tick(&d, &sample, &command).gate_enable);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NUMERIC, d.fault);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_disturbance_is_found_with_a_double_pole);
    RUN_TEST(test_torque_is_no_disturbance);
    RUN_TEST(test_wish_cancels_the_disturbance);
    RUN_TEST(test_rare_edges_take_the_other_gains);
    RUN_TEST(test_start_forgets_the_past);
    RUN_TEST(test_check_wants_every_constant);
    RUN_TEST(test_tick_trips_when_the_law_gives_no_number);
    return UNITY_END();
}
