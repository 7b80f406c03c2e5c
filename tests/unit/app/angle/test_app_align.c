/* SPDX-License-Identifier: MIT */
#include "app_align.h"

#include <string.h>

#include "board_config.h"
#include "gain_tables.h"
#include "speed_tables.h"
#include "test_motor.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_FREE_cnt 3    /* counts of the free shaft from phase a; worst 2 */
#define TOL_A        0.02 /* A, current along the vector at rest; worst 0.003 */
#define TICKS_ALL    20000
#define TICKS_WATCH  500
#define TICKS_BEFORE 14000 /* watch, ramp, sweep and settle together */

static app_align_config_t config;
static app_align_t        align;
static test_motor_t       motor;
static int                direction; /* of the encoder */
static double             load_Nm;   /* comes when the bridge closes, like a brake that opens */
static double             peak_A;
static double             off_a_A; /* errors of the sensors */
static double             off_b_A;

void setUp(void)
{
    (void)memset(&align, 0xFF, sizeof align); /* init has to set everything */
    config    = board_config.align;
    motor     = test_motor_390w();
    direction = 1;
    peak_A    = 0.0;
    load_Nm   = 0.0;
    off_a_A   = 0.0;
    off_b_A   = 0.0;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_align_init(&align, &config, &speed_tables_drive));
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_WATCH, align.stage);
}

void tearDown(void) {}

static uint16_t position(void)
{
    const int forward = test_motor_position(&motor, 0.0);
    return (uint16_t)((direction > 0) ? forward : (9999 - forward));
}

static bridge_t tick(void)
{
    const bridge_t out = app_align_tick(
        &align, &speed_tables_drive.dead_time, (float)(test_motor_phase_A(&motor, 0) + off_a_A),
        (float)(test_motor_phase_A(&motor, 1) + off_b_A), (float)motor.v_dc_V, position());
    const double duty[3] = {(double)out.duty.a, (double)out.duty.b, (double)out.duty.c};
    motor.load_Nm        = out.gate_enable ? load_Nm : 0.0;
    test_motor_period(&motor, duty, out.gate_enable);
    peak_A = fmax(peak_A, hypot(motor.id_A, motor.iq_A));
    return out;
}

/* A sensor that moves in the last ticks, or in the very last one, is not taken over by the run. Its movement reaches the
 * loop slowly, so the current is off. */
static void test_a_sensor_that_moves_at_the_end_is_refused(void)
{
    const int before[] = {1, 2, 10, 100, 400};

    for (int n = 0; n < 20; n++) {
        setUp();
        const double off_A = ((n & 1) != 0) ? 0.9 : -0.9;
        const bool   is_b  = (n & 2) != 0;
        app_align_start(&align, position());
        for (int k = 1; (k <= TICKS_ALL) && (align.stage < APP_ALIGN_DONE); k++) {
            const bool off = k > (14000 - before[n / 4]);
            off_a_A        = (off && !is_b) ? off_A : 0.0;
            off_b_A        = (off && is_b) ? off_A : 0.0;
            (void)tick();
        }
        TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
    }
}

/* Returns the number of ticks until the end. */
static int align_from(double theta_e_rad)
{
    motor.theta_m_rad = theta_e_rad / 2.0;
    app_align_start(&align, position());
    for (int n = 1; n <= TICKS_ALL; n++) {
        (void)tick();
        if ((align.stage == APP_ALIGN_DONE) || (align.stage == APP_ALIGN_FAILED)) {
            return n;
        }
    }
    return TICKS_ALL + 1;
}

/* Counts of the d axis from phase a, of one of the pole pairs. */
static double off_cnt(void)
{
    return remainder(2.0 * motor.theta_m_rad, 6.283185307179586) * 5000.0 / 6.283185307179586;
}

static void test_free_shaft_is_found_from_anywhere(void)
{
    for (int degree = -180; degree < 180; degree += 15) {
        setUp();
        TEST_ASSERT_TRUE(align_from((double)degree * 0.017453292519943) <= TICKS_BEFORE);
        TEST_ASSERT_EQUAL_INT(APP_ALIGN_DONE, align.stage);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_FREE_cnt, 0.0, off_cnt());
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (double)config.current_A, motor.id_A);
        TEST_ASSERT_TRUE(peak_A < 4.0);
    }
}

/* With friction the rotor stays at the dead point opposite the first vector until the vector turns. */
static void test_dead_point_is_left_in_the_sweep(void)
{
    motor.coulomb_Nm = 0.03;
    (void)align_from(0.0);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_DONE, align.stage);
}

/* Derivation in board_config.c: T over 0.69 N m per electrical radian; 0.087 N m are 100 counts. */
static void test_load_turns_the_result_by_the_stated_angle(void)
{
    for (int step = -4; step <= 4; step++) {
        setUp();
        load_Nm             = 0.087 * (double)step / 4.0;
        const double wanted = -100.0 * (double)step / 4.0;

        (void)align_from(1.0);

        TEST_ASSERT_EQUAL_INT(APP_ALIGN_DONE, align.stage);
        TEST_ASSERT_DOUBLE_WITHIN(5.0, wanted, off_cnt()); /* the spring is not quite straight */
    }
}

static void test_parameters_of_the_motor_may_be_wrong_by_half(void)
{
    for (int n = 0; n < 4; n++) {
        setUp();
        motor.rs_Ohm *= ((n & 1) != 0) ? 1.5 : 0.67;
        motor.ld_H *= ((n & 2) != 0) ? 1.5 : 0.67;
        motor.lq_H *= ((n & 2) != 0) ? 1.5 : 0.67;
        (void)align_from(2.0);
        TEST_ASSERT_EQUAL_INT(APP_ALIGN_DONE, align.stage);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_FREE_cnt, 0.0, off_cnt());
        TEST_ASSERT_TRUE(peak_A < 4.0);
    }
}

static void test_three_times_the_inertia_still_comes_to_rest(void)
{
    for (int degree = -150; degree < 180; degree += 60) {
        setUp();
        motor.inertia_kgm2 *= 3.0;
        (void)align_from((double)degree * 0.017453292519943);
        TEST_ASSERT_EQUAL_INT(APP_ALIGN_DONE, align.stage);
        TEST_ASSERT_DOUBLE_WITHIN(5.0, 0.0, off_cnt()); /* within what counts as rest */
    }
}

static void test_shaft_that_turns_is_refused_before_the_bridge_closes(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        setUp();
        motor.omega_m_radps = 0.1 * (double)sign;
        app_align_start(&align, position());
        int n = 0;
        while ((align.stage == APP_ALIGN_WATCH) && (n < TICKS_ALL)) {
            TEST_ASSERT_FALSE(tick().gate_enable);
            n++;
        }
        TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
    }
}

static void test_bridge_stays_open_while_watching(void)
{
    app_align_start(&align, position());
    for (int n = 1; n < TICKS_WATCH; n++) {
        const bridge_t out = tick();
        TEST_ASSERT_FALSE(out.gate_enable);
        TEST_ASSERT_TRUE((out.duty.a == 0.5f) && (out.duty.b == 0.5f) && (out.duty.c == 0.5f));
    }
    TEST_ASSERT_TRUE(tick().gate_enable);
}

static void test_locked_shaft_fails(void)
{
    motor.coulomb_Nm = 10.0;
    (void)align_from(0.4);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
}

static void test_encoder_that_counts_backwards_fails(void)
{
    direction = -1;
    (void)align_from(0.4);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
}

static void test_wrong_pole_pairs_fail(void)
{
    motor.pole_pairs = 3;
    (void)align_from(0.4);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
}

/* The current is that of the last vector. */
static void tick_at(int position_cnt)
{
    const float along_A = config.current_A;
    (void)app_align_tick(&align, &speed_tables_drive.dead_time, along_A, -0.5f * along_A, 295.0f,
                         (uint16_t)((position_cnt + 10000) % 10000));
}

/* Free of everything but its own counts: the encoder is moved by hand. */
static void settle_with(int moved_cnt)
{
    app_align_start(&align, 0U);
    for (int n = 1; n < TICKS_BEFORE; n++) {
        const bool after_middle = n > (500 + 1500 + 3000);
        const int  there        = (after_middle ? 1250 : 0) + ((n > 13600) ? moved_cnt : 0);
        tick_at(there);
    }
    tick_at(1250 + moved_cnt);
}

static void test_shaft_must_rest_at_the_end(void)
{
    settle_with(4);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_DONE, align.stage);
    settle_with(-4);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_DONE, align.stage);
    settle_with(5);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
    settle_with(-5);
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
}

/* An open phase: the regulator finds no current and must not ask for more than 2 R I. */
static void test_voltage_is_limited_when_no_current_flows(void)
{
    const double most_V = 2.0 * 2.48 * 2.0;
    double       seen_V = 0.0;
    app_align_start(&align, 0U);
    for (int n = 0; n < 4000; n++) {
        const bridge_t out =
            app_align_tick(&align, &speed_tables_drive.dead_time, 0.0f, 0.0f, 295.0f, 0U);
        const double a = (double)out.duty.a, b = (double)out.duty.b, c = (double)out.duty.c;
        const double alpha = 295.0 * ((2.0 * a) - b - c) / 3.0;
        const double beta  = 295.0 * (b - c) / sqrt(3.0);
        seen_V             = fmax(seen_V, hypot(alpha, beta));
    }
    /* the dead time adds 4/3 of its share of the dc link */
    TEST_ASSERT_DOUBLE_WITHIN(0.01, most_V + (4.0 / 3.0 * 0.015 * 295.0), seen_V);
}

static void test_current_beyond_the_limit_opens_the_bridge_at_once(void)
{
    static const float too_much[][2] = {
        {4.01f, -2.005f}, {-4.01f, 2.005f}, {0.0f, 3.48f}, {NAN, 0.0f}, {0.0f, INFINITY}};
    for (int i = 0; i < SUPPORT_COUNT(too_much); i++) {
        setUp();
        app_align_start(&align, 0U);
        for (int n = 0; n < 2500; n++) {
            (void)app_align_tick(&align, &speed_tables_drive.dead_time, 3.99f, -1.995f, 295.0f, 0U);
        }
        TEST_ASSERT_EQUAL_INT(APP_ALIGN_SWEEP, align.stage);
        const bridge_t out = app_align_tick(&align, &speed_tables_drive.dead_time, too_much[i][0],
                                            too_much[i][1], 295.0f, 0U);
        TEST_ASSERT_FALSE(out.gate_enable);
        TEST_ASSERT_EQUAL_INT(APP_ALIGN_FAILED, align.stage);
    }
}

static void test_second_alignment_forgets_the_first(void)
{
    (void)align_from(0.4);
    const float used_V = align.integral_V;
    app_align_start(&align, position());

    TEST_ASSERT_TRUE((used_V > 1.0f) && (align.integral_V == 0.0f));
    TEST_ASSERT_EQUAL_INT(APP_ALIGN_WATCH, align.stage);
    TEST_ASSERT_FALSE(tick().gate_enable);
}

/* Gains of EQ-APP-ALIGN-1 with R = 2.48 Ohm, L_d = 74.98 mH, w_c = 100 1/s, I = 2 A, 200 us. */
static void test_gains_follow_the_winding(void)
{
    config.bandwidth_radps = 100.0f;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_align_init(&align, &config, &gain_tables_drive));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 7.498f, align.kp_VpA);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 0.0496f, align.ki_VpA);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 9.92f, align.v_max_V);
}

static ctl_status_t init(void)
{
    return app_align_init(&align, &config, &gain_tables_drive);
}

static void test_constants_out_of_range_are_refused(void)
{
    uint32_t *const times[] = {&config.watch_ticks, &config.ramp_ticks, &config.sweep_ticks,
                               &config.settle_ticks, &config.still_ticks};
    TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    for (int i = 0; i < SUPPORT_COUNT(times); i++) {
        setUp();
        *times[i] = 0UL;
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
        *times[i] = (times[i] == &config.settle_ticks) ? (config.still_ticks + 1UL) : 1UL;
        TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    }
    setUp();
    config.settle_ticks = config.still_ticks;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.current_A = 2.01f; /* half of 4 A is the most */
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.current_A = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.current_A = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.bandwidth_radps = 501.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.bandwidth_radps = -1.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.theta_e_rad = -0.1f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.theta_e_rad = 4.712389f;
    TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    setUp();
    drive_config_t drive      = speed_tables_drive;
    drive.hardware.pole_pairs = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_align_init(&align, &config, &drive));
    drive.hardware.pole_pairs = 1U;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_align_init(&align, &config, &drive));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_free_shaft_is_found_from_anywhere);
    RUN_TEST(test_a_sensor_that_moves_at_the_end_is_refused);
    RUN_TEST(test_dead_point_is_left_in_the_sweep);
    RUN_TEST(test_load_turns_the_result_by_the_stated_angle);
    RUN_TEST(test_parameters_of_the_motor_may_be_wrong_by_half);
    RUN_TEST(test_three_times_the_inertia_still_comes_to_rest);
    RUN_TEST(test_shaft_that_turns_is_refused_before_the_bridge_closes);
    RUN_TEST(test_bridge_stays_open_while_watching);
    RUN_TEST(test_locked_shaft_fails);
    RUN_TEST(test_encoder_that_counts_backwards_fails);
    RUN_TEST(test_wrong_pole_pairs_fail);
    RUN_TEST(test_shaft_must_rest_at_the_end);
    RUN_TEST(test_voltage_is_limited_when_no_current_flows);
    RUN_TEST(test_current_beyond_the_limit_opens_the_bridge_at_once);
    RUN_TEST(test_second_alignment_forgets_the_first);
    RUN_TEST(test_gains_follow_the_winding);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
