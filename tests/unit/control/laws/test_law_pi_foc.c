/* SPDX-License-Identifier: MIT */
#include "law_pi_foc.h"

#include "drive_tick.h"
#include "gain_tables.h"
#include "law_answer.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_radps2 0.25 /* rad/s^2, of some thousands: digits of an angle; worst 0.042 */

static law_pi_foc_config_t config;
static drive_config_t drive; /* the shipped motor's limits and constants around the law above */
static law_state_t    state;
static law_pi_foc_state_t *const s = &state.pi_foc;
static drive_sample_t            sample;
static law_input_t               in;

void setUp(void)
{
    const law_pi_foc_config_t c = {
        .foc   = {.d                 = {190.0f, 1.2f, 0.0063f},
                  .q                 = {280.0f, 1.2f, 0.0043f},
                  .current_max_A     = 4.0f,
                  .iq_max_A          = 3.3f,
                  .mtpa_A            = 2.5f,
                  .id_min_A          = -2.5f,
                  .voltage_share     = 0.95f,
                  .weakening_A_per_V = 1.0e-3f},
        .speed = {.periods        = 5,
                  .inv_span_1ps   = 1000.0f,
                  .edge_gap_max_s = 4.0e-4f,
                  .count_rad      = 1.2566371e-3f},
        .gains = {{.kp_1ps = 500.0f, .ki_per_kp = 0.05f}, {.kp_1ps = 900.0f, .ki_per_kp = 0.1f}}};
    const drive_sample_t at      = {.ia_A          = 0.0f,
                                    .ib_A          = 0.0f,
                                    .dc_link_V     = 295.0f,
                                    .theta_e_rad   = 0.0f,
                                    .omega_e_radps = 200.0f,
                                    .valid         = true};
    const law_input_t    no_past = {
           .sample = &sample, .command_e_radps = 205.0f, .v_V = {.d = 0.0f, .q = 0.0f}};

    config          = c;
    sample          = at;
    in              = no_past;
    drive           = gain_tables_drive;
    drive.law       = &law_pi_foc;
    drive.torques   = false;
    drive.constants = &config;
    drive.law->reset(&state, &drive, &sample);
}

void tearDown(void) {}

/* A shaft that turns at 200 rad/s whatever the law wants, with the currents that it asked for a period ago. */
static double wanted_after(int periods)
{
    double a = NAN;

    for (int k = 0; k < periods; k++) {
        const float        sum = s->sum_e_radps2;
        const float        r   = s->r_e_radps;
        const law_output_t out = law_answer(&drive, &state, &in);

        a                  = (500.0 * ((double)r - (double)out.now.omega_e_radps)) + (double)sum;
        sample.theta_e_rad = frames_wrap(sample.theta_e_rad + (200.0f * drive.ts_s));
        const abc_t i_A    = frames_inverse_clarke(
               frames_inverse_park(out.i_ref_A, frames_angle(sample.theta_e_rad)));
        sample.ia_A = i_A.a;
        sample.ib_A = i_A.b;
        in.v_V      = s->foc.u_V; /* nothing is cut */
    }
    return a;
}

/* The filtered command r(t) = 200 + 5 (1 - q^k), and the PI of what is left of it: sums in closed form. */
static void test_wish_is_a_pi_of_the_filtered_error(void)
{
    const int    n = 20;
    const double q = 1.0 - 0.05;
    const double e = 5.0 * (1.0 - pow(q, n - 1));
    const double before =
        5.0 *
        ((double)(n - 1) - ((1.0 - pow(q, n - 1)) / (1.0 - q))); /* sum of all errors before */

    const double a = wanted_after(n);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_radps2, (500.0 * e) + (500.0 * 0.05 * before), a);
    TEST_ASSERT_TRUE(s->foc.limit == 0.0f);
}

static void test_gains_are_those_of_the_measurement(void)
{
    in.command_e_radps     = 200.0f;
    s->r_e_radps           = 203.0f;
    sample.edge_gap_s      = 2.0e-4f;
    sample.omega_e_radps   = 202.0f;
    const law_output_t out = law_answer(&drive, &state, &in);

    TEST_ASSERT_TRUE(out.now.omega_e_radps == 202.0f);
    TEST_ASSERT_TRUE(out.plausible && !out.without_angle && (out.ignored_angles == 0U));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_radps2, 0.1 * 900.0 * 1.0, (double)s->sum_e_radps2);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, 203.0 - (0.1 * 3.0), (double)s->r_e_radps);
}

/* After any time at the current limit the sum is what it was; an error the other way is taken at once. */
static void test_sum_rests_at_the_limit(void)
{
    in.command_e_radps = 900.0f;
    (void)wanted_after(100);
    const float at_limit = s->sum_e_radps2;
    (void)wanted_after(100);
    TEST_ASSERT_TRUE(s->foc.limit > 0.0f);
    TEST_ASSERT_TRUE(s->sum_e_radps2 == at_limit);
    in.command_e_radps = 100.0f;
    s->r_e_radps       = 190.0f;
    s->sum_e_radps2    = 50000.0f; /* still at the limit above */
    (void)wanted_after(1);
    TEST_ASSERT_TRUE(s->foc.limit > 0.0f);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 50000.0 - (0.05 * 500.0 * 10.0), (double)s->sum_e_radps2);
}

/* Both poles of the observer at beta: z_f of a constant acceleration that no current makes is known in closed form
 * (test_law_ladrc.c). It is taken off the wish. Without gains there is no observer. */
static void test_load_is_observed_and_fed_forward(void)
{
    const double                 beta  = exp(-500.0 * 2.0e-4);
    const speed_observer_gains_t found = {(float)(1.0 - (beta * beta)),
                                          (float)((1.0 - beta) * (1.0 - beta) / 2.0e-4)};

    for (int on = 0; on <= 1; on++) {
        double sum = 0.0;

        setUp();
        in.command_e_radps   = 200.0f;
        config.gains[1].load = (on == 1) ? found : config.gains[1].load;
        sample.edge_gap_s    = 2.0e-4f;
        (void)law_answer(&drive, &state, &in);
        for (int k = 1; k <= 20; k++) {
            sample.omega_e_radps    = 200.0f - (1000.0f * 2.0e-4f * (float)k);
            const float        kept = s->sum_e_radps2;
            const law_output_t out  = law_answer(&drive, &state, &in);
            sum -= 1000.0 * 2.0e-4 * (double)k * pow(beta, (double)(k - 1));
            const double load = (on == 1) ? ((double)found.gain_f_1ps * sum) : 0.0;
            const double wish =
                (900.0 * (200.0 - (double)sample.omega_e_radps)) + (double)kept - load;

            TEST_ASSERT_DOUBLE_WITHIN(3.0, load, (double)out.d_omega);
            TEST_ASSERT_DOUBLE_WITHIN(2.0e-3, wish / (1.5 * 4.0 * 0.193 / 0.00042),
                                      (double)s->foc.i_ref_A.q);
            s->foc.i_ref_A.d = 0.0f; /* so that l1 alone divides in the next period */
        }
    }
}

/* Torque of references: 1.5 np (flux + (Ld - Lq) id) iq; the law divides by the previous id. */
static double torque_of_Nm(dq_t ref_A, double id_before_A)
{
    return 1.5 * 2.0 * (0.193 + ((0.07498 - 0.11391) * id_before_A)) * (double)ref_A.q;
}

/* The command's share of the rated 1.5 N m, whatever the speed, its reference and the load. */
static void test_a_torque_is_what_the_references_make(void)
{
    for (int k = -5; k <= 5; k++) {
        const torque_command_t command = {.share = 0.2f * (float)k, .speed_max_e_radps = 1000.0f};
        const law_aim_t        aim     = {.torque = &command};

        setUp();
        in.aim               = &aim;
        s->load.z_f_e_radps2 = 700.0f; /* kept: the observer has no gains */
        for (int i = 0; i < 20; i++) {
            const double       before_A = (double)s->foc.i_ref_A.d;
            const law_output_t out      = law_answer(&drive, &state, &in);

            TEST_ASSERT_DOUBLE_WITHIN(2.0e-4, 0.3 * (double)k, torque_of_Nm(out.i_ref_A, before_A));
            TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, s->r_e_radps, out.now.omega_e_radps);
            TEST_ASSERT_TRUE(out.profile_e_radps == out.now.omega_e_radps); /* motion_watch.h */
            sample.theta_e_rad = frames_wrap(sample.theta_e_rad + (200.0f * drive.ts_s));
        }
    }
}

/* At 200 rad/s with 1 rad/s to the limit: a P of it, less the load that the observer knows. Either way. */
static void test_the_speed_limit_takes_torque_away(void)
{
    const double per_Nm = 1.0 / (0.00042 / 2.0); /* rad/s^2 per N m */

    for (int sign = -1; sign <= 1; sign += 2) {
        for (int left = -3; left <= 3; left++) {
            const torque_command_t command = {.share             = (float)sign,
                                              .speed_max_e_radps = 200.0f + (float)left};
            const law_aim_t        aim     = {.torque = &command};

            setUp();
            in.aim               = &aim;
            sample.omega_e_radps = (float)sign * 200.0f;
            sample.edge_gap_s    = 2.0e-4f; /* the sample's speed is used */
            drive.law->reset(&state, &drive, &sample);
            s->load.z_f_e_radps2    = (float)sign * -400.0f; /* kept: the observer has no gains */
            const law_output_t out  = law_answer(&drive, &state, &in);
            const double       most = ((900.0 * (double)left) + 400.0) / per_Nm;

            TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, (double)sign * fmin(most, 1.5),
                                      torque_of_Nm(out.i_ref_A, 0.0));
        }
    }
}

/* A speed run at the shaft's speed goes on with the torque, and a torque run with that of a speed run. */
static void test_runs_change_without_a_bump(void)
{
    const torque_command_t command = {.share = 0.4f, .speed_max_e_radps = 1000.0f};
    const law_aim_t        aim     = {.torque = &command};

    in.aim               = &aim;
    s->load.z_f_e_radps2 = -700.0f; /* kept: the observer has no gains */
    (void)wanted_after(50);
    const float torque_A = s->foc.i_ref_A.q;
    in.aim               = NULL;
    in.command_e_radps   = s->r_e_radps;
    for (int k = 0; k < 20; k++) {
        (void)wanted_after(1);
        TEST_ASSERT_FLOAT_WITHIN(2.0e-3f, torque_A, s->foc.i_ref_A.q);
    }
    in.aim = &aim;
    (void)wanted_after(1);
    TEST_ASSERT_FLOAT_WITHIN(2.0e-3f, torque_A, s->foc.i_ref_A.q);
}

static void test_mirror_image_gives_the_mirror_image(void)
{
    law_state_t    mirror;
    drive_sample_t left = sample;

    left.omega_e_radps      = -200.0f;
    law_input_t in_left     = in;
    in_left.sample          = &left;
    in_left.command_e_radps = -205.0f;
    drive.law->reset(&mirror, &drive, &left);
    for (int k = 0; k < 30; k++) {
        const law_output_t a = law_answer(&drive, &state, &in);
        const law_output_t b = law_answer(&drive, &mirror, &in_left);

        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, (double)a.v_V.q, -(double)b.v_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, (double)a.v_V.d, (double)b.v_V.d);
        sample.theta_e_rad = frames_wrap(sample.theta_e_rad + 0.04f);
        left.theta_e_rad   = -sample.theta_e_rad;
    }
}

static void test_check_wants_every_constant(void)
{
    float *const constants[] = {&config.foc.q.kp_V_per_A,   &config.speed.inv_span_1ps,
                                &config.gains[0].kp_1ps,    &config.gains[1].kp_1ps,
                                &config.gains[0].ki_per_kp, &config.gains[1].ki_per_kp};
    float *const loads[]     = {&config.gains[0].load.gain_w, &config.gains[1].load.gain_f_1ps};

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
    for (int i = 0; i < SUPPORT_COUNT(loads); i++) {
        *loads[i] = -1.0e-3f;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
        *loads[i] = NAN;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&drive));
        *loads[i] = 0.0f;
    }
}

static void test_tick_trips_when_the_law_gives_no_number(void)
{
    const drive_command_t command = {.omega_e_radps = 205.0f, .run = true};
    drive_t               d;

    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        (void)drive_init(&d, &drive);
        TEST_ASSERT_TRUE(drive_tick(&d, &sample, &command).gate_enable);
        d.law.pi_foc.sum_e_radps2 = support_not_finite[k];
        TEST_ASSERT_FALSE(drive_tick(&d, &sample, &command).gate_enable);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NUMERIC, d.fault);
    }
    drive.torques = true;
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        const torque_command_t torque   = {.share = 0.5f, .speed_max_e_radps = 1000.0f};
        const law_aim_t        aim      = {.torque = &torque};
        const drive_command_t  a_torque = {.aim = &aim, .run = true};

        (void)drive_init(&d, &drive);
        TEST_ASSERT_TRUE(drive_tick(&d, &sample, &a_torque).gate_enable);
        d.law.pi_foc.load.z_f_e_radps2 = support_not_finite[k];
        TEST_ASSERT_FALSE(drive_tick(&d, &sample, &a_torque).gate_enable);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NUMERIC, d.fault);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_wish_is_a_pi_of_the_filtered_error);
    RUN_TEST(test_gains_are_those_of_the_measurement);
    RUN_TEST(test_sum_rests_at_the_limit);
    RUN_TEST(test_load_is_observed_and_fed_forward);
    RUN_TEST(test_a_torque_is_what_the_references_make);
    RUN_TEST(test_the_speed_limit_takes_torque_away);
    RUN_TEST(test_runs_change_without_a_bump);
    RUN_TEST(test_mirror_image_gives_the_mirror_image);
    RUN_TEST(test_check_wants_every_constant);
    RUN_TEST(test_tick_trips_when_the_law_gives_no_number);
    return UNITY_END();
}
