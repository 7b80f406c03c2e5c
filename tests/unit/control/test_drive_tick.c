/* SPDX-License-Identifier: MIT */
#include "drive_tick.h"

#include <string.h>

#include "current_clamp.h"
#include "dead_time.h"
#include "feedforward.h"
#include "frames.h"
#include "gain_tables.h"
#include "harmonic_tables.h"
#include "law_constants.h"
#include "speed_tables.h"
#include "svpwm.h"
#include "unit_support.h"
#include "unity.h"
#include "voltage.h"

#define TOL_V          3.0e-3 /* V, up to 1 kV before the limit; worst 5.7e-4 */
#define TOL_DUTY_V     4.0e-4 /* V worked back from duty ratios; worst 7.4e-5 */
#define TOL_REACH      1.0e-6 /* relative overshoot of the voltage hexagon; worst 2.0e-7 */
#define TOL_A          1.5e-7 /* A, currents up to 0.5 A; worst 3.0e-8 */
#define TOL_RADPS      1.0e-4 /* rad/s, settled speed; worst 1.7e-5 */
#define TOL_TORQUE     6.5e-4 /* N m, load found by the observer; worst 1.3e-4 */
#define TOL_MEAN_RADPS 2.0e-2 /* rad/s, mean settled speed with counts of an encoder */
#define TOL_FAST_RADPS                                                                             \
    9.0e-1 /* rad/s, the same where the voltage limit clips the noise on one side; worst 0.70 */
#define TOL_NOISE_RADPS 1.5e0  /* rad/s, largest distance of the settled speed */
#define TOL_LOAD        5.0e-3 /* N m, mean load found by the observer */
#define TOL_START_V     3.0e-5 /* V, back-EMF up to 116 V; worst 6.1e-6 */
#define TOL_ROTATE_V    8.0e-5 /* V, the same operating point at another angle; worst 1.6e-5 */

#define V_DC_V 295.0f

static const double third_turn = 2.0943951023931953; /* rad */

static support_random_t random_state;
static drive_config_t   config;
static test_constants_t constants; /* of config */
static drive_t          drive;
static drive_sample_t   sample;
static drive_command_t  command;
static double           walk_radps; /* speed of draw_inputs() */

/* The state of each law that is tested here, and what it shares with the others. */
static law_noc_speed_state_t *const speed_form    = &drive.law.noc_speed;
static law_noc_state_t *const       encoder_form  = &drive.law.noc;
static law_noc_h_state_t *const     harmonic_form = &drive.law.noc_h;
static near_optimal_t *const        references    = &drive.law.noc_speed.near_optimal;

/* Phase currents of a rotor-frame vector, by projection on the phase axes. */
static drive_sample_t sample_at(double id_A, double iq_A, double theta_rad, double omega_e_radps)
{
    const double complex i_A = support_complex(id_A, iq_A) * cexp(support_complex(0.0, theta_rad));
    const drive_sample_t s   = {.ia_A = (float)creal(i_A),
                                .ib_A = (float)creal(i_A * cexp(support_complex(0.0, -third_turn))),
                                .dc_link_V     = V_DC_V,
                                .theta_e_rad   = (float)theta_rad,
                                .omega_e_radps = (float)omega_e_radps,
                                .valid         = true};
    return s;
}

static const drive_config_t *base = &speed_tables_drive;

/* The realised voltage is worked back from the duties, so the dead time is left out unless a test asks. */
static void start_over(void)
{
    random_state.state     = 23u;
    walk_radps             = 300.0;
    config                 = law_constants_copy(&constants, base);
    config.dead_time.share = 0.0f;
    sample                 = sample_at(-0.1, 0.5, 1.0, 300.0);
    command.omega_e_radps  = 302.0f;
    command.run            = true;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &config));
}

void setUp(void)
{
    base = &speed_tables_drive;
    start_over();
}

static void use_encoder_form(void)
{
    base = &gain_tables_drive;
    start_over();
}

void tearDown(void) {}

static bridge_t tick(void)
{
    return drive_tick(&drive, &sample, &command);
}

static void assert_open(bridge_t out)
{
    TEST_ASSERT_FALSE(out.gate_enable);
    TEST_ASSERT_TRUE((out.duty.a == 0.5f) && (out.duty.b == 0.5f) && (out.duty.c == 0.5f));
}

static void assert_same_output(bridge_t expected, bridge_t actual)
{
    TEST_ASSERT_TRUE(actual.gate_enable == expected.gate_enable);
    TEST_ASSERT_TRUE((actual.duty.a == expected.duty.a) && (actual.duty.b == expected.duty.b) &&
                     (actual.duty.c == expected.duty.c));
}

/* Samples and commands anywhere in their accepted ranges, except that the speed is a random walk: no motor
 * jumps by 1500 rad/s within one period. */
static void draw_inputs(void)
{
    const double angle    = (double)support_uniform(&random_state, -6.28f, 6.28f);
    const double i_A      = (double)support_uniform(&random_state, 0.0f, 7.9f);
    const double at       = (double)support_uniform(&random_state, -3.14f, 3.14f);
    const double step     = (double)support_uniform(&random_state, -20.0f, 20.0f);
    walk_radps            = support_limit(walk_radps + step, -1560.0, 1560.0);
    sample                = sample_at(i_A * cos(at), i_A * sin(at), angle, walk_radps);
    sample.dc_link_V      = support_uniform(&random_state, 88.5f, 398.25f);
    command.omega_e_radps = support_uniform(&random_state, -1191.3f, 1191.3f);
}

/* Samples a motor would give: near 300 rad/s, errors within the linear range of the voltage. */
static void draw_calm_inputs(void)
{
    const double angle = (double)support_uniform(&random_state, -6.28f, 6.28f);
    const double id_A  = (double)support_uniform(&random_state, -0.3f, 0.0f);
    const double iq_A  = (double)support_uniform(&random_state, 0.4f, 0.7f);
    const double w     = (double)support_uniform(&random_state, 299.9f, 300.1f);
    sample             = sample_at(id_A, iq_A, angle, w);
    command.omega_e_radps =
        300.0f; /* a new command would use the jerk, and with it all the voltage */
}

static void test_drive_starts_off_without_fault(void)
{
    TEST_ASSERT_EQUAL_INT(DRIVE_OFF, drive.state);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, drive.fault);
}

static void test_drive_that_is_not_asked_to_run_keeps_the_bridge_open(void)
{
    command.run = false;

    for (int n = 0; n < 10; n++) {
        assert_open(tick());
    }

    TEST_ASSERT_EQUAL_INT(DRIVE_OFF, drive.state);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, drive.fault);
}

static void test_run_command_closes_the_bridge_in_the_same_call(void)
{
    const bridge_t out = tick();

    TEST_ASSERT_TRUE(out.gate_enable);
    TEST_ASSERT_EQUAL_INT(DRIVE_RUN, drive.state);
}

static void test_withdrawn_run_command_opens_the_bridge_in_the_same_call(void)
{
    (void)tick();
    command.run = false;

    assert_open(tick());

    TEST_ASSERT_EQUAL_INT(DRIVE_OFF, drive.state);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, drive.fault);
}

static void test_bad_configuration_leaves_the_drive_unusable(void)
{
    config.motor.l5 = NAN;

    const ctl_status_t status = drive_init(&drive, &config);

    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, status);
    assert_open(tick());
    drive_reset(&drive);
    assert_open(tick());
    TEST_ASSERT_EQUAL_INT(DRIVE_OFF, drive.state);
}

/* Before the first range of the q current is known, the reference has no acceleration to use. */
static void test_start_takes_over_the_present_speed(void)
{
    command.omega_e_radps = 900.0f;

    (void)tick();

    TEST_ASSERT_TRUE(references->speed_ref.omega_e_radps == 300.0f);
}

/* A motor that coasts without current is met with its own back-EMF, so that none starts to flow. */
static void test_start_at_speed_without_current_applies_the_back_emf(void)
{
    for (int speed = -600; speed <= 600; speed += 50) {
        setUp();
        config.motor.l2       = 0.0f; /* friction asks for a current to keep the speed */
        sample                = sample_at(0.0, 0.0, 0.3, (double)speed);
        command.omega_e_radps = (float)speed;

        (void)tick();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_START_V, 0.193 * (double)speed, (double)drive.v_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_START_V, 0.0, (double)drive.v_V.d);
    }
}

static void run_wildly(void)
{
    for (int n = 0; n < 200; n++) {
        draw_inputs();
        (void)tick();
    }
}

static void test_restart_forgets_the_past(void)
{
    const drive_sample_t  at_start = sample;
    const drive_command_t wanted   = command;
    bridge_t              fresh[5];
    for (int n = 0; n < 5; n++) {
        fresh[n] = tick();
    }

    run_wildly();
    command.run = false;
    (void)tick();
    sample  = at_start;
    command = wanted;

    for (int n = 0; n < 5; n++) {
        assert_same_output(fresh[n], tick());
    }
}

static void test_reset_while_running_forgets_the_past(void)
{
    const drive_sample_t  at_start = sample;
    const drive_command_t wanted   = command;
    bridge_t              fresh[5];
    for (int n = 0; n < 5; n++) {
        fresh[n] = tick();
    }

    run_wildly();
    drive_reset(&drive);
    sample  = at_start;
    command = wanted;

    for (int n = 0; n < 5; n++) {
        assert_same_output(fresh[n], tick());
    }
}

static void test_reset_zeroes_everything_that_is_published(void)
{
    run_wildly();
    for (int n = 0; n < 100; n++) { /* until a current is asked for again */
        draw_calm_inputs();
        (void)tick();
    }
    drive.v_limited = true;
    TEST_ASSERT_TRUE((drive.answer.d_omega != 0.0f) && (drive.answer.i_ref_A.q != 0.0f) &&
                     (drive.answer.theta_rad != 0.0f) && drive.answer.plausible);

    drive_reset(&drive);

    const law_output_t *w = &drive.answer;
    TEST_ASSERT_EQUAL_INT(DRIVE_OFF, drive.state);
    TEST_ASSERT_TRUE((drive.v_V.d == 0.0f) && (drive.v_V.q == 0.0f) && !drive.v_limited);
    TEST_ASSERT_TRUE((w->now.omega_e_radps == 0.0f) && (w->now.iq_A == 0.0f) &&
                     (w->now.id_A == 0.0f));
    TEST_ASSERT_TRUE((w->d_omega == 0.0f) && (w->d_q == 0.0f) && (w->d_d == 0.0f));
    TEST_ASSERT_TRUE((w->i_ref_A.q == 0.0f) && (w->i_ref_A.d == 0.0f) && (w->v_V.q == 0.0f) &&
                     (w->v_V.d == 0.0f) && (w->theta_rad == 0.0f) && !w->plausible);
}

typedef struct {
    float        *field;
    float         lo; /* accepted range */
    float         hi;
    drive_fault_t reason;
} input_t;

static const input_t inputs[] = {
    {&sample.theta_e_rad, -BASE_TWO_PI, BASE_TWO_PI, DRIVE_FAULT_SAMPLE},
    {&sample.ia_A, -8.0f, 8.0f, DRIVE_FAULT_OVER_CURRENT},
    {&sample.ib_A, -8.0f, 8.0f, DRIVE_FAULT_OVER_CURRENT},
    {&sample.dc_link_V, 88.5f, 398.25f, DRIVE_FAULT_DC_LINK},
    {&sample.omega_e_radps, -1569.0f, 1569.0f, DRIVE_FAULT_OVER_SPEED},
    {&command.omega_e_radps, -1.19134583e+03f, 1.19134583e+03f, DRIVE_FAULT_COMMAND},
};

/* The bridge opens at once, the reason is latched through good samples and other faults, a reset clears. */
static void assert_trips(drive_fault_t reason)
{
    if ((reason == DRIVE_FAULT_OVER_CURRENT) && base_within(sample.ia_A, 1.0e12f) &&
        base_within(sample.ib_A, 1.0e12f)) { /* one alone would be a spike */
        TEST_ASSERT_TRUE(tick().gate_enable);
    }
    assert_open(tick());
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT, drive.state);
    TEST_ASSERT_EQUAL_INT(reason, drive.fault);
    TEST_ASSERT_TRUE((drive.v_V.d == 0.0f) && (drive.v_V.q == 0.0f));

    sample = sample_at(-0.1, 0.5, 1.0, 300.0);
    assert_open(tick());
    TEST_ASSERT_EQUAL_INT(reason, drive.fault);

    sample.dc_link_V = (reason == DRIVE_FAULT_DC_LINK) ? V_DC_V : NAN;
    sample.valid     = (reason != DRIVE_FAULT_DC_LINK);
    assert_open(tick());
    TEST_ASSERT_EQUAL_INT(reason, drive.fault);

    sample                = sample_at(-0.1, 0.5, 1.0, 300.0);
    command.omega_e_radps = 300.0f;
    command.run           = true;
    drive_reset(&drive);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, drive.fault);
    TEST_ASSERT_EQUAL_INT(DRIVE_OFF, drive.state);
    TEST_ASSERT_TRUE(tick().gate_enable);
}

/* EQ-DRIVE-3: a sample's speed may be beyond the trip level by a count in a period, while the law's own is not. */
static void test_speed_between_two_edges_trips_a_count_beyond(void)
{
    for (int side = -1; side <= 1; side += 2) {
        use_encoder_form();
        const float one_e_radps = BASE_TWO_PI * (float)config.hardware.pole_pairs /
                                  (float)config.hardware.encoder_positions / config.ts_s;
        (void)tick();
        sample.omega_e_radps = (float)side * (1569.0f + (0.99f * one_e_radps));
        TEST_ASSERT_TRUE(tick().gate_enable);
        sample.omega_e_radps = (float)side * (1569.0f + (1.01f * one_e_radps));
        assert_trips(DRIVE_FAULT_OVER_SPEED);
    }
}

static void test_invalid_sample_trips(void)
{
    (void)tick();
    sample.valid = false;

    assert_trips(DRIVE_FAULT_SAMPLE);
}

static void test_every_input_that_is_not_finite_trips(void)
{
    for (int i = 0; i < SUPPORT_COUNT(inputs); i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            start_over();
            (void)tick();
            *inputs[i].field = support_not_finite[k];

            assert_trips(inputs[i].reason);
        }
    }
}

static void test_every_input_just_out_of_range_trips(void)
{
    for (int i = 0; i < SUPPORT_COUNT(inputs); i++) {
        for (int side = 0; side < 2; side++) {
            start_over();
            (void)tick();
            sample.ia_A      = 0.0f;
            sample.ib_A      = 0.0f;
            *inputs[i].field = (side == 0) ? nextafterf(inputs[i].lo, -INFINITY)
                                           : nextafterf(inputs[i].hi, INFINITY);

            assert_trips(inputs[i].reason);
        }
    }
}

static void test_every_input_at_the_end_of_its_range_is_accepted(void)
{
    for (int i = 0; i < SUPPORT_COUNT(inputs); i++) {
        for (int side = 0; side < 2; side++) {
            start_over();
            sample.ia_A      = 0.0f;
            sample.ib_A      = 0.0f;
            *inputs[i].field = (side == 0) ? inputs[i].lo : inputs[i].hi;

            TEST_ASSERT_TRUE(tick().gate_enable);
        }
    }
}

static void test_current_of_one_phase_trips_when_the_others_share_its_return(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        start_over();
        (void)tick();
        sample.ia_A = 8.02f * (float)sign;
        sample.ib_A = -4.01f * (float)sign;
        assert_trips(DRIVE_FAULT_OVER_CURRENT);

        (void)tick();
        sample.ia_A = -4.01f * (float)sign;
        sample.ib_A = 8.02f * (float)sign;
        assert_trips(DRIVE_FAULT_OVER_CURRENT);
    }
}

/* EQ-CURRENT-GATE-1: the drive goes on as with the currents that it expects. */
static void test_a_single_spike_of_the_currents_is_not_used(void)
{
    static const float spikes[] = {10.0f, -10.0f, 8.01f, 3.0f};
    for (int i = 0; i < SUPPORT_COUNT(spikes); i++) {
        use_encoder_form();
        for (int n = 0; n < 50; n++) {
            sample = sample_at(-0.1, 0.5, 1.0 + (0.06 * n), 300.0);
            (void)tick();
        }
        const nodo_t x = encoder_form->observer;
        sample         = sample_at(-0.1, 0.5, 1.0 + (0.06 * 50), 300.0);
        drive_t with   = drive;
        sample.ia_A += spikes[i];

        TEST_ASSERT_TRUE(tick().gate_enable);
        const nodo_t got = encoder_form->observer;
        sample =
            sample_at((double)x.id_A, (double)x.iq_A, (double)with.law.noc.theta_hat_rad, 300.0);
        sample.theta_e_rad = (float)(1.0 + (0.06 * 50));
        drive              = with;
        (void)tick();

        TEST_ASSERT_FLOAT_WITHIN(0.1f, encoder_form->observer.d_omega, got.d_omega);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, encoder_form->observer.iq_A, got.iq_A);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, encoder_form->observer.id_A, got.id_A);
    }
}

static void test_two_of_three_samples_beyond_the_trip_level_trip(void)
{
    static const int  patterns[] = {3, 5, 9, 1}; /* bit n: sample n is beyond */
    static const bool trips[]    = {true, true, false, false};
    for (int i = 0; i < SUPPORT_COUNT(patterns); i++) {
        start_over();
        (void)tick();
        for (int n = 0; n < 4; n++) {
            sample = sample_at(-0.1, 0.5, 1.0, 300.0);
            if (((patterns[i] >> n) & 1) != 0) {
                sample.ib_A = -8.5f;
            }
            (void)tick();
        }
        TEST_ASSERT_EQUAL_INT(trips[i] ? DRIVE_FAULT : DRIVE_RUN, drive.state);
        TEST_ASSERT_EQUAL_INT(trips[i] ? DRIVE_FAULT_OVER_CURRENT : DRIVE_FAULT_NONE, drive.fault);
    }
}

static void test_a_drive_that_does_not_run_trips_on_one_sample(void)
{
    command.run = false;
    sample.ia_A = 9.0f;
    assert_open(tick());
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_OVER_CURRENT, drive.fault);
    start_over();
    sample.ia_A = 9.0f;
    assert_open(tick());
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_OVER_CURRENT, drive.fault);
}

static void test_current_of_the_third_phase_trips(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        start_over();
        (void)tick();
        sample.ia_A = 4.01f * (float)sign;
        sample.ib_A = 4.01f * (float)sign;

        assert_trips(DRIVE_FAULT_OVER_CURRENT);
    }
}

static void test_opposite_currents_of_two_phases_leave_the_third_empty(void)
{
    sample.ia_A = 7.9f;
    sample.ib_A = -7.9f;

    TEST_ASSERT_TRUE(tick().gate_enable);
}

static void test_bad_input_trips_while_the_drive_is_off(void)
{
    command.run  = false;
    sample.valid = false;

    assert_trips(DRIVE_FAULT_SAMPLE);
}

static void test_bad_times_and_bands_of_the_angle_trip(void)
{
    float *const values[] = {&sample.band_rad, &sample.edge_gap_s, &sample.edge_age_s};
    const float  bad[]    = {-1.0e-9f, 1.1e9f, NAN};
    for (int i = 0; i < SUPPORT_COUNT(values); i++) {
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            start_over();
            TEST_ASSERT_TRUE(tick().gate_enable);
            *values[i] = bad[k];

            assert_trips(DRIVE_FAULT_SAMPLE);
        }
    }
    start_over();
    sample.band_rad = nextafterf(BASE_PI, 4.0f);
    assert_trips(DRIVE_FAULT_SAMPLE);
}

static void test_bad_sample_leaves_no_trace_in_the_measurement(void)
{
    (void)tick();
    sample.ia_A = NAN;

    (void)tick();

    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, -0.1, (double)drive.answer.now.id_A);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 0.5, (double)drive.answer.now.iq_A);
}

static void test_estimate_that_is_not_finite_trips_before_it_reaches_the_bridge(void)
{
    float *const estimates[] = {&speed_form->observer.d_omega, &speed_form->observer.d_q,
                                &speed_form->observer.d_d,     &speed_form->observer.omega_e_radps,
                                &speed_form->observer.iq_A,    &speed_form->observer.id_A};
    for (int i = 0; i < SUPPORT_COUNT(estimates); i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            start_over();
            (void)tick();
            *estimates[i] = support_not_finite[k];

            for (int n = 0; n < 3; n++) {
                const bridge_t out = tick();
                TEST_ASSERT_TRUE(base_in_range(out.duty.a, 0.0f, 1.0f));
            }

            assert_trips(DRIVE_FAULT_NUMERIC);
        }
    }
}

static void test_one_axis_that_is_not_a_number_is_enough_to_trip(void)
{
    speed_form->observer.d_q = NAN;
    (void)tick();
    speed_form->observer.d_q = NAN;
    assert_trips(DRIVE_FAULT_NUMERIC);

    start_over();
    (void)tick();
    speed_form->observer.d_d = NAN;
    assert_trips(DRIVE_FAULT_NUMERIC);
}

/* EQ-DRIVE-1 from the drive's published state: (26) power by power, and (41) as printed. The speed
 * error
 * is limited at the limit of its requested q current (EQ-NOSC-3). */
typedef struct {
    double v_q;
    double v_d;
} voltages_t;

/* The q current that is asked for, as far as EQ-NOSC-3 lets the speed error ask. */
static double oracle_asked_iq_A(void)
{
    const nosc_gains_t *g     = &constants.near_optimal.nosc;
    const double        w     = (double)drive.answer.now.omega_e_radps;
    const double        iqr   = (double)references->current_ref.i_A.q;
    const double        ratio = (double)g->lambda[0][0][0] / (double)g->lambda[0][0][1];
    const double        asked = iqr - (ratio * (w - (double)references->speed_ref.omega_e_radps));
    const double        most  = (double)g->iq_speed_max_A;
    return support_limit(support_limit(asked, iqr - most, iqr + most),
                         (double)references->current_ref.iq_lo_A,
                         (double)references->current_ref.iq_hi_A);
}

static voltages_t oracle_law(void)
{
    const motor_reduced_t *m     = &config.motor;
    const nosc_gains_t    *g     = &constants.near_optimal.nosc;
    const double           w     = (double)drive.answer.now.omega_e_radps;
    const double           iqr   = (double)references->current_ref.i_A.q;
    const double           idr   = (double)references->current_ref.i_A.d;
    const double           ratio = (double)g->lambda[0][0][0] / (double)g->lambda[0][0][1];
    const double           e_w   = (iqr - oracle_asked_iq_A()) / ratio;
    const double           w_d   = w - e_w;
    const double           e[3]  = {e_w, (double)drive.answer.now.iq_A - iqr,
                                    (double)drive.answer.now.id_A - idr};
    const double           limit = (double)g->iq_error_max_A;
    const double           held  = support_limit(e[1], -limit, limit);

    voltages_t u;
    u.v_q = ((double)m->l4 * iqr) + ((double)m->l5 * w_d) +
            (double)references->current_ref.i_dot_Aps.q +
            ((double)m->l10 * ((e[2] * w_d) + (w * idr) + (e[2] * e[0])));
    u.v_d = ((double)m->l7 * idr) + (double)references->current_ref.i_dot_Aps.d -
            ((double)m->l9 * ((e[1] * w_d) + (w * iqr) + (e[1] * e[0])));
    u.v_q = (u.v_q - (double)speed_form->observer.d_q) / (double)m->l6;
    u.v_d = (u.v_d - (double)speed_form->observer.d_d) / (double)m->l8;
    for (int n = 0; n <= g->order; n++) {
        for (int column = 0; column < NOSC_N_E; column++) {
            u.v_q -= pow(held, (double)n) * (double)g->lambda[n][0][column] * e[column];
            u.v_d -= pow(held, (double)n) * (double)g->lambda[n][1][column] * e[column];
        }
    }
    return u;
}

static void test_voltage_matches_the_printed_law(void)
{
    int compared = 0;
    for (int n = 0; n < 5000; n++) {
        draw_calm_inputs();

        (void)tick();

        const voltages_t u = oracle_law();
        if (hypot(u.v_d, u.v_q) < (double)sample.dc_link_V / sqrt(3.0)) {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V, u.v_q, (double)drive.v_V.q);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V, u.v_d, (double)drive.v_V.d);
            compared++;
        }
    }
    TEST_ASSERT_TRUE(compared > 1000);
}

/* How far the circle, or with overmodulation the hexagon, reaches in the direction of a rotor-frame vector: its
 * edges lie v_dc / sqrt(3) from the centre. Speed form: the vector acts at the angle one and a half periods on. */
static double reach_V(dq_t v_V)
{
    if (!config.overmodulation) {
        return (double)sample.dc_link_V / sqrt(3.0);
    }
    const double angle = (double)sample.theta_e_rad +
                         (1.5 * (double)config.ts_s * (double)sample.omega_e_radps) +
                         atan2((double)v_V.q, (double)v_V.d);
    const double within = remainder(angle - (0.5 * third_turn * 0.5), 0.5 * third_turn);
    return (double)sample.dc_link_V / (sqrt(3.0) * cos(within));
}

/* EQ-VOLTAGE-2 in double: what takes the place of the printed law beyond the circle. */
static voltages_t oracle_beyond(void)
{
    const motor_reduced_t *m    = &config.motor;
    const nosc_gains_t    *g    = &constants.near_optimal.nosc;
    const current_ref_t   *ref  = &references->current_ref;
    const double           w    = (double)drive.answer.now.omega_e_radps;
    const double           k_iq = (double)g->lambda[0][0][1];
    const double           id   = (double)ref->i_A.d;
    const double           iq   = oracle_asked_iq_A();
    const double           pull = k_iq * (double)m->l6;
    const double q = ((double)m->l4 * iq) + (w * ((double)m->l5 + ((double)m->l10 * id))) +
                     (double)ref->i_dot_Aps.q - (double)drive.answer.d_q;
    const double d = ((double)m->l7 * id) - ((double)m->l9 * w * iq) + (double)ref->i_dot_Aps.d -
                     (double)drive.answer.d_d;
    const voltages_t u = {
        .v_q = (q - (pull * ((double)drive.answer.now.iq_A - iq))) / (double)m->l6,
        .v_d = (d - (pull * ((double)drive.answer.now.id_A - id))) / (double)m->l8};
    return u;
}

/* Whether current_clamp.h, which has its own tests, holds this voltage back. */
static bool is_clamped(dq_t u_V, dq_t v_0_V)
{
    const double circle_V = (double)sample.dc_link_V / sqrt(3.0);
    const float  share    = (float)fmin(circle_V / support_length(u_V), 1.0);
    const dq_t   v_V      = {.d = share * u_V.d, .q = share * u_V.q};
    nodo_t       est;
    memset(&est, 0, sizeof est);
    est.d_q = drive.answer.d_q;
    est.d_d = drive.answer.d_d;

    const dq_t held = current_clamp_V(&config.motor, &est, &drive.answer.now, v_V, v_0_V,
                                      config.current_max_A, 1.0f / config.ts_s);
    return !voltage_is_outside(held, sample.dc_link_V) && ((held.d != v_V.d) || (held.q != v_V.q));
}

/* The limited voltage is the printed law within the circle, beyond it EQ-VOLTAGE-2 cut to the reach. */
static void assert_limited_voltage_is_the_printed_law(void)
{
    int compared = 0;
    for (int n = 0; n < 5000; n++) {
        draw_inputs();
        const dq_t v_0_V = drive.v_V;
        (void)tick();
        const voltages_t u        = oracle_law();
        const double     circle_V = (double)sample.dc_link_V / sqrt(3.0);
        const double     length_V = hypot(u.v_d, u.v_q);
        if ((fabs(length_V - circle_V) < 0.05) || (length_V > 2.0e4)) {
            continue;
        }
        const voltages_t wanted = (length_V > circle_V) ? oracle_beyond() : u;
        const dq_t       u_V    = {.d = (float)wanted.v_d, .q = (float)wanted.v_q};
        if (is_clamped(u_V, v_0_V)) {
            continue;
        }
        const double cut =
            (support_length(u_V) > circle_V) ? fmin(reach_V(u_V) / support_length(u_V), 1.0) : 1.0;

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, cut * wanted.v_d, (double)drive.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, cut * wanted.v_q, (double)drive.v_V.q);
        TEST_ASSERT_TRUE((fabs(cut - 1.0) < 1.0e-4) || drive.v_limited);
        compared += (cut < 1.0) ? 1 : 0;
    }
    TEST_ASSERT_TRUE(compared > 1000);
}

static void test_limited_voltage_is_the_printed_law_in_the_circle(void)
{
    assert_limited_voltage_is_the_printed_law();
}

static void test_limited_voltage_is_the_printed_law_in_the_hexagon(void)
{
    config.overmodulation = true;
    assert_limited_voltage_is_the_printed_law();
}

static void test_observer_is_driven_by_the_limited_voltage_of_the_previous_tick(void)
{
    (void)tick();
    for (int n = 0; n < 1000; n++) {
        const dq_t in_force_V = drive.v_V;
        nodo_t     expected   = speed_form->observer;
        draw_inputs();

        (void)tick();
        nodo_update(&expected, &constants.noc_speed.nodo, &config.motor, &drive.answer.now,
                    in_force_V, config.ts_s);

        TEST_ASSERT_TRUE((speed_form->observer.d_omega == expected.d_omega) &&
                         (speed_form->observer.d_q == expected.d_q) &&
                         (speed_form->observer.d_d == expected.d_d));
        TEST_ASSERT_TRUE((speed_form->observer.omega_e_radps == expected.omega_e_radps) &&
                         (speed_form->observer.iq_A == expected.iq_A) &&
                         (speed_form->observer.id_A == expected.id_A));
    }
}

static void assert_references_follow(void (*draw)(void))
{
    (void)tick();
    for (int n = 0; n < 1000; n++) {
        speed_ref_t   speed   = references->speed_ref;
        current_ref_t current = references->current_ref;
        draw();

        TEST_ASSERT_TRUE(tick().gate_enable);
        const float               e_w = drive.answer.now.omega_e_radps - speed.omega_e_radps;
        const current_ref_input_t in  = {
             .est        = &speed_form->observer,
             .state      = &drive.answer.now,
             .iq_speed_A = nosc_speed_current_A(&constants.near_optimal.nosc, e_w),
             .dc_link_V  = sample.dc_link_V,
             .v_max_Aps  = constants.near_optimal.current_ref.circle_ApVs * sample.dc_link_V};
        const speed_ref_limits_t limits =
            current_ref_speed_limits(&current, &constants.near_optimal.current_ref, &config.motor,
                                     &in, command.omega_e_radps);
        speed_ref_update(&speed, &limits, command.omega_e_radps, drive.answer.now.omega_e_radps,
                         config.ts_s);
        current_ref_update(&current, &constants.near_optimal.current_ref, &config.motor, &speed,
                           &in);

        TEST_ASSERT_TRUE(references->speed_ref.omega_e_radps == speed.omega_e_radps);
        TEST_ASSERT_TRUE((references->current_ref.i_A.d == current.i_A.d) &&
                         (references->current_ref.i_A.q == current.i_A.q));
        TEST_ASSERT_TRUE((references->current_ref.iq_lo_A == current.iq_lo_A) &&
                         (references->current_ref.iq_hi_A == current.iq_hi_A));
    }
}

static void test_references_follow_this_sample_and_command(void)
{
    assert_references_follow(draw_inputs);
}

/* Voltage vector that the duty ratios make, in the stator frame. */
static double complex realised_V(bridge_t out)
{
    const double complex turn = cexp(support_complex(0.0, third_turn));
    return (2.0 / 3.0) * (double)sample.dc_link_V *
           ((double)out.duty.a + ((double)out.duty.b * turn) + ((double)out.duty.c * conj(turn)));
}

/* EQ-DRIVE-2: seen from where the rotor is 1.5 periods after the sample. */
static void test_duty_realises_the_voltage_one_and_a_half_periods_ahead(void)
{
    for (int n = 0; n < 2000; n++) {
        draw_inputs();
        const double ahead =
            (double)sample.theta_e_rad + (1.5 * 2.0e-4 * (double)sample.omega_e_radps);

        const bridge_t out = tick();

        const double complex v_V = realised_V(out) * cexp(support_complex(0.0, -ahead));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY_V, (double)drive.v_V.d, creal(v_V));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY_V, (double)drive.v_V.q, cimag(v_V));
    }
}

static void test_same_operating_point_at_any_angle_gives_the_same_voltage(void)
{
    (void)tick();
    const dq_t expected_V = drive.v_V;
    for (int step = -62; step <= 62; step++) {
        start_over();
        sample = sample_at(-0.1, 0.5, 0.1 * (double)step, 300.0);

        (void)tick();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_ROTATE_V, (double)expected_V.d, (double)drive.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_ROTATE_V, (double)expected_V.q, (double)drive.v_V.q);
    }
}

static void assert_duties_and_voltage_stay_in_range(void)
{
    for (int32_t n = 0; n < 100000; n++) {
        draw_inputs();

        const bridge_t out = tick();

        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, drive.fault);
        TEST_ASSERT_TRUE(out.gate_enable);
        TEST_ASSERT_TRUE(base_in_range(out.duty.a, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(out.duty.b, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(out.duty.c, 0.0f, 1.0f));
        const double beyond = (support_length(drive.v_V) / reach_V(drive.v_V)) - 1.0;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_REACH, 0.0, fmax(beyond, 0.0));
    }
}

static void test_random_operation_keeps_duties_and_voltage_in_range(void)
{
    assert_duties_and_voltage_stay_in_range();
    config.overmodulation = true;
    assert_duties_and_voltage_stay_in_range();
}

/* With the dead time: the duties of the limited voltage, compensated for the currents the law saw. */
static void test_dead_time_is_compensated_for_the_currents_of_the_law(void)
{
    config.dead_time = speed_tables_drive.dead_time;
    for (int n = 0; n < 2000; n++) {
        draw_inputs();
        const bridge_t       out = tick();
        const frames_angle_t angle =
            frames_angle(sample.theta_e_rad + (1.5f * config.ts_s * sample.omega_e_radps));
        const dq_t  i_A   = {.d = drive.answer.now.id_A, .q = drive.answer.now.iq_A};
        const abc_t i_abc = frames_inverse_clarke(frames_inverse_park(i_A, angle));
        const abc_t plain = svpwm_duty(frames_inverse_park(drive.v_V, angle), sample.dc_link_V);

        const abc_t expected =
            bridge_closed(dead_time_compensate(&config.dead_time, plain, i_abc)).duty;

        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (double)expected.a, (double)out.duty.a);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (double)expected.b, (double)out.duty.b);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (double)expected.c, (double)out.duty.c);
    }
}

/* Jumps that no motor makes, anywhere in the accepted range: the observer must come through them. */
static void test_implausible_speed_samples_keep_duties_in_range(void)
{
    for (int32_t n = 0; n < 100000; n++) {
        draw_inputs();
        sample.omega_e_radps = support_uniform(&random_state, -1569.0f, 1569.0f);

        const bridge_t out = tick();

        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, drive.fault);
        TEST_ASSERT_TRUE(base_in_range(out.duty.a, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(out.duty.b, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(out.duty.c, 0.0f, 1.0f));
    }
}

/* (4) of paper A in SI units, averaged inverter, Euler at a hundredth of the period. */
typedef struct {
    double omega;
    double iq;
    double id;
    double theta;
} plant_t;

static void plant_run(plant_t *p, double complex stator_V, double load_Nm)
{
    const double rs = 2.48, ld = 0.07498, lq = 0.11391, flux = 0.193, inertia = 4.2e-4, np = 2.0;
    const double dt = 2.0e-6;
    for (int step = 0; step < 100; step++) {
        const double complex v      = stator_V * cexp(support_complex(0.0, -p->theta));
        const double         torque = 1.5 * np * p->iq * (flux + ((ld - lq) * p->id));
        const double         dw     = np * (torque - load_Nm - (1.0e-4 * p->omega / np)) / inertia;
        const double diq = (cimag(v) - (rs * p->iq) - (p->omega * (flux + (ld * p->id)))) / lq;
        const double did = (creal(v) - (rs * p->id) + (p->omega * lq * p->iq)) / ld;
        p->theta += dt * p->omega;
        p->omega += dt * dw;
        p->iq += dt * diq;
        p->id += dt * did;
    }
    p->theta = remainder(p->theta, 2.0 * (double)BASE_PI);
}

static void assert_settles(double speed, double load_Nm)
{
    plant_t        plant  = {0.0, 0.0, 0.0, 0.0};
    double complex stator = 0.0;
    command.omega_e_radps = (float)speed;
    for (int n = 0; n < 3000; n++) {
        sample                      = sample_at(plant.id, plant.iq, plant.theta, plant.omega);
        const bridge_t       out    = tick();
        const double complex coming = realised_V(out);
        plant_run(&plant, stator, load_Nm);
        stator = coming; /* in force from the next sample on */
    }

    TEST_ASSERT_EQUAL_INT(DRIVE_RUN, drive.state);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS, speed, plant.omega);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_TORQUE, load_Nm,
                              -(double)speed_form->observer.d_omega / (double)config.motor.l3);
}

static void test_loop_around_a_motor_settles_at_the_command_and_finds_the_load(void)
{
    assert_settles(300.0, 0.75);
    start_over();
    assert_settles(-300.0, 0.75); /* the load drives: regeneration */
    start_over();
    assert_settles(0.0, 0.75);
}

/* Encoder form: 10000 counts a turn, two pole pairs. */
#define COUNT_e_rad (2.0 * 6.283185307179586 / 10000.0)

typedef struct {
    plant_t        plant;
    double complex stator; /* voltage in force */
} loop_t;

static drive_sample_t encoder_sample(const plant_t *p)
{
    return sample_at(p->id, p->iq, p->theta, p->omega); /* timed edges: the angle itself */
}

static bridge_t loop_step(loop_t *loop, double load_Nm)
{
    const bridge_t       out    = tick();
    const double complex coming = out.gate_enable ? realised_V(out) : 0.0;
    plant_run(&loop->plant, loop->stator, load_Nm);
    loop->stator = coming;
    return out;
}

static loop_t settled_loop(double speed, double load_Nm)
{
    loop_t loop           = {{0.0, 0.0, 0.0, 0.0}, 0.0};
    command.omega_e_radps = (float)speed;
    for (int n = 0; n < 4000; n++) {
        sample = encoder_sample(&loop.plant);
        TEST_ASSERT_TRUE(loop_step(&loop, load_Nm).gate_enable);
    }
    return loop;
}

static void test_encoder_loop_settles_at_the_command_and_finds_the_load(void)
{
    static const double speeds[] = {300.0, -300.0, 0.0, 800.0};
    static const double loads[]  = {0.75, 0.75, 0.75, 0.2};
    static const double means[]  = {TOL_MEAN_RADPS, TOL_MEAN_RADPS, TOL_MEAN_RADPS,
                                    TOL_FAST_RADPS}; /* the last one touches the voltage limit */
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        use_encoder_form();
        loop_t loop  = settled_loop(speeds[i], loads[i]);
        double mean  = 0.0;
        double d_w   = 0.0;
        double worst = 0.0;
        for (int n = 0; n < 2000; n++) {
            sample = encoder_sample(&loop.plant);
            (void)loop_step(&loop, loads[i]);
            mean += loop.plant.omega / 2000.0;
            d_w += (double)encoder_form->observer.d_omega / 2000.0;
            worst = fmax(worst, fabs(loop.plant.omega - speeds[i]));
        }

        TEST_ASSERT_EQUAL_INT(DRIVE_RUN, drive.state);
        TEST_ASSERT_DOUBLE_WITHIN(means[i], speeds[i], mean);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_NOISE_RADPS, 0.0, worst);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_LOAD, loads[i], -d_w / (double)config.motor.l3);
    }
}

/* An encoder that stops while the motor turns. Below about 120 rad/s a standing angle looks like a load that
 * the motor could just carry: trip_d_omega is twice its torque. */
static void test_standing_angle_of_a_turning_motor_trips(void)
{
    static const double speeds[] = {300.0, -300.0, 800.0, -800.0, 150.0};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        use_encoder_form();
        constants.noc.currents.from_e_radps = 1.0e6f; /* the currents do not take its place */
        loop_t      loop                    = settled_loop(speeds[i], 0.2);
        const float stuck                   = encoder_sample(&loop.plant).theta_e_rad;
        bridge_t    out                     = {{0.0f, 0.0f, 0.0f}, true};
        int         n                       = 0;
        for (; (n < 100) && out.gate_enable; n++) {
            sample             = encoder_sample(&loop.plant);
            sample.theta_e_rad = stuck;
            out                = loop_step(&loop, 0.2);
        }

        assert_open(out);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_ENCODER, drive.fault);
    }
}

/* EQ-ANGLE-GATE-1, 2: slower ones are found too, within some periods. */
static void test_standing_angle_of_a_slow_motor_trips_at_once(void)
{
    static const double speeds[] = {20.0, -20.0, 40.0, -60.0, 100.0, 300.0, -800.0};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        use_encoder_form();
        constants.noc.currents.from_e_radps = 1.0e6f; /* the currents do not take its place */
        loop_t      loop                    = settled_loop(speeds[i], 0.2);
        const float stuck                   = encoder_sample(&loop.plant).theta_e_rad;
        bridge_t    out                     = {{0.0f, 0.0f, 0.0f}, true};
        int         n                       = 0;
        for (; (n < 100) && out.gate_enable; n++) {
            sample             = encoder_sample(&loop.plant);
            sample.theta_e_rad = stuck;
            out                = loop_step(&loop, 0.2);
        }

        assert_open(out);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_ENCODER, drive.fault);
        TEST_ASSERT_LESS_OR_EQUAL_INT(8, n);
    }
}

/* Above a speed the currents alone hold it, and the drive says so; slower it trips. */
static void test_drive_goes_on_without_its_encoder_until_it_is_slow(void)
{
    static const double speeds[] = {300.0, -300.0, 100.0};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        use_encoder_form();
        loop_t      loop  = settled_loop(speeds[i], 0.75);
        const float stuck = encoder_sample(&loop.plant).theta_e_rad;
        for (int n = 0; n < 2000; n++) {
            sample             = encoder_sample(&loop.plant);
            sample.theta_e_rad = stuck;
            TEST_ASSERT_TRUE(loop_step(&loop, 0.75).gate_enable);
            TEST_ASSERT_DOUBLE_WITHIN(20.0, speeds[i], loop.plant.omega);
            TEST_ASSERT_TRUE((n < 10) || drive.answer.without_angle);
            TEST_ASSERT_DOUBLE_WITHIN(
                0.17, 0.0, /* 10 degrees; the estimate is a period ahead */
                remainder((double)encoder_form->theta_hat_rad - loop.plant.theta,
                          2.0 * 3.141592653589793));
        }
        command.omega_e_radps = 0.0f;
        bridge_t out          = {{0.0f, 0.0f, 0.0f}, true};
        for (int n = 0; (n < 2000) && out.gate_enable; n++) {
            sample             = encoder_sample(&loop.plant);
            sample.theta_e_rad = stuck;
            out                = loop_step(&loop, 0.75);
        }
        assert_open(out);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_ENCODER, drive.fault);
        TEST_ASSERT_DOUBLE_WITHIN(10.0, 0.25 * 51.4, fabs(loop.plant.omega));
    }
}

static void test_jumping_angle_trips_in_the_same_call(void)
{
    static const float jumps[] = {0.47f, -0.47f, 1.0f, -1.0f, 3.1f, -3.1f, 4.0f, -4.0f};
    for (int i = 0; i < SUPPORT_COUNT(jumps); i++) {
        use_encoder_form();
        const loop_t loop = settled_loop(300.0, 0.2);
        sample            = encoder_sample(&loop.plant);
        sample.theta_e_rad += jumps[i];
        sample.theta_e_rad -= (sample.theta_e_rad > BASE_TWO_PI) ? BASE_TWO_PI : 0.0f;
        sample.theta_e_rad += (sample.theta_e_rad < -BASE_TWO_PI) ? BASE_TWO_PI : 0.0f;

        assert_open(tick());

        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_ENCODER, drive.fault);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT, drive.state);
        TEST_ASSERT_TRUE((drive.v_V.d == 0.0f) && (drive.v_V.q == 0.0f));
    }
}

/* The same angle, told in another turn, is no jump. */
static void test_angle_of_another_turn_is_accepted(void)
{
    use_encoder_form();
    loop_t loop = settled_loop(300.0, 0.2);
    for (int n = 0; n < 500; n++) {
        sample = encoder_sample(&loop.plant);
        if (n % 2 == 0) {
            sample.theta_e_rad += (sample.theta_e_rad < 0.0f) ? BASE_TWO_PI : -BASE_TWO_PI;
        }
        TEST_ASSERT_TRUE(loop_step(&loop, 0.2).gate_enable);
    }
}

static void test_encoder_form_trips_on_every_input_that_is_not_finite(void)
{
    use_encoder_form();
    for (int i = 0; i < SUPPORT_COUNT(inputs); i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            start_over();
            (void)tick();
            *inputs[i].field = support_not_finite[k];

            assert_trips(inputs[i].reason);
        }
    }
}

static void test_encoder_form_trips_on_estimates_that_are_not_finite(void)
{
    float *const estimates[] = {
        &encoder_form->observer.d_omega, &encoder_form->observer.d_q,
        &encoder_form->observer.d_d,     &encoder_form->observer.omega_e_radps,
        &encoder_form->observer.iq_A,    &encoder_form->observer.id_A,
        &encoder_form->theta_hat_rad};
    use_encoder_form();
    for (int i = 0; i < SUPPORT_COUNT(estimates); i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            start_over();
            (void)tick();
            *estimates[i] = support_not_finite[k];

            assert_open(tick());

            TEST_ASSERT_EQUAL_INT(DRIVE_FAULT, drive.state);
        }
    }
}

static void use_harmonics(void)
{
    base = &harmonic_tables_drive;
    start_over();
}

/* Whatever of the harmonic observer is no number, the bridge opens in that period. */
static void test_noc_h_trips_on_estimates_that_are_not_finite(void)
{
    nodo_harmonic_t *const h           = &harmonic_form->observer;
    float *const           estimates[] = {
                  &h->base.d_omega,    &h->base.d_q,  &h->base.d_d, &h->base.omega_e_radps,
                  &h->base.iq_A,       &h->base.id_A, &h->slope,    &h->theta_rad,
                  &h->theta_pairs_rad, &h->pair[0].a, &h->pair[0].b};
    use_harmonics();
    for (int i = 0; i < SUPPORT_COUNT(estimates) + (2 * constants.noc_h.nodo.n_pairs); i++) {
        const int pair = (i - SUPPORT_COUNT(estimates)) / 2;
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            start_over();
            (void)tick();
            *((i < SUPPORT_COUNT(estimates)) ? estimates[i]
              : (i % 2 == 0)                 ? &h->pair[pair].a
                                             : &h->pair[pair].b) = support_not_finite[k];

            assert_open(tick());

            TEST_ASSERT_EQUAL_INT(DRIVE_FAULT, drive.state);
        }
    }
}

static void test_noc_h_trips_on_every_input_that_is_not_finite(void)
{
    use_harmonics();
    test_every_input_that_is_not_finite_trips();
}

/* A start after a fault or a stop knows nothing of before. */
static void test_noc_h_starts_afresh(void)
{
    use_harmonics();
    (void)settled_loop(300.0, 0.5);
    TEST_ASSERT_TRUE((harmonic_form->observer.pair[0].a != 0.0f) &&
                     (harmonic_form->known.d_omega_dot != 0.0f));
    drive_reset(&drive);
    sample                = sample_at(0.0, 0.0, 1.0, 100.0);
    command.omega_e_radps = 100.0f;
    const bridge_t again  = tick();
    const drive_t  used   = drive;
    use_harmonics();
    sample                = sample_at(0.0, 0.0, 1.0, 100.0);
    command.omega_e_radps = 100.0f;
    const bridge_t first  = tick();

    TEST_ASSERT_TRUE((again.duty.a == first.duty.a) && (again.duty.b == first.duty.b));
    TEST_ASSERT_TRUE((used.law.noc_h.observer.pair[0].a == harmonic_form->observer.pair[0].a) &&
                     (used.law.noc_h.observer.slope == harmonic_form->observer.slope) &&
                     (used.law.noc_h.known.d_omega_dot == harmonic_form->known.d_omega_dot));
}

/* After a stop, and after a fault that is reset, the watch is that of a first run. */
/* References that change in every period: the look needs those of the period before it. */
static void test_a_look_at_the_currents_has_the_references_of_the_period_before(void)
{
    int looks = 0;

    for (int n = 0; n < 200; n++) {
        draw_calm_inputs();
        TEST_ASSERT_TRUE(tick().gate_enable);
        if (drive.motion_watch.look == MOTION_WATCH_LOOK_CURRENTS) {
            const dq_t ref_A = drive.answer.i_ref_A;

            looks++;
            TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, support_length(ref_A),
                                      hypot((double)drive.current_watch.ref_A.alpha,
                                            (double)drive.current_watch.ref_A.beta));
        }
    }
    TEST_ASSERT_EQUAL_INT(50, looks);
}

static void test_each_run_starts_with_a_current_watch_that_knows_nothing(void)
{
    for (int way = 0; way < 2; way++) {
        use_encoder_form();
        (void)settled_loop(300.0, 0.5);
        TEST_ASSERT_TRUE((drive.current_watch.d_slow_Aps.q != 0.0f) &&
                         (drive.current_watch.phase[0].slow_A != 0.0f));
        if (way == 0) {
            command.run = false;
            (void)tick();
        } else {
            drive_reset(&drive);
        }
        sample                     = sample_at(0.1, 0.5, 1.0, 300.0);
        command.run                = true;
        const bridge_t        last = tick();
        const current_watch_t used = drive.current_watch;

        use_encoder_form();
        sample = sample_at(0.1, 0.5, 1.0, 300.0);
        assert_same_output(tick(), last);
        TEST_ASSERT_EQUAL_MEMORY(&drive.current_watch, &used, sizeof used);
        TEST_ASSERT_EQUAL_FLOAT(sample.ia_A, used.phase[0].slow_A);
        TEST_ASSERT_EQUAL_FLOAT(sample.ib_A, used.phase[1].slow_A);
    }
}

static void test_noc_h_loop_settles_at_the_command_and_finds_the_load(void)
{
    static const double speeds[] = {300.0, -300.0, 0.0};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        use_harmonics();
        loop_t loop = settled_loop(speeds[i], 0.75);
        double mean = 0.0, d_w = 0.0;
        for (int n = 0; n < 500; n++) {
            sample = encoder_sample(&loop.plant);
            (void)loop_step(&loop, 0.75);
            mean += loop.plant.omega / 500.0;
            d_w += (double)drive.answer.d_omega / 500.0;
        }
        TEST_ASSERT_EQUAL_INT(DRIVE_RUN, drive.state);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_MEAN_RADPS, speeds[i], mean);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_LOAD, 0.75, -d_w / (double)config.motor.l3);
    }
}

/* Only its start reads the speed signal. */
static void test_encoder_form_does_not_use_the_speed_signal(void)
{
    use_encoder_form();
    loop_t  loop  = settled_loop(300.0, 0.2);
    drive_t other = drive;
    for (int n = 0; n < 50; n++) {
        sample                   = encoder_sample(&loop.plant);
        drive_sample_t disturbed = sample;
        disturbed.omega_e_radps  = support_uniform(&random_state, -1500.0f, 1500.0f);

        const bridge_t out = loop_step(&loop, 0.2);

        assert_same_output(out, drive_tick(&other, &disturbed, &command));
    }
}

/* Correct with this sample, predict with the voltage in force; law and angle belong to the prediction. */
static void test_encoder_form_acts_on_the_prediction(void)
{
    use_encoder_form();
    loop_t loop = settled_loop(300.0, 0.5);
    for (int n = 0; n < 500; n++) {
        sample              = encoder_sample(&loop.plant);
        nodo_t      x       = encoder_form->observer;
        float       theta   = encoder_form->theta_hat_rad;
        const dq_t  force_V = drive.v_V;
        const dq_t  i_A = frames_park(frames_clarke(sample.ia_A, sample.ib_A), frames_angle(theta));
        const float error = frames_wrap(sample.theta_e_rad - theta);
        nodo_encoder_correct(&x, &theta, &constants.noc.nodo, i_A, error, config.ts_s);
        nodo_encoder_predict(&x, &theta, &config.motor, force_V, config.ts_s);

        const bridge_t out = loop_step(&loop, 0.5);

        TEST_ASSERT_TRUE((encoder_form->observer.d_omega == x.d_omega) &&
                         (encoder_form->observer.d_q == x.d_q) &&
                         (encoder_form->observer.d_d == x.d_d) &&
                         (encoder_form->theta_hat_rad == theta));
        TEST_ASSERT_TRUE((drive.answer.now.omega_e_radps == x.omega_e_radps) &&
                         (drive.answer.now.iq_A == x.iq_A) && (drive.answer.now.id_A == x.id_A));
        const double ahead = (double)theta + (0.5 * (double)config.ts_s * (double)x.omega_e_radps);
        const double complex v_V = realised_V(out) * cexp(support_complex(0.0, -ahead));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY_V, (double)drive.v_V.d, creal(v_V));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY_V, (double)drive.v_V.q, cimag(v_V));
    }
}

/* A speed that wanders, its angle in counts, currents and dc link anywhere. */
static void test_encoder_form_keeps_duties_in_range_for_plausible_samples(void)
{
    double theta   = 0.0;
    int    running = 0;
    use_encoder_form();
    config.dead_time = gain_tables_drive.dead_time;
    for (int32_t n = 0; n < 100000; n++) {
        draw_inputs();
        const double i_d   = (double)support_uniform(&random_state, -4.0f, 4.0f);
        const double i_q   = (double)support_uniform(&random_state, -4.0f, 4.0f);
        const float  v_V   = sample.dc_link_V;
        theta              = remainder(theta + (2.0e-4 * walk_radps), 2.0 * (double)BASE_PI);
        sample             = sample_at(i_d, i_q, theta, walk_radps);
        sample.theta_e_rad = (float)(floor(theta / COUNT_e_rad) * COUNT_e_rad);
        sample.dc_link_V   = v_V;

        const bridge_t out = tick();

        TEST_ASSERT_TRUE(base_in_range(out.duty.a, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(out.duty.b, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(out.duty.c, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(isfinite(encoder_form->observer.omega_e_radps) && isfinite(drive.v_V.d) &&
                         isfinite(drive.v_V.q) && isfinite(encoder_form->observer.d_omega));
        TEST_ASSERT_TRUE(drive.fault != DRIVE_FAULT_NUMERIC);
        running += out.gate_enable ? 1 : 0;
        if (drive.state == DRIVE_FAULT) { /* speeds and currents that contradict each other */
            drive_reset(&drive);
        }
    }
    TEST_ASSERT_TRUE(running > 50000);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_drive_starts_off_without_fault);
    RUN_TEST(test_drive_that_is_not_asked_to_run_keeps_the_bridge_open);
    RUN_TEST(test_run_command_closes_the_bridge_in_the_same_call);
    RUN_TEST(test_withdrawn_run_command_opens_the_bridge_in_the_same_call);
    RUN_TEST(test_bad_configuration_leaves_the_drive_unusable);
    RUN_TEST(test_start_takes_over_the_present_speed);
    RUN_TEST(test_start_at_speed_without_current_applies_the_back_emf);
    RUN_TEST(test_restart_forgets_the_past);
    RUN_TEST(test_reset_while_running_forgets_the_past);
    RUN_TEST(test_reset_zeroes_everything_that_is_published);
    RUN_TEST(test_speed_between_two_edges_trips_a_count_beyond);
    RUN_TEST(test_invalid_sample_trips);
    RUN_TEST(test_every_input_that_is_not_finite_trips);
    RUN_TEST(test_every_input_just_out_of_range_trips);
    RUN_TEST(test_every_input_at_the_end_of_its_range_is_accepted);
    RUN_TEST(test_current_of_one_phase_trips_when_the_others_share_its_return);
    RUN_TEST(test_a_single_spike_of_the_currents_is_not_used);
    RUN_TEST(test_two_of_three_samples_beyond_the_trip_level_trip);
    RUN_TEST(test_a_drive_that_does_not_run_trips_on_one_sample);
    RUN_TEST(test_current_of_the_third_phase_trips);
    RUN_TEST(test_opposite_currents_of_two_phases_leave_the_third_empty);
    RUN_TEST(test_bad_input_trips_while_the_drive_is_off);
    RUN_TEST(test_bad_times_and_bands_of_the_angle_trip);
    RUN_TEST(test_bad_sample_leaves_no_trace_in_the_measurement);
    RUN_TEST(test_estimate_that_is_not_finite_trips_before_it_reaches_the_bridge);
    RUN_TEST(test_one_axis_that_is_not_a_number_is_enough_to_trip);
    RUN_TEST(test_voltage_matches_the_printed_law);
    RUN_TEST(test_limited_voltage_is_the_printed_law_in_the_circle);
    RUN_TEST(test_limited_voltage_is_the_printed_law_in_the_hexagon);
    RUN_TEST(test_observer_is_driven_by_the_limited_voltage_of_the_previous_tick);
    RUN_TEST(test_references_follow_this_sample_and_command);
    RUN_TEST(test_duty_realises_the_voltage_one_and_a_half_periods_ahead);
    RUN_TEST(test_same_operating_point_at_any_angle_gives_the_same_voltage);
    RUN_TEST(test_random_operation_keeps_duties_and_voltage_in_range);
    RUN_TEST(test_dead_time_is_compensated_for_the_currents_of_the_law);
    RUN_TEST(test_implausible_speed_samples_keep_duties_in_range);
    RUN_TEST(test_loop_around_a_motor_settles_at_the_command_and_finds_the_load);
    RUN_TEST(test_encoder_loop_settles_at_the_command_and_finds_the_load);
    RUN_TEST(test_standing_angle_of_a_turning_motor_trips);
    RUN_TEST(test_standing_angle_of_a_slow_motor_trips_at_once);
    RUN_TEST(test_drive_goes_on_without_its_encoder_until_it_is_slow);
    RUN_TEST(test_jumping_angle_trips_in_the_same_call);
    RUN_TEST(test_angle_of_another_turn_is_accepted);
    RUN_TEST(test_encoder_form_trips_on_every_input_that_is_not_finite);
    RUN_TEST(test_encoder_form_trips_on_estimates_that_are_not_finite);
    RUN_TEST(test_encoder_form_does_not_use_the_speed_signal);
    RUN_TEST(test_encoder_form_acts_on_the_prediction);
    RUN_TEST(test_encoder_form_keeps_duties_in_range_for_plausible_samples);
    RUN_TEST(test_noc_h_trips_on_estimates_that_are_not_finite);
    RUN_TEST(test_noc_h_trips_on_every_input_that_is_not_finite);
    RUN_TEST(test_noc_h_starts_afresh);
    RUN_TEST(test_a_look_at_the_currents_has_the_references_of_the_period_before);
    RUN_TEST(test_each_run_starts_with_a_current_watch_that_knows_nothing);
    RUN_TEST(test_noc_h_loop_settles_at_the_command_and_finds_the_load);
    return UNITY_END();
}
