/* SPDX-License-Identifier: MIT */
/* A law that exists here only: what drive_init() and drive_tick() do with any law. */
#include "law.h"

#include <complex.h>

#include "drive_tick.h"
#include "frames.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_V 4.0e-5 /* V worked back from duty ratios, at 295 V; worst 8.0e-6 */

/* Voltage in proportion to the speed error; everything else it answers is said by its constants. */
typedef struct {
    float gain_Vs;
    float d_V;
    float theta_rad;
    float now_e_radps;
    float iq_A;
    float id_A;
    bool  plausible;
} own_config_t;

/* Where its state lies in law_state_t. */
enum { OWN_RESETS, OWN_STEPS, OWN_START_e_radps, OWN_V_D, OWN_V_Q, OWN_COMMAND, OWN_IA };

static own_config_t    own;
static drive_config_t  config;
static drive_t         drive;
static drive_sample_t  sample;
static drive_command_t command;
static int             checks;

static bool own_check(const drive_config_t *c)
{
    const own_config_t *mine = (const own_config_t *)c->constants;

    checks++;
    return base_in_range(mine->gain_Vs, 0.0f, 1.0e6f);
}

static void own_reset(law_state_t *state, const drive_config_t *c, const drive_sample_t *s)
{
    (void)c;
    state->own[OWN_RESETS] += 1.0f;
    state->own[OWN_STEPS]         = 0.0f;
    state->own[OWN_START_e_radps] = s->omega_e_radps;
}

static void own_step(law_state_t *state, const drive_config_t *c, const law_input_t *in,
                     law_output_t *out)
{
    const own_config_t *mine   = (const own_config_t *)c->constants;
    const float         e      = in->command_e_radps - in->sample->omega_e_radps;
    const law_output_t  answer = {
         .v_V       = {.d = mine->d_V, .q = mine->gain_Vs * e},
         .theta_rad = mine->theta_rad,
         .now       = {.omega_e_radps = mine->now_e_radps, .iq_A = mine->iq_A, .id_A = mine->id_A},
         .plausible = mine->plausible};

    state->own[OWN_STEPS] += 1.0f;
    state->own[OWN_V_D]     = in->v_V.d;
    state->own[OWN_V_Q]     = in->v_V.q;
    state->own[OWN_COMMAND] = in->command_e_radps;
    state->own[OWN_IA]      = in->sample->ia_A;
    *out                    = answer;
}

static const law_t law_of_its_own = {.check = own_check, .reset = own_reset, .step = own_step};

void setUp(void)
{
    const own_config_t   constants = {.gain_Vs     = 2.0f,
                                      .d_V         = -10.0f,
                                      .theta_rad   = 0.7f,
                                      .now_e_radps = 300.0f,
                                      .iq_A        = 0.0f,
                                      .id_A        = 0.0f,
                                      .plausible   = true};
    const drive_sample_t at        = {.ia_A          = 0.5f,
                                      .ib_A          = -0.2f,
                                      .dc_link_V     = 295.0f,
                                      .theta_e_rad   = 0.4f,
                                      .omega_e_radps = 300.0f,
                                      .valid         = true};

    own                    = constants;
    sample                 = at;
    command.run            = true;
    command.omega_e_radps  = 320.0f;
    config                 = gain_tables_drive;
    config.overmodulation  = false;
    config.dead_time.share = 0.0f;
    config.law             = &law_of_its_own;
    config.torques         = false;
    config.constants       = &own;
    checks                 = 0;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &config));
    for (int i = 0; i < LAW_OWN_FLOATS; i++) {
        drive.law.own[i] = 0.0f;
    }
}

void tearDown(void) {}

static bridge_t tick(void)
{
    return drive_tick(&drive, &sample, &command);
}

static void assert_tripped(bridge_t out, drive_fault_t reason)
{
    TEST_ASSERT_FALSE(out.gate_enable);
    TEST_ASSERT_TRUE((out.duty.a == 0.5f) && (out.duty.b == 0.5f) && (out.duty.c == 0.5f));
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT, drive.state);
    TEST_ASSERT_EQUAL_INT(reason, drive.fault);
    TEST_ASSERT_TRUE((drive.v_V.d == 0.0f) && (drive.v_V.q == 0.0f));
}

/* The voltage that the duty ratios make, seen from an angle. */
static double complex produced_V(bridge_t out, double theta_rad)
{
    const double complex turn = cexp(support_complex(0.0, 2.0943951023931953));
    const double complex v_V =
        (2.0 / 3.0) * (double)sample.dc_link_V *
        ((double)out.duty.a + ((double)out.duty.b * turn) + ((double)out.duty.c * conj(turn)));
    return v_V * cexp(support_complex(0.0, -theta_rad));
}

static void test_its_constants_are_checked_by_itself_and_once(void)
{
    TEST_ASSERT_EQUAL_INT(1, checks);
    own.gain_Vs = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
    TEST_ASSERT_EQUAL_INT(2, checks);
    TEST_ASSERT_FALSE(tick().gate_enable);
    TEST_ASSERT_TRUE(drive.law.own[OWN_STEPS] == 0.0f);
}

static void test_drive_is_checked_with_any_law(void)
{
    config.motor.l6 = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
    setUp();
    config.dead_time.inv_fade_1pA = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
    setUp();
    config.current_max_A = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
}

static void test_it_is_reset_at_every_start_and_only_then(void)
{
    TEST_ASSERT_TRUE(drive.law.own[OWN_RESETS] == 0.0f);
    for (int n = 1; n <= 5; n++) {
        (void)tick();
        TEST_ASSERT_TRUE(drive.law.own[OWN_RESETS] == 1.0f);
        TEST_ASSERT_TRUE(drive.law.own[OWN_STEPS] == (float)n);
    }
    command.run = false;
    (void)tick();
    TEST_ASSERT_TRUE(drive.law.own[OWN_RESETS] == 1.0f);
    TEST_ASSERT_TRUE(drive.law.own[OWN_STEPS] == 5.0f); /* not asked while it is off */

    command.run          = true;
    sample.omega_e_radps = 250.0f;
    (void)tick();

    TEST_ASSERT_TRUE(drive.law.own[OWN_RESETS] == 2.0f);
    TEST_ASSERT_TRUE(drive.law.own[OWN_STEPS] == 1.0f);
    TEST_ASSERT_TRUE(drive.law.own[OWN_START_e_radps] == 250.0f);
}

static void test_it_gets_this_sample_and_this_command(void)
{
    for (int n = 0; n < 5; n++) {
        sample.ia_A           = 0.1f * (float)n;
        command.omega_e_radps = 300.0f + (float)n;

        (void)tick();

        TEST_ASSERT_TRUE(drive.law.own[OWN_IA] == sample.ia_A);
        TEST_ASSERT_TRUE(drive.law.own[OWN_COMMAND] == command.omega_e_radps);
    }
}

/* Nothing at the start of a run, then what the limits left of its own wish. */
static void test_it_gets_the_limited_voltage_of_the_period_before(void)
{
    own.gain_Vs = 20.0f; /* 400 V, far outside the circle */
    (void)tick();
    TEST_ASSERT_TRUE((drive.law.own[OWN_V_D] == 0.0f) && (drive.law.own[OWN_V_Q] == 0.0f));
    TEST_ASSERT_TRUE(drive.v_limited);

    for (int n = 0; n < 5; n++) {
        const dq_t before_V = drive.v_V;
        (void)tick();
        TEST_ASSERT_TRUE((drive.law.own[OWN_V_D] == before_V.d) &&
                         (drive.law.own[OWN_V_Q] == before_V.q));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 295.0 / sqrt(3.0), support_length(before_V));
        TEST_ASSERT_TRUE(drive.answer.v_V.q == 400.0f);
    }

    command.run = false;
    (void)tick();
    command.run = true;
    (void)tick();
    TEST_ASSERT_TRUE((drive.law.own[OWN_V_D] == 0.0f) && (drive.law.own[OWN_V_Q] == 0.0f));
}

static void test_its_answer_is_modulated_at_its_angle(void)
{
    const bridge_t       out = tick();
    const double complex v_V = produced_V(out, 0.7);

    TEST_ASSERT_TRUE(out.gate_enable && !drive.v_limited);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, -10.0, creal(v_V));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 40.0, cimag(v_V));
    TEST_ASSERT_TRUE((drive.v_V.d == -10.0f) && (drive.v_V.q == 40.0f));
}

static void test_its_answer_is_limited(void)
{
    for (int hexagon = 0; hexagon < 2; hexagon++) {
        setUp();
        own.gain_Vs           = 20.0f;
        config.overmodulation = (hexagon != 0);

        const double complex v_V = produced_V(tick(), 0.7);

        TEST_ASSERT_TRUE(drive.v_limited);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)drive.v_V.d, creal(v_V));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)drive.v_V.q, cimag(v_V));
        TEST_ASSERT_TRUE(cabs(v_V) < 2.0 / 3.0 * 295.0);
    }
}

/* Currents of the answer decide the sign of the compensation, not those of the sample. */
static void test_dead_time_goes_by_the_currents_of_its_answer(void)
{
    const bridge_t plain = tick();
    own.iq_A             = -2.0f;
    own.id_A             = 1.0f;
    config.dead_time     = gain_tables_drive.dead_time;

    const bridge_t       out       = tick();
    const double complex i_A       = support_complex(1.0, -2.0) * cexp(support_complex(0.0, 0.7));
    const double         share     = (double)config.dead_time.share;
    const double         fade      = (double)config.dead_time.inv_fade_1pA;
    const float *const   with[]    = {&out.duty.a, &out.duty.b, &out.duty.c};
    const float *const   without[] = {&plain.duty.a, &plain.duty.b, &plain.duty.c};
    for (int x = 0; x < 3; x++) {
        const double i_x_A = creal(i_A * cexp(support_complex(0.0, -2.0943951023931953 * x)));
        const double added = share * support_limit(i_x_A * fade, -1.0, 1.0);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, added, (double)*with[x] - (double)*without[x]);
    }
}

static void test_answer_of_an_angle_that_cannot_be_right_trips(void)
{
    (void)tick();
    own.plausible   = false;
    own.now_e_radps = NAN; /* the angle is the reason for everything else */
    own.d_V         = NAN;

    assert_tripped(tick(), DRIVE_FAULT_ENCODER);
}

static void test_answer_that_is_not_finite_trips(void)
{
    for (int i = 0; i < 2 * SUPPORT_COUNT(support_not_finite); i++) {
        setUp();
        (void)tick();
        *((i % 2 == 0) ? &own.d_V : &own.gain_Vs) = support_not_finite[i / 2];

        assert_tripped(tick(), DRIVE_FAULT_NUMERIC);
    }
}

/* Below it no square overflows in the voltage limit. */
static void test_answer_beyond_any_voltage_trips(void)
{
    for (int i = 0; i < 4; i++) {
        const float sign = (i % 2 == 0) ? 1.0f : -1.0f;
        setUp();
        (void)tick();
        own.d_V               = (i < 2) ? (sign * nextafterf(1.0e9f, INFINITY)) : 0.0f;
        own.gain_Vs           = (i < 2) ? 0.0f : nextafterf(1.0e9f, INFINITY);
        command.omega_e_radps = 300.0f + sign;

        assert_tripped(tick(), DRIVE_FAULT_NUMERIC);
    }
    for (int i = 0; i < 3; i++) { /* the sum of both counts */
        setUp();
        (void)tick();
        own.d_V               = (i == 1) ? 0.0f : 0.5e9f * (1.0f + (float)(i == 0));
        own.gain_Vs           = (i == 0) ? 0.0f : 0.5e9f * (1.0f + (float)(i == 1));
        command.omega_e_radps = 299.0f;

        TEST_ASSERT_TRUE(tick().gate_enable && drive.v_limited);
    }
    setUp();
    (void)tick();
    own.d_V               = 0.5e9f;
    own.gain_Vs           = 0.50001e9f;
    command.omega_e_radps = 299.0f;

    assert_tripped(tick(), DRIVE_FAULT_NUMERIC);
}

/* The speed in the law's answer trips, although the measured speed is in range. */
static void test_speed_of_its_answer_beyond_the_trip_level_trips(void)
{
    const float trip     = config.trip_speed_e_radps;
    const float beyond[] = {nextafterf(trip, INFINITY), -nextafterf(trip, INFINITY), NAN};

    for (int i = 0; i < SUPPORT_COUNT(beyond); i++) {
        setUp();
        (void)tick();
        own.now_e_radps = beyond[i];
        own.d_V         = NAN; /* the speed comes first */

        assert_tripped(tick(), DRIVE_FAULT_OVER_SPEED);
    }
    for (int side = -1; side <= 1; side += 2) {
        setUp();
        own.now_e_radps = (float)side * trip;
        TEST_ASSERT_TRUE(tick().gate_enable);
    }
}

static void test_it_is_not_asked_with_a_sample_that_trips(void)
{
    (void)tick();
    sample.valid = false;

    assert_tripped(tick(), DRIVE_FAULT_SAMPLE);
    TEST_ASSERT_TRUE(drive.law.own[OWN_STEPS] == 1.0f);
    (void)tick();
    TEST_ASSERT_TRUE(drive.law.own[OWN_STEPS] == 1.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_its_constants_are_checked_by_itself_and_once);
    RUN_TEST(test_drive_is_checked_with_any_law);
    RUN_TEST(test_it_is_reset_at_every_start_and_only_then);
    RUN_TEST(test_it_gets_this_sample_and_this_command);
    RUN_TEST(test_it_gets_the_limited_voltage_of_the_period_before);
    RUN_TEST(test_its_answer_is_modulated_at_its_angle);
    RUN_TEST(test_its_answer_is_limited);
    RUN_TEST(test_dead_time_goes_by_the_currents_of_its_answer);
    RUN_TEST(test_answer_of_an_angle_that_cannot_be_right_trips);
    RUN_TEST(test_answer_that_is_not_finite_trips);
    RUN_TEST(test_answer_beyond_any_voltage_trips);
    RUN_TEST(test_speed_of_its_answer_beyond_the_trip_level_trips);
    RUN_TEST(test_it_is_not_asked_with_a_sample_that_trips);
    return UNITY_END();
}
