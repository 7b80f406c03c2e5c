/* SPDX-License-Identifier: MIT */
#include "servo_law.h"

#include "drive_tick.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_V 1.0e-4 /* V, voltages up to 100 V */

static servo_law_config_t config;
static servo_law_t        law;
static const nodo_meas_t  at = {.omega_e_radps = 200.0f, .iq_A = 1.2f, .id_A = -0.3f};

void setUp(void)
{
    const servo_law_config_t c = {.kind  = SERVO_LAW_DOBC,
                                  .dobc  = {.n_x        = 2,
                                            .direct_Vs  = 0.084f,
                                            .ld_H       = 0.026f,
                                            .k_omega_Vs = 0.6f,
                                            .k_x        = {21.0f, 0.026f},
                                            .m          = {{0.9f, 7.0e-5f}, {-20.0f, 1.0f}},
                                            .g          = {0.3f, 15.0f},
                                            .h          = {-3.0e-3f, 0.04f}},
                                  .pid   = {.kp = 0.9f, .ki_per_tick = 0.0075f, .kd_tick = 20.0f},
                                  .id_pi = {.kp = 120.0f, .ki_per_tick = 0.024f, .kd_tick = 0.0f}};

    config = c;
    servo_law_reset(&law, 0.0f);
}

void tearDown(void) {}

static void test_dobc_adds_direct_and_indirect_voltage(void)
{
    const dq_t u_V = servo_law_voltage_V(&law, &config, &at, 210.0f);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, ((0.084 + (0.026 * -0.3)) * 200.0) + (0.6 * 10.0),
                              (double)u_V.q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 120.0 * 0.3, (double)u_V.d);
}

/* EQ-DOBC-3 sees u_qi alone: what the limits left without the direct part. */
static void test_dobc_gets_the_realised_indirect_voltage(void)
{
    const dq_t limited_V = {.d = 10.0f, .q = 20.0f};

    (void)servo_law_voltage_V(&law, &config, &at, 210.0f);
    servo_law_realise(&law, &config, limited_V);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 20.0 - ((0.084 + (0.026 * -0.3)) * 200.0),
                              (double)law.dobc.ui_V);
    TEST_ASSERT_TRUE(law.id_pi.integral_V == 0.0f); /* 36 V asked for and cut to 10 V */
}

static void test_pid_starts_from_the_back_emf(void)
{
    config.kind = SERVO_LAW_PID;
    servo_law_reset(&law, 17.5f);

    const dq_t u_V = servo_law_voltage_V(&law, &config, &at, 210.0f);
    servo_law_realise(&law, &config, u_V);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 17.5 + (0.9 * 10.0), (double)u_V.q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 17.5 + (0.0075 * 10.0), (double)law.pid.integral_V);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 0.024 * 0.3, (double)law.id_pi.integral_V);
    TEST_ASSERT_TRUE(law.dobc.ui_V == 0.0f);
}

/* The shipped motor's limits and constants around the law above. */
static drive_config_t servo_drive(void)
{
    drive_config_t c = gain_tables_drive;
    c.law            = DRIVE_LAW_SERVO;
    c.servo          = config;
    return c;
}

static void test_check_wants_every_constant_of_the_law_in_use(void)
{
    drive_config_t c       = servo_drive();
    float *const of_dobc[] = {&c.servo.dobc.k_omega_Vs, &c.servo.dobc.direct_Vs, &c.servo.dobc.ld_H,
                              &c.servo.dobc.k_x[1],     &c.servo.dobc.m[1][1],   &c.servo.dobc.g[1],
                              &c.servo.dobc.h[1],       &c.servo.id_pi.kp};
    float *const of_pid[]  = {&c.servo.pid.kp, &c.servo.pid.ki_per_tick, &c.servo.pid.kd_tick};

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&c));
    for (int i = 0; i < SUPPORT_COUNT(of_dobc); i++) {
        const float kept = *of_dobc[i];
        *of_dobc[i]      = NAN;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&c));
        *of_dobc[i] = kept;
    }
    for (int i = 0; i < SUPPORT_COUNT(of_pid); i++) {
        const float kept = *of_pid[i];
        *of_pid[i]       = NAN;
        TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&c)); /* not in use */
        c.servo.kind = SERVO_LAW_PID;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&c));
        c.servo.kind = SERVO_LAW_DOBC;
        *of_pid[i]   = kept;
    }
    for (int k = 0; k < 2; k++) {
        c.servo.dobc.n_x = (k == 0) ? 0 : DOBC_N_X_MAX + 1;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&c));
    }
}

static void test_check_refuses_a_law_that_does_not_exist(void)
{
    drive_config_t c = servo_drive();
    c.law            = (drive_law_t)77;

    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&c));
}

static drive_sample_t sample(void)
{
    const drive_sample_t s = {.ia_A          = 0.5f,
                              .ib_A          = -0.2f,
                              .dc_link_V     = 295.0f,
                              .theta_e_rad   = 1.0f,
                              .omega_e_radps = 200.0f,
                              .valid         = true};
    return s;
}

static void test_tick_runs_the_law_on_the_measurement(void)
{
    const drive_config_t  c       = servo_drive();
    const drive_sample_t  s       = sample();
    const drive_command_t command = {.omega_e_radps = 210.0f, .run = true};
    const float           hold_V  = c.motor.l5 * c.motor.inv_l6 * 200.0f;
    drive_t               drive;

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &c));
    const drive_output_t out = drive_tick(&drive, &s, &command);
    servo_law_reset(&law, hold_V);
    const dq_t u_V = servo_law_voltage_V(&law, &config, &drive.now, 210.0f);

    TEST_ASSERT_TRUE(out.gate_enable);
    TEST_ASSERT_FALSE(drive.v_limited);
    TEST_ASSERT_TRUE((drive.v_V.d == u_V.d) && (drive.v_V.q == u_V.q));
    TEST_ASSERT_TRUE(drive.now.omega_e_radps == 200.0f);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)(u_V.q - drive.servo.direct_V),
                              (double)drive.servo.dobc.ui_V);
}

static void test_tick_trips_when_the_law_gives_no_number(void)
{
    const drive_config_t  c       = servo_drive();
    const drive_sample_t  s       = sample();
    const drive_command_t command = {.omega_e_radps = 210.0f, .run = true};
    drive_t               drive;

    (void)drive_init(&drive, &c);
    (void)drive_tick(&drive, &s, &command);
    drive.servo.dobc.x[0] = NAN;

    TEST_ASSERT_FALSE(drive_tick(&drive, &s, &command).gate_enable);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NUMERIC, drive.fault);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_dobc_adds_direct_and_indirect_voltage);
    RUN_TEST(test_dobc_gets_the_realised_indirect_voltage);
    RUN_TEST(test_pid_starts_from_the_back_emf);
    RUN_TEST(test_check_wants_every_constant_of_the_law_in_use);
    RUN_TEST(test_check_refuses_a_law_that_does_not_exist);
    RUN_TEST(test_tick_runs_the_law_on_the_measurement);
    RUN_TEST(test_tick_trips_when_the_law_gives_no_number);
    return UNITY_END();
}
