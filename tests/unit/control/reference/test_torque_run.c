/* SPDX-License-Identifier: MIT */
/* A drive that takes torques: what its core accepts, and its references, feedback and voltage against formulas in double. */
#include "drive_tick.h"

#include "gain_tables.h"
#include "law_constants.h"
#include "near_optimal_run.h"
#include "noc_torque.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

#define CASES   2000
#define TOL_A   1.0e-4 /* references of some amperes; worst 2.1e-6 */
#define TOL_V   2.0e-3 /* summands up to some hundred volts; worst 2.4e-4 */
#define TOL_REL 1.0e-4 /* of an acceleration; worst 4e-6 */

static support_random_t        random_state;
static test_constants_t        constants;
static drive_config_t          config;
static drive_t                 drive;
static drive_sample_t          sample;
static drive_command_t         command;
static position_command_t      position;
static torque_command_t        torque;
static law_aim_t               aim;
static law_noc_config_t *const laws = &constants.noc;

static void take(const drive_config_t *base)
{
    config = law_constants_copy(&constants, base);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &config));
}

void setUp(void)
{
    const drive_sample_t   at_rest = {.dc_link_V = 295.0f, .theta_e_rad = 0.3f, .valid = true};
    const drive_command_t  there   = {.run = true, .aim = &aim};
    const torque_command_t half    = {.share = 0.5f, .speed_max_e_radps = 500.0f};

    random_state.state = 5u;
    sample             = at_rest;
    command            = there;
    torque             = half;
    aim.position       = NULL;
    aim.torque         = &torque;
    take(&gain_tables_drive);
}

void tearDown(void) {}

static void assert_fault(drive_fault_t fault)
{
    take(&gain_tables_drive);
    TEST_ASSERT_FALSE(drive_tick(&drive, &sample, &command).gate_enable &&
                      (fault != DRIVE_FAULT_NONE));
    TEST_ASSERT_EQUAL_INT(fault, drive.fault);
}

static void test_a_drive_without_torques_refuses_one(void)
{
    take(&speed_tables_drive);
    TEST_ASSERT_FALSE(drive_tick(&drive, &sample, &command).gate_enable);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_COMMAND, drive.fault);
}

static void test_constants_of_a_law_that_takes_none_are_refused(void)
{
    config         = law_constants_copy(&constants, &speed_tables_drive);
    config.torques = true;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
}

static void test_the_speed_is_not_looked_at_in_a_torque_run(void)
{
    command.omega_e_radps = NAN;
    assert_fault(DRIVE_FAULT_NONE);
    command.aim = NULL;
    assert_fault(DRIVE_FAULT_COMMAND);
}

static void test_commands_out_of_range_are_refused(void)
{
    assert_fault(DRIVE_FAULT_NONE);
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        torque.share = support_not_finite[k];
        assert_fault(DRIVE_FAULT_COMMAND);
        torque.share             = 0.5f;
        torque.speed_max_e_radps = support_not_finite[k];
        assert_fault(DRIVE_FAULT_COMMAND);
        torque.speed_max_e_radps = 500.0f;
    }
    torque.share = -TORQUE_SHARE_MAX;
    assert_fault(DRIVE_FAULT_NONE);
    torque.share = -1.001f * TORQUE_SHARE_MAX;
    assert_fault(DRIVE_FAULT_COMMAND);
    torque.share             = 0.5f;
    torque.speed_max_e_radps = -1.0f;
    assert_fault(DRIVE_FAULT_COMMAND);
    torque.speed_max_e_radps = 1.001f * gain_tables_drive.speed_max_e_radps;
    assert_fault(DRIVE_FAULT_COMMAND);
}

static void test_a_position_has_priority(void)
{
    const position_command_t wrong = {.profile = {.speed_e_radps = NAN}};

    position     = wrong;
    aim.position = &position;
    assert_fault(DRIVE_FAULT_COMMAND);
}

/* The law alone, with an estimate of one's own. */
static nodo_t              est;
static near_optimal_view_t view;
static law_noc_state_t     state;
static law_input_t         in;

static void any_instant(float dc_link_V, float speed_e_radps)
{
    sample.dc_link_V                             = dc_link_V;
    laws->near_optimal.current_ref.regen_start_V = 1.0e6f; /* its limit has its own test */
    in.sample                                    = &sample;
    in.aim                                       = &aim;
    est                                          = support_random_estimate(&random_state);
    est.d_omega                                  = support_uniform(&random_state, -3.0e3f, 3.0e3f);
    view.est                                     = &est;
    view.plausible                               = true;
    view.now.omega_e_radps     = support_uniform(&random_state, -speed_e_radps, speed_e_radps);
    view.now.iq_A              = support_uniform(&random_state, -2.0f, 2.0f);
    view.now.id_A              = support_uniform(&random_state, -1.0f, 0.0f);
    torque.share               = support_uniform(&random_state, -1.5f, 1.5f);
    state.near_optimal.follows = NEAR_OPTIMAL_SPEED;
    near_optimal_reset(&state.near_optimal, &laws->near_optimal, view.now.omega_e_radps);
    (void)noc_torque_error(&state, laws, &config, &view, &in); /* has its limits then */
}

static double per_A(void)
{
    return (double)config.motor.l1 + ((double)config.motor.l11 * (double)view.now.id_A);
}

/* EQ-TORQUE-1. */
static double asked_e_radps2(void)
{
    const double most =
        (double)laws->near_optimal.current_ref.iq_max_A *
        ((double)config.motor.l1 + ((double)config.motor.l11 * (double)laws->torque.id_max_A));
    return support_limit((double)torque.share * (double)config.rated_torque_Nm *
                             (double)config.motor.l3,
                         -most, most);
}

static void test_the_currents_give_the_torque(void)
{
    int cut = 0;

    torque.speed_max_e_radps = config.speed_max_e_radps;
    for (int i = 0; i < CASES; i++) {
        any_instant(30000.0f, 50.0f); /* nothing else limits */
        const noc_torque_error_t e        = noc_torque_error(&state, laws, &config, &view, &in);
        const double             wanted_A = asked_e_radps2() / per_A();
        const double             iq_A     = (double)state.near_optimal.current_ref.i_A.q;

        cut += (fabs(iq_A) < fabs(wanted_A) - 1e-3) ? 1 : 0; /* by the current circle */
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A,
                                  support_limit(wanted_A,
                                                (double)state.near_optimal.current_ref.iq_lo_A,
                                                (double)state.near_optimal.current_ref.iq_hi_A),
                                  iq_A);
        TEST_ASSERT_EQUAL_FLOAT(laws->torque.iq_VpA, e.gain_VpA.q);
        TEST_ASSERT_EQUAL_FLOAT(laws->torque.id_VpA, e.gain_VpA.d);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, e.e.omega_e_radps);
    }
    TEST_ASSERT_TRUE((cut > 0) && (cut < CASES / 2));
}

static void test_the_largest_torque_is_that_of_the_current_limit(void)
{
    torque.speed_max_e_radps = config.speed_max_e_radps;
    any_instant(30000.0f, 10.0f);
    torque.share = TORQUE_SHARE_MAX;
    for (int i = 0; i < 200; i++) { /* the d current follows the q current */
        view.now.id_A = state.near_optimal.current_ref.i_A.d;
        (void)noc_torque_error(&state, laws, &config, &view, &in);
    }
    TEST_ASSERT_FLOAT_WITHIN(2e-3f, laws->near_optimal.current_ref.iq_max_A,
                             state.near_optimal.current_ref.i_A.q);
    TEST_ASSERT_FLOAT_WITHIN(2e-3f, laws->torque.id_max_A, state.near_optimal.current_ref.i_A.d);
}

static void test_the_speed_limit_takes_torque_away_either_way(void)
{
    int limited = 0, free = 0;

    for (int i = 0; i < CASES; i++) {
        torque.speed_max_e_radps = support_uniform(&random_state, 0.0f, 100.0f);
        any_instant(30000.0f, 110.0f);
        const noc_torque_error_t e    = noc_torque_error(&state, laws, &config, &view, &in);
        const double             most = (double)torque.speed_max_e_radps;
        const double             w    = (double)view.now.omega_e_radps;
        const double k     = 0.8 * (double)laws->near_optimal.nosc.speed_A_per_radps * per_A();
        const double brake = (double)laws->near_optimal.nosc.iq_speed_max_A * per_A();
        const double drag  = (double)config.motor.l2 * most;
        const double load  = (double)est.d_omega;
        const double hi    = fmax(k * (most - w), -brake) + drag - load;
        const double lo    = fmin(-k * (most + w), brake) - drag - load;
        const double asked = asked_e_radps2();
        const double iq_A  = support_limit(support_limit(asked, lo, hi) / per_A(),
                                           (double)state.near_optimal.current_ref.iq_lo_A,
                                           (double)state.near_optimal.current_ref.iq_hi_A);
        const bool   cut   = (asked < lo) || (asked > hi);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A + (TOL_REL * fabs(iq_A)), iq_A,
                                  (double)state.near_optimal.current_ref.i_A.q);
        TEST_ASSERT_EQUAL_FLOAT(
            cut ? nosc_current_gain(&laws->near_optimal.nosc) : laws->torque.iq_VpA, e.gain_VpA.q);
        TEST_ASSERT_EQUAL_FLOAT(cut ? laws->near_optimal.nosc.lambda[0][1][2] : laws->torque.id_VpA,
                                e.gain_VpA.d);
        limited += cut ? 1 : 0;
        free += cut ? 0 : 1;
    }
    TEST_ASSERT_TRUE((limited > CASES / 10) && (free > CASES / 10));
}

/* A step is fed forward: the errors are those of the references of the period before, less what was cut of its voltage. */
static void test_a_step_is_fed_forward_and_not_an_error(void)
{
    torque.speed_max_e_radps = config.speed_max_e_radps;
    for (int i = 0; i < CASES; i++) {
        law_output_t out;
        any_instant(30000.0f, 50.0f);
        noc_torque_step(&state, laws, &config, &view, &in, &out);
        TEST_ASSERT_EQUAL_INT(NEAR_OPTIMAL_TORQUE, state.near_optimal.follows);
        const dq_t   asked_V = state.torque.asked_V;
        const dq_t   ref_A   = state.near_optimal.current_ref.i_A;
        const bool   is_cut  = (i % 2) == 1;
        const double cut_q_V =
            is_cut ? (double)support_uniform(&random_state, -100.0f, 100.0f) : 0.0;
        const double cut_d_V =
            is_cut ? (double)support_uniform(&random_state, -100.0f, 100.0f) : 0.0;
        in.v_V.q     = (float)((double)asked_V.q - cut_q_V);
        in.v_V.d     = (float)((double)asked_V.d - cut_d_V);
        torque.share = support_uniform(&random_state, -1.0f, 1.0f);

        const noc_torque_error_t e  = noc_torque_error(&state, laws, &config, &view, &in);
        const double             ts = (double)config.ts_s;
        const double from_q         = (double)ref_A.q - (ts * cut_q_V * (double)config.motor.l6);
        const double from_d         = (double)ref_A.d - (ts * cut_d_V * (double)config.motor.l8);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (double)view.now.iq_A - from_q, (double)e.e.iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (double)view.now.id_A - from_d, (double)e.e.id_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, ((double)state.near_optimal.current_ref.i_A.q - from_q),
                                  ts * (double)state.near_optimal.current_ref.i_dot_Aps.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, ((double)state.near_optimal.current_ref.i_A.d - from_d),
                                  ts * (double)state.near_optimal.current_ref.i_dot_Aps.d);
    }
}

/* The first period has no references of a torque before it. */
static void test_a_run_begins_with_the_currents_that_are(void)
{
    torque.speed_max_e_radps = config.speed_max_e_radps;
    any_instant(30000.0f, 50.0f);
    const noc_torque_error_t e = noc_torque_error(&state, laws, &config, &view, &in);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, e.e.iq_A);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, e.e.id_A);
}

static void test_the_voltage_has_the_gains_and_the_d_axis_first(void)
{
    int outside = 0;

    torque.speed_max_e_radps = config.speed_max_e_radps;
    for (int i = 0; i < CASES; i++) {
        law_output_t with;
        any_instant(support_uniform(&random_state, 150.0f, 3000.0f), 600.0f);
        laws->near_optimal.current_ref.current_max_A =
            1.0e3f; /* the clamp of currents has its own test */

        law_noc_state_t copy = state;
        noc_torque_step(&state, laws, &config, &view, &in, &with);
        const noc_torque_error_t e    = noc_torque_error(&copy, laws, &config, &view, &in);
        const float              dc_V = sample.dc_link_V;
        const dq_t   ff_V = near_optimal_forward_V(&copy.near_optimal, &config.motor, &view, &e.e);
        const double d_V  = (double)ff_V.d - ((double)e.gain_VpA.d * (double)e.e.id_A);
        const double q_V  = (double)ff_V.q - ((double)e.gain_VpA.q * (double)e.e.iq_A);
        const double inside = (double)dc_V / sqrt(3.0);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, d_V, (double)state.torque.asked_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, q_V, (double)state.torque.asked_V.q);
        if (hypot(d_V, q_V) < inside * 0.9999) {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V, d_V, (double)with.v_V.d);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V, q_V, (double)with.v_V.q);
        } else if (hypot(d_V, q_V) > inside * 1.0001) {
            const double d_cut = support_limit(d_V, -inside, inside);
            const double room =
                sqrt(fmax((4.0 / 9.0 * (double)dc_V * (double)dc_V) - (d_cut * d_cut), 0.0));
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V + (TOL_REL * fabs(d_cut)), d_cut, (double)with.v_V.d);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V + (TOL_REL * fabs(q_V)),
                                      support_limit(q_V, -room, room), (double)with.v_V.q);
            outside++;
        } else {
            /* on the edge */
        }
    }
    TEST_ASSERT_TRUE((outside > CASES / 10) && (outside < CASES));
}

static void test_a_speed_run_begins_where_the_shaft_is(void)
{
    law_output_t out;

    torque.speed_max_e_radps = config.speed_max_e_radps;
    for (int i = 0; i < CASES; i++) {
        any_instant(30000.0f, 300.0f);
        noc_torque_step(&state, laws, &config, &view, &in, &out);
        const double iq_A = (double)state.near_optimal.current_ref.i_A.q;
        const double rate = (iq_A * per_A()) -
                            ((double)config.motor.l2 * (double)view.now.omega_e_radps) +
                            (double)est.d_omega;

        TEST_ASSERT_EQUAL_FLOAT(view.now.omega_e_radps, state.near_optimal.speed_ref.omega_e_radps);
        TEST_ASSERT_EQUAL_FLOAT(view.now.omega_e_radps, out.profile_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(0.1 + (TOL_REL * fabs(rate)), rate,
                                  (double)state.near_optimal.speed_ref.omega_dot_e_radps2);
    }
}

static void test_gains_are_checked_where_they_count(void)
{
    laws->torque.iq_VpA = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
    config.torques = false;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &config));
    take(&gain_tables_drive);
    laws->torque.id_VpA = -1.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
    take(&gain_tables_drive);
    laws->torque.id_max_A = 0.1f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_drive_without_torques_refuses_one);
    RUN_TEST(test_constants_of_a_law_that_takes_none_are_refused);
    RUN_TEST(test_the_speed_is_not_looked_at_in_a_torque_run);
    RUN_TEST(test_commands_out_of_range_are_refused);
    RUN_TEST(test_a_position_has_priority);
    RUN_TEST(test_the_currents_give_the_torque);
    RUN_TEST(test_the_largest_torque_is_that_of_the_current_limit);
    RUN_TEST(test_the_speed_limit_takes_torque_away_either_way);
    RUN_TEST(test_a_step_is_fed_forward_and_not_an_error);
    RUN_TEST(test_a_run_begins_with_the_currents_that_are);
    RUN_TEST(test_the_voltage_has_the_gains_and_the_d_axis_first);
    RUN_TEST(test_a_speed_run_begins_where_the_shaft_is);
    RUN_TEST(test_gains_are_checked_where_they_count);
    return UNITY_END();
}
