/* SPDX-License-Identifier: MIT */
#include "app_trim.h"

#include <complex.h>
#include <string.h>

#include "app_registers.h"
#include "board_config.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define PI     3.14159265358979324
#define TS_s   2.0e-4
#define STEPS  4 /* of the oracle in a control period */
#define MOST_A 0.4
#define J      support_complex(0.0, 1.0)

static app_trim_t        trim;
static app_trim_config_t config;
static motor_reduced_t   motor;
static uint32_t          ticks;
static support_random_t  random_state;

void setUp(void)
{
    const app_trim_config_t c = {.motor         = &motor,
                                 .ts_s          = (float)TS_s,
                                 .current_max_A = 4.0f,
                                 .offset_most_A = (float)MOST_A};
    config                    = c;
    motor                     = gain_tables_drive.motor;
    ticks                     = 4294965000u; /* wraps within a second */
    random_state.state        = 5u;
    app_trim_reset(&trim);
}

void tearDown(void) {}

/* Oracle: a motor whose measured currents are held, apart from a ripple of the controller's. */
typedef struct {
    double         offset_a_A, offset_b_A, gain_a, gain_b;
    double         omega_e_radps;
    double complex i_A; /* measured, mean */
    double complex
           swing_A;       /* of a measured current that swings with exp(j theta) + exp(2j theta) */
    double more_Nm_share; /* load that swings with theta and 2 theta, of the torque's l1 i_q */
    double complex turning_V;   /* inverter: offset, turns with exp(-j theta) */
    double         phase_ratio; /* share of R i that turns with exp(-2j theta): unequal phases */
    double         inductance;  /* true over believed */
    double         saliency;    /* true L_q - L_d over believed, the mean as it is */
    double         inertia;     /* true over believed */
    double         angle_rad;   /* encoder, amplitude of an error with theta */
    double         step_A;      /* of the measured i_q, at 0.1 s */
    uint32_t       each;        /* ticks between two passes */
} machine_t;

static machine_t healthy(void)
{
    const machine_t m = {.omega_e_radps = 300.0,
                         .i_A           = -0.3 + 1.25 * J,
                         .inductance    = 1.0,
                         .saliency      = 1.0,
                         .inertia       = 1.0,
                         .each          = 1u};
    return m;
}

static double complex turn(double angle_rad)
{
    return cos(angle_rad) + J * sin(angle_rad);
}

/* Error of the trimmed sensors, in the stator's frame, of a true current there: i_c = -i_a - i_b. */
static double complex error_of(const machine_t *x, double complex s_A)
{
    const double g  = (double)trim.values.gain;
    const double a  = creal(s_A);
    const double b  = 0.5 * (sqrt(3.0) * cimag(s_A) - creal(s_A));
    const double ka = 1.0 + fmax(-g, 0.0);
    const double kb = 1.0 + fmax(g, 0.0);
    const double ea = ka * ((1.0 + x->gain_a) * a + x->offset_a_A - (double)trim.values.a_A) - a;
    const double eb = kb * ((1.0 + x->gain_b) * b + x->offset_b_A - (double)trim.values.b_A) - b;
    return ea + J * (ea + 2.0 * eb) / sqrt(3.0);
}

typedef struct {
    double theta_rad, w_radps, time_s;
} at_t;

static double complex measured_A(const machine_t *x, const at_t *at)
{
    const double complex step = (at->time_s > 0.1) ? J * x->step_A : 0.0;
    return x->i_A + step + x->swing_A * (turn(at->theta_rad) + turn(2.0 * at->theta_rad));
}

/* The current that is measured so; the error depends on it, so it is found by repetition. */
static double complex true_A(const machine_t *x, const at_t *at)
{
    const double complex to_stator = turn(at->theta_rad);
    double complex       i_A       = measured_A(x, at);
    for (int k = 0; k < 4; k++) {
        i_A = measured_A(x, at) - error_of(x, i_A * to_stator) / to_stator;
    }
    return i_A;
}

static double complex flux_Wb(const machine_t *x, double complex i_A)
{
    const support_motor_t m    = support_motor(&motor);
    const double          mean = 0.5 * (m.ld_H + m.lq_H) * x->inductance;
    const double          half = 0.5 * (m.lq_H - m.ld_H) * x->saliency * x->inductance;
    return (mean - half) * creal(i_A) + J * (mean + half) * cimag(i_A);
}

static double complex voltage_V(const machine_t *x, const at_t *at, double speed_radps2)
{
    const support_motor_t m   = support_motor(&motor);
    const double          h_s = 1.0e-6;
    at_t                  to  = *at;
    to.theta_rad += h_s * (at->w_radps + 0.5 * h_s * speed_radps2);
    const double complex i_A  = true_A(x, at);
    const double complex rise = (flux_Wb(x, true_A(x, &to)) - flux_Wb(x, i_A)) / h_s;
    return m.rs_Ohm * (i_A + x->phase_ratio * conj(i_A) * turn(-2.0 * at->theta_rad)) + rise +
           J * at->w_radps * (flux_Wb(x, i_A) + m.flux_Wb) + x->turning_V * turn(-at->theta_rad);
}

/* The true current makes the torque, EQ-MOTOR-1. */
static double torque_radps2(const machine_t *x, const at_t *at)
{
    const double complex i_A = true_A(x, at);
    return cimag(i_A) * ((double)motor.l1 + (double)motor.l11 * creal(i_A));
}

/* Its mean over a turn, which the load balances. */
static double mean_radps2(const machine_t *x, at_t at)
{
    const int n   = 32;
    double    sum = 0.0;
    for (int k = 0; k < n; k++) {
        at.theta_rad = 2.0 * PI * k / n;
        sum += torque_radps2(x, &at);
    }
    return sum / n;
}

/* The load brakes a speed that is too large, so slowly that it takes no part in the swing. */
static double acceleration_radps2(const machine_t *x, const at_t *at, double mean)
{
    const double swing = x->more_Nm_share * mean * (cos(at->theta_rad) + cos(2.0 * at->theta_rad));
    return ((torque_radps2(x, at) - mean) + swing) / x->inertia -
           5.0 * (at->w_radps - x->omega_e_radps);
}

/* Lets the machine run; trims as it learns. The noise is that of a converter. */
static void run(const machine_t *x, double time_s)
{
    at_t at = {.theta_rad = 0.0, .w_radps = x->omega_e_radps, .time_s = 0.0};
    for (uint32_t k = 0u; (double)k * TS_s < time_s; k++) {
        const double         mean   = mean_radps2(x, at);
        const double complex i_A    = true_A(x, &at);
        const double         offset = x->angle_rad * cos(at.theta_rad);
        const double complex s_A =
            (i_A * turn(at.theta_rad)) + error_of(x, i_A * turn(at.theta_rad));
        at_t late = at;
        late.theta_rad += 1.5 * TS_s * at.w_radps;
        late.time_s += 1.5 * TS_s;
        const double complex v_V = voltage_V(x, &late, acceleration_radps2(x, &late, mean)) *
                                   turn(-x->angle_rad * cos(late.theta_rad));
        const double          noise = 0.005;
        const app_trim_seen_t seen  = {
             .ticks         = ticks,
             .runs          = true,
             .theta_e_rad   = (float)fmod(at.theta_rad + offset + 4000.0 * PI, 2.0 * PI),
             .omega_e_radps = (float)(at.w_radps - x->angle_rad * at.w_radps * sin(at.theta_rad)),
             .ia_A =
                 (float)(creal(s_A) + noise * (double)support_uniform(&random_state, -1.0f, 1.0f)),
             .ib_A = (float)(0.5 * (sqrt(3.0) * cimag(s_A) - creal(s_A)) +
                            noise * (double)support_uniform(&random_state, -1.0f, 1.0f)),
             .v_V  = {(float)creal(v_V), (float)cimag(v_V)}};
        if ((k % x->each) == 0u) {
            (void)app_trim_see(&trim, &seen, &config);
        }
        for (int n = 0; n < STEPS; n++) {
            const double d_s = TS_s / STEPS;
            const double a   = acceleration_radps2(x, &at, mean);
            at.theta_rad += d_s * (at.w_radps + 0.5 * d_s * a);
            at.w_radps += d_s * a;
        }
        at.time_s += TS_s;
        ticks++;
    }
}

static void learned(double a_A, double b_A, double gain, double tol_A, double tol_gain)
{
    TEST_ASSERT_DOUBLE_WITHIN(tol_A, a_A, (double)trim.values.a_A);
    TEST_ASSERT_DOUBLE_WITHIN(tol_A, b_A, (double)trim.values.b_A);
    TEST_ASSERT_DOUBLE_WITHIN(tol_gain, gain, (double)trim.values.gain);
    TEST_ASSERT_FALSE(trim.ended);
}

static void learned_nothing(void)
{
    learned(0.0, 0.0, 0.0, 1.0e-12, 1.0e-12);
    TEST_ASSERT_EQUAL_UINT16(0u, trim.blocks);
}

/* The slow ones have a heavy shaft: nothing controls the speed here. The worst is 0.9 mA and 0.0008 off. */
static void test_offsets_and_gains_are_learned_at_every_speed_load_and_way(void)
{
    static const double speeds[] = {70.0, 100.0, 300.0, 500.0, -300.0, 1000.0};
    static const double q_A[]    = {0.5, 1.25, -2.5, 3.9};
    for (int k = 0; k < SUPPORT_COUNT(speeds); k++) {
        for (int n = 0; n < SUPPORT_COUNT(q_A); n++) {
            machine_t x     = healthy();
            x.omega_e_radps = speeds[k];
            x.i_A           = -0.3 + q_A[n] * J;
            x.offset_a_A    = 0.05;
            x.offset_b_A    = -0.08;
            x.gain_a        = -0.01;
            x.gain_b        = 0.015;
            x.each          = 1u + (uint32_t)(n % 2);
            if (fabs(speeds[k]) < 200.0) {
                x.inertia = 10.0;
            } else {
                x.swing_A = 0.004 + 0.003 * J;
            }
            setUp();
            run(&x, 10.0);
            learned(0.05, -0.08, -0.025, 0.0015, 0.0015);
        }
    }
}

static void test_each_error_is_learned_alone(void)
{
    for (int k = 0; k < 4; k++) {
        machine_t x  = healthy();
        x.offset_a_A = (k == 0) ? 0.05 : 0.0;
        x.offset_b_A = (k == 1) ? 0.05 : 0.0;
        x.gain_a     = (k == 2) ? 0.02 : 0.0;
        x.gain_b     = (k == 3) ? 0.02 : 0.0;
        setUp();
        run(&x, 8.0);
        learned(x.offset_a_A, x.offset_b_A, x.gain_a - x.gain_b, 0.001, 0.001);
    }
}

/* Blocks of 12 turns, 0.2513 s, each with a quarter: 1 - 0.75^4 after four. The worst is
 * 7 % less, and 1.9 mA beside. */
static void test_the_time_constant_is_a_second(void)
{
    const double share = 1.0 - pow(0.75, 4.0);
    for (int k = 0; k < 3; k++) {
        machine_t x  = healthy();
        x.i_A        = -1.0 + 1.25 * J;
        x.offset_a_A = (k == 0) ? 0.05 : 0.0;
        x.offset_b_A = (k == 1) ? 0.05 : 0.0;
        x.gain_a     = (k == 2) ? 0.04 : 0.0;
        setUp();
        run(&x, 4.0 * 0.2513 + 0.03);
        TEST_ASSERT_EQUAL_UINT16(4u, trim.blocks);
        learned(share * x.offset_a_A, share * x.offset_b_A, share * x.gain_a, 0.0025, 0.0020);
    }
}

static void test_the_motor_and_the_inverter_are_not_blamed(void)
{
    machine_t x   = healthy();
    x.phase_ratio = 0.2;
    run(&x, 8.0);
    learned(0.0, 0.0, 0.0, 0.001, 0.001);
    setUp();
    x           = healthy();
    x.turning_V = 2.0 - 1.0 * J;
    run(&x, 8.0);
    learned(0.0, 0.0, 0.0, 0.001, 0.001);
    setUp();
    x               = healthy();
    x.more_Nm_share = 0.2;
    run(&x, 8.0);
    learned(0.0, 0.0, 0.0, 0.001, 0.001);
    setUp();
    x         = healthy();
    x.swing_A = 0.05;
    run(&x, 8.0);
    learned(0.0, 0.0, 0.0, 0.001, 0.001);
}

static void test_other_motors_are_learned_too(void)
{
    static const double saliency[] = {0.5, 2.0};
    static const double inertia[]  = {0.5, 3.0};
    for (int k = 0; k < 2; k++) {
        machine_t x  = healthy();
        x.offset_a_A = 0.05;
        x.gain_b     = 0.02;
        x.saliency   = saliency[k];
        x.inertia    = inertia[k];
        setUp();
        run(&x, 16.0);
        learned(0.05, 0.0, -0.02, 0.002, 0.002);
    }
}

/* With L_q < L_d the voltage says the opposite of the torque. */
static void test_a_motor_with_the_other_saliency_teaches_nothing(void)
{
    machine_t x  = healthy();
    x.offset_a_A = 0.05;
    x.gain_b     = 0.02;
    x.saliency   = -1.0;
    run(&x, 4.0);
    learned_nothing();
}

/* 1 mrad at each electrical turn: 2 flux D / (L_q - L_d) = 9.9 mA. */
static void test_an_error_of_the_encoder_reads_as_said(void)
{
    machine_t x             = healthy();
    x.angle_rad             = 0.001;
    x.gain_b                = 0.0;
    const support_motor_t m = support_motor(&motor);
    run(&x, 8.0);
    const double most_A = 2.0 * m.flux_Wb * x.angle_rad / (m.lq_H - m.ld_H);
    TEST_ASSERT_TRUE(hypot((double)trim.values.a_A, (double)trim.values.b_A) < 1.16 * most_A);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.0, (double)trim.values.gain);
}

static void test_without_excitation_it_learns_nothing(void)
{
    machine_t x  = healthy();
    x.offset_a_A = 0.05;
    x.gain_b     = 0.02;

    machine_t slow     = x;
    slow.omega_e_radps = 60.0; /* R / (L_q - L_d) is 63.7 rad/s */
    run(&slow, 3.0);
    learned_nothing();

    machine_t idle = x;
    idle.i_A       = 0.38 * J;
    run(&idle, 3.0);
    learned_nothing();

    machine_t fast     = x;
    fast.omega_e_radps = 1550.0; /* 0.31 rad in a period */
    run(&fast, 3.0);
    learned_nothing();

    machine_t rare = x;
    rare.each      = 26u; /* 1.56 rad */
    run(&rare, 3.0);
    learned_nothing();

    motor.l8     = motor.l6 * 1.2f; /* L_q - L_d = 0.09 (L_q + L_d) */
    motor.inv_l8 = 1.0f / motor.l8;
    motor.l7     = motor.l4 * 1.2f;
    run(&x, 3.0);
    learned_nothing();
}

static void test_steps_drop_the_block(void)
{
    machine_t x  = healthy();
    x.offset_a_A = 0.05;
    x.step_A     = 1.1;
    run(&x, 0.3);
    learned_nothing(); /* a small step would have taught after 0.25 s */
    setUp();
    x.step_A = 0.0;
    run(&x, 0.3);
    TEST_ASSERT_EQUAL_UINT16(1u, trim.blocks);
    setUp();
    run(&x, 0.15);
    x.omega_e_radps = 318.0; /* 0.06 more */
    run(&x, 0.2);
    learned_nothing();
}

static app_trim_seen_t at_rest(void)
{
    const app_trim_seen_t seen = {.ticks = ticks, .runs = false};
    return seen;
}

static void test_the_end_of_a_run_freezes_the_values(void)
{
    machine_t x  = healthy();
    x.offset_a_A = 0.05;
    run(&x, 3.0);
    const app_trim_values_t before = trim.values;
    for (int k = 0; k < 5000; k++) {
        const app_trim_seen_t seen = at_rest();
        TEST_ASSERT_FALSE(app_trim_see(&trim, &seen, &config));
        ticks++;
    }
    TEST_ASSERT_EQUAL_MEMORY(&before, &trim.values, sizeof before);
    run(&x, 3.0);
    learned(0.05, 0.0, 0.0, 0.002, 0.001);
}

static void test_a_bound_ends_it(void)
{
    machine_t x  = healthy();
    x.offset_a_A = MOST_A * 1.05;
    run(&x, 6.0);
    TEST_ASSERT_TRUE(trim.ended);
    TEST_ASSERT_TRUE((trim.values.a_A == 0.0f) && (trim.values.b_A == 0.0f) &&
                     (trim.values.gain == 0.0f));
    app_trim_zeroed(&trim);
    TEST_ASSERT_FALSE(trim.ended);
    x.offset_a_A = 0.0;
    x.gain_a     = 0.056;
    run(&x, 8.0);
    TEST_ASSERT_TRUE(trim.ended);
    app_trim_reset(&trim);
    x.gain_a     = 0.0;
    x.offset_b_A = -1.05 * MOST_A;
    run(&x, 8.0);
    TEST_ASSERT_TRUE(trim.ended);
    app_trim_reset(&trim);
    x.gain_a     = 0.045;
    x.offset_b_A = 0.95 * MOST_A;
    run(&x, 8.0);
    learned(0.0, x.offset_b_A, 0.045, 0.01, 0.003);
}

static void test_values_that_are_no_numbers_teach_nothing(void)
{
    machine_t x  = healthy();
    x.offset_a_A = 0.05;
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        const float     bad  = support_not_finite[k];
        app_trim_seen_t seen = {
            .ticks = ticks, .runs = true, .omega_e_radps = 300.0f, .ib_A = 1.0f};
        run(&x, 0.1);
        for (int n = 0; n < 4; n++) {
            app_trim_seen_t one = seen;
            one.ticks           = ticks++;
            one.omega_e_radps   = (n == 0) ? bad : one.omega_e_radps;
            one.ia_A            = (n == 1) ? bad : 0.0f;
            one.v_V.q           = (n == 2) ? bad : 0.0f;
            one.v_V.d           = (n == 3) ? bad : 0.0f;
            (void)app_trim_see(&trim, &one, &config);
        }
        run(&x, 0.25);
        TEST_ASSERT_TRUE(base_within(trim.values.a_A, 0.05f) &&
                         base_within(trim.values.b_A, 0.05f));
    }
}

static void test_the_count_stays_at_its_largest(void)
{
    machine_t x  = healthy();
    x.offset_a_A = 0.05;
    trim.blocks  = 65534u;
    run(&x, 1.0);
    TEST_ASSERT_EQUAL_UINT16(65535u, trim.blocks);
}

/* The application trims the readings with it. */

static app_registers_t registers;
static app_scale_t     scale;

static void set_up_registers(void)
{
    static app_config_t c;
    c = board_config;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_registers_init(&registers, &c, &gain_tables_drive));
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_scale_init(&scale, &c.scale, c.board.positions,
                                                 gain_tables_drive.trip_current_A));
    registers.status.mode = APP_MODE_RUN;
}

static void see(float a_A, float b_A, float gain)
{
    const app_trim_values_t v = {a_A, b_A, gain};
    registers.trim.values     = v;
    registers.status.ticks++;
    app_registers_see_trim(&registers, &scale);
}

static void scaled_by(double a_cnt, double b_cnt, double ka, double kb)
{
    const double per = (double)board_config.scale.current_A_per_cnt;
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 2048.0 + a_cnt, (double)scale.zero_a_cnt);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 2048.0 + b_cnt, (double)scale.zero_b_cnt);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-9, per * ka, (double)scale.a_A_per_cnt);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-9, per * kb, (double)scale.b_A_per_cnt);
}

static void test_the_values_act_on_the_zeros_and_raise_the_smaller_gain(void)
{
    const double per = (double)board_config.scale.current_A_per_cnt;
    set_up_registers();
    see(0.0f, 0.0f, 0.0f);
    scaled_by(0.0, 0.0, 1.0, 1.0);
    see(0.05f, -0.02f, 0.02f);
    scaled_by(0.05 / per, -0.02 / per, 1.0, 1.02);
    see(0.04f, -0.03f, -0.01f);
    scaled_by(0.04 / per, -0.03 / per, 1.01, 1.0);
    TEST_ASSERT_TRUE(app_registers_trimmed(&registers).a_A == 0.04f);
    see(0.04f, -0.03f, -0.01f); /* nothing new */
    scaled_by(0.04 / per, -0.03 / per, 1.01, 1.0);
}

static void test_zero_in_the_register_takes_it_back(void)
{
    uint16_t off = 0u;
    set_up_registers();
    TEST_ASSERT_EQUAL_UINT16(1u, app_registers_trim_on(&registers));
    see(0.05f, -0.02f, 0.02f);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_write(&registers, APP_REGISTERS_SENSOR_TRIM, 1u, &off));
    see(0.06f, -0.02f, 0.02f);
    scaled_by(0.0, 0.0, 1.0, 1.0);
    TEST_ASSERT_EQUAL_UINT16(0u, app_registers_trim_on(&registers));
}

/* The tick sets the zeros; the gains stay. */
static void test_measured_zeros_replace_the_learned_ones(void)
{
    set_up_registers();
    see(0.05f, -0.02f, 0.02f);
    registers.status.mode = APP_MODE_CALIBRATE;
    TEST_ASSERT_TRUE(app_scale_set_zero(&scale, 2050u, 2046u, 1u));
    app_registers_see_trim(&registers, &scale);
    registers.status.mode = APP_MODE_READY;
    app_registers_see_trim(&registers, &scale);
    scaled_by(2.0, -2.0, 1.0, 1.02);
}

static void test_zeros_too_far_from_the_nominal_ones_end_it(void)
{
    set_up_registers();
    TEST_ASSERT_TRUE(app_scale_set_zero(&scale, 2048u + 60u, 2048u, 1u));
    see(0.1f, 0.0f, 0.02f);
    scaled_by(60.0 + 0.1 / (double)board_config.scale.current_A_per_cnt, 0.0, 1.0, 1.02);
    see(0.3f, 0.0f, 0.02f); /* 121 codes; 100 are accepted */
    scaled_by(60.0, 0.0, 1.0, 1.0);
    TEST_ASSERT_TRUE(registers.trim.ended);
    TEST_ASSERT_TRUE(app_registers_trimmed(&registers).a_A == 0.0f);
}

/* The machine above, by the status and the scale of the application. */
static void test_only_a_run_with_its_encoder_and_its_voltage_teaches(void)
{
    for (int k = 0; k < 4; k++) {
        set_up_registers();
        app_status_t *s    = &registers.status;
        s->mode            = (k == 1) ? APP_MODE_STOP : APP_MODE_RUN;
        s->without_angle   = k == 2;
        s->voltage_limited = k == 3;
        for (uint32_t n = 1u; n < 3000u; n++) {
            const double theta = fmod(0.06 * n, 2.0 * PI);
            s->ticks           = n;
            s->theta_e_rad     = (float)theta;
            s->speed_e_radps   = 300.0f;
            s->ia_A            = (float)(1.2 * cos(theta));
            s->ib_A            = (float)(1.2 * cos(theta - 2.0 * PI / 3.0));
            s->v_V.q           = (float)(70.0 - 1.0 * cos(theta)); /* with a_1 = 0 it is no error */
            app_registers_see_trim(&registers, &scale);
        }
        TEST_ASSERT_EQUAL_INT(k == 0, registers.trim.begun);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_offsets_and_gains_are_learned_at_every_speed_load_and_way);
    RUN_TEST(test_each_error_is_learned_alone);
    RUN_TEST(test_the_time_constant_is_a_second);
    RUN_TEST(test_the_motor_and_the_inverter_are_not_blamed);
    RUN_TEST(test_other_motors_are_learned_too);
    RUN_TEST(test_a_motor_with_the_other_saliency_teaches_nothing);
    RUN_TEST(test_an_error_of_the_encoder_reads_as_said);
    RUN_TEST(test_without_excitation_it_learns_nothing);
    RUN_TEST(test_steps_drop_the_block);
    RUN_TEST(test_the_end_of_a_run_freezes_the_values);
    RUN_TEST(test_a_bound_ends_it);
    RUN_TEST(test_values_that_are_no_numbers_teach_nothing);
    RUN_TEST(test_the_count_stays_at_its_largest);
    RUN_TEST(test_the_values_act_on_the_zeros_and_raise_the_smaller_gain);
    RUN_TEST(test_zero_in_the_register_takes_it_back);
    RUN_TEST(test_measured_zeros_replace_the_learned_ones);
    RUN_TEST(test_zeros_too_far_from_the_nominal_ones_end_it);
    RUN_TEST(test_only_a_run_with_its_encoder_and_its_voltage_teaches);
    return UNITY_END();
}
