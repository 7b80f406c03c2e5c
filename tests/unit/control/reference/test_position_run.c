/* SPDX-License-Identifier: MIT */
/* A drive that takes positions: what its core accepts, and what an error of the angle makes of the voltage. */
#include "drive_tick.h"

#include "gain_tables.h"
#include "law_constants.h"
#include "near_optimal_position.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

#define CASES   2000
#define TOL_V   1.0e-3 /* summands up to some hundred volts */
#define TOL_SUM 2.0e-5 /* relative */

static support_random_t             random_state;
static test_constants_t             constants;
static drive_config_t               config;
static drive_t                      drive;
static drive_sample_t               sample;
static drive_command_t              command;
static position_command_t           position;
static law_aim_t                    aim;
static near_optimal_config_t *const laws = &constants.near_optimal;

static void take(const drive_config_t *base)
{
    config = law_constants_copy(&constants, base);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &config));
}

void setUp(void)
{
    const drive_sample_t     at_rest = {.dc_link_V = 295.0f, .theta_e_rad = 0.3f, .valid = true};
    const position_command_t ahead   = {.actual  = {7, 0.3f},
                                        .target  = {9, -1.0f},
                                        .profile = {.speed_e_radps  = 300.0f,
                                                    .accel_e_radps2 = 4.0e3f,
                                                    .decel_e_radps2 = 4.0e3f,
                                                    .jerk_e_radps3  = 1.0e6f}};
    const drive_command_t    there   = {.run = true, .aim = &aim};

    random_state.state = 3u;
    sample             = at_rest;
    position           = ahead;
    aim.position       = &position;
    command            = there;
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

static void test_a_drive_without_positions_refuses_one(void)
{
    take(&speed_tables_drive);
    TEST_ASSERT_FALSE(drive_tick(&drive, &sample, &command).gate_enable);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_COMMAND, drive.fault);
}

static void test_the_speed_is_not_looked_at_on_the_way_to_a_position(void)
{
    command.omega_e_radps = NAN;
    assert_fault(DRIVE_FAULT_NONE);
    command.aim = NULL;
    assert_fault(DRIVE_FAULT_COMMAND);
}

/* Each number of the command alone: not finite, and beyond its range. */
static void assert_floats_refused(float *const *floats, const float *beyond, int count)
{
    const position_command_t good = position;

    for (int i = 0; i < count; i++) {
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            *floats[i] = support_not_finite[k];
            assert_fault(DRIVE_FAULT_COMMAND);
        }
        *floats[i] = beyond[i];
        assert_fault(DRIVE_FAULT_COMMAND);
        position = good;
    }
}

static void test_positions_and_profiles_out_of_range_are_refused(void)
{
    const position_command_t good = position;
    float *const   floats[]       = {&position.actual.theta_e_rad,     &position.target.theta_e_rad,
                                     &position.profile.speed_e_radps,  &position.profile.accel_e_radps2,
                                     &position.profile.decel_e_radps2, &position.profile.jerk_e_radps3};
    const float    beyond[]       = {3.2f, 3.2f, 0.0f, 0.0f, 0.0f, 0.0f};
    int32_t *const turns[]        = {&position.actual.turns, &position.target.turns};

    assert_fault(DRIVE_FAULT_NONE);
    assert_floats_refused(floats, beyond, SUPPORT_COUNT(floats));
    for (int i = 0; i < SUPPORT_COUNT(turns); i++) {
        *turns[i] = POSITION_TURNS_MAX + 1L;
        assert_fault(DRIVE_FAULT_COMMAND);
        *turns[i] = -POSITION_TURNS_MAX - 1L;
        assert_fault(DRIVE_FAULT_COMMAND);
        position = good;
    }
}

/* A motion replaces the target, which is then not looked at. */
static void test_motions_out_of_range_are_refused(void)
{
    position_motion_t *const m = &position.motion;

    position.moves                = true;
    position.target.theta_e_rad   = NAN;
    m->at                         = position.actual;
    m->omega_e_radps              = gain_tables_drive.speed_max_e_radps;
    const position_command_t good = position;
    float *const floats[]         = {&m->at.theta_e_rad, &m->omega_e_radps, &m->omega_dot_e_radps2,
                                     &m->omega_2dot_e_radps3};
    const float  beyond[]         = {3.2f, -1.001f * m->omega_e_radps, 2.0e12f, -2.0e12f};

    assert_fault(DRIVE_FAULT_NONE);
    assert_floats_refused(floats, beyond, SUPPORT_COUNT(floats));
    m->at.turns = POSITION_TURNS_MAX + 1L;
    assert_fault(DRIVE_FAULT_COMMAND);
    position                    = good;
    position.actual.theta_e_rad = 3.2f;
    assert_fault(DRIVE_FAULT_COMMAND);
}

/* near_optimal.h alone, with an estimate of one's own. */
static nodo_t              est;
static near_optimal_view_t view;
static near_optimal_t      state;

static law_input_t near_its_reference(void)
{
    const law_input_t in = {.sample = &sample, .aim = &aim};

    sample.dc_link_V       = 5000.0f; /* nothing is out of reach */
    view.est               = &est;
    view.plausible         = true;
    view.now.omega_e_radps = support_uniform(&random_state, -40.0f, 40.0f);
    view.now.iq_A          = support_uniform(&random_state, -1.0f, 1.0f);
    view.now.id_A          = support_uniform(&random_state, -0.5f, 0.0f);
    view.theta_rad         = support_uniform(&random_state, -3.0f, 3.0f);
    position.actual.theta_e_rad =
        frames_wrap(view.theta_rad + support_uniform(&random_state, -0.05f, 0.05f));
    position.target = position.actual;
    near_optimal_reset(&state, laws, view.now.omega_e_radps);
    return in;
}

/* One period with the reference moved away from the shaft. */
static nosc_error_t error_of(const law_input_t *in, float angle_rad, float speed_e_radps)
{
    (void)near_optimal_position_error(&state, laws, &config, &view, in);
    state.position_ref.at            = position_moved(&state.position_ref.at, -angle_rad);
    state.position_ref.omega_e_radps = view.now.omega_e_radps - speed_e_radps;
    return near_optimal_position_error(&state, laws, &config, &view, in);
}

static void test_a_motion_is_the_reference_unless_the_shaft_is_far(void)
{
    const law_input_t in       = near_its_reference();
    const float       near_rad = laws->position.near_rad;

    position.moves                      = true;
    position.motion.at                  = position_moved(&position.actual, 0.3f * near_rad);
    position.motion.omega_e_radps       = 12.0f;
    position.motion.omega_dot_e_radps2  = -345.0f;
    position.motion.omega_2dot_e_radps3 = 6789.0f;
    for (int n = 0; n < 2; n++) {
        (void)near_optimal_position_error(&state, laws, &config, &view, &in);
    }
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.0f,
                             position_way_rad(&position.motion.at, &state.position_ref.at));
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 12.0f, state.position_ref.omega_e_radps);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 12.0f, state.speed_ref.omega_e_radps);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, -345.0f, state.speed_ref.omega_dot_e_radps2);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 6789.0f, state.speed_ref.omega_2dot_e_radps3);
    TEST_ASSERT_FALSE(state.position_ref.waits);
    TEST_ASSERT_FALSE(state.position_ref.arrived);

    position.motion.at.turns += 3;
    (void)near_optimal_position_error(&state, laws, &config, &view, &in);
    TEST_ASSERT_TRUE(state.position_ref.waits);
    const float      seen_rad = view.theta_rad - (0.5f * config.ts_s * view.now.omega_e_radps);
    const position_t is =
        position_moved(&position.actual, frames_wrap(seen_rad - position.actual.theta_e_rad));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, near_rad, position_way_rad(&is, &state.position_ref.at));

    position.moves = false; /* a profile goes on from there */
    (void)near_optimal_position_error(&state, laws, &config, &view, &in);
    TEST_ASSERT_TRUE(state.position_ref.reach_e_radps2 > 0.0f);
}

static void test_errors_of_angle_and_speed_are_limited_as_one_in_the_same_share(void)
{
    const double per_rad = (double)laws->position.speed_per_rad;
    const double gain    = (double)laws->position.nosc.speed_A_per_radps;
    int          limited = 0;

    for (int i = 0; i < CASES; i++) {
        const law_input_t in  = near_its_reference();
        state.inertia.gain    = support_uniform(&random_state, 0.5f, 3.0f); /* EQ-INERTIA-4 */
        const double       g  = (double)state.inertia.gain;
        const nosc_error_t e  = error_of(&in, support_uniform(&random_state, -0.05f, 0.05f),
                                         support_uniform(&random_state, -8.0f, 8.0f));
        const position_t   is = position_moved(
              &position.actual,
              frames_wrap(view.theta_rad - (0.5f * config.ts_s * view.now.omega_e_radps) -
                          position.actual.theta_e_rad));
        const double e_theta = (double)position_way_rad(&state.position_ref.at, &is);
        const double e_w = (double)view.now.omega_e_radps - (double)state.speed_ref.omega_e_radps;
        const double asked_A   = -g * gain * (e_w + (per_rad * e_theta));
        const double iq_ref    = (double)state.current_ref.i_A.q;
        const double allowed_A = support_limit(
            support_limit(asked_A, -(double)laws->position.nosc.iq_speed_max_A,
                          (double)laws->position.nosc.iq_speed_max_A),
            (double)state.current_ref.iq_lo_A - iq_ref, (double)state.current_ref.iq_hi_A - iq_ref);
        const double share = (asked_A == 0.0) ? g : (g * allowed_A / asked_A);

        limited += (share < (0.99 * g)) ? 1 : 0;
        TEST_ASSERT_DOUBLE_WITHIN(2.0e-6 + (TOL_SUM * fabs(e_theta)), share * e_theta,
                                  (double)state.theta_error_e_rad);
        TEST_ASSERT_DOUBLE_WITHIN(2.0e-4 + (TOL_SUM * fabs(e_w)), share * e_w,
                                  (double)e.omega_e_radps);
    }
    TEST_ASSERT_TRUE((limited > CASES / 10) && (limited < CASES));
}

static void test_the_voltage_has_the_positions_gains_and_the_angles_share(void)
{
    const position_gains_t *g = &laws->position;

    for (int i = 0; i < CASES; i++) {
        const law_input_t in = near_its_reference();
        law_output_t      with, without;
        (void)error_of(&in, 0.002f, 0.1f);

        near_optimal_t copy = state;
        near_optimal_position_step(&state, laws, &config, &view, &in, &with);
        const nosc_error_t e    = near_optimal_position_error(&copy, laws, &config, &view, &in);
        const dq_t         none = {.d = 0.0f, .q = 0.0f};
        near_optimal_position_answer(&copy, laws, &config.motor, &view, &e, none, &in, &without);

        const double ei = support_limit((double)e.iq_A, -(double)g->nosc.iq_error_max_A,
                                        (double)g->nosc.iq_error_max_A);
        double       q = 0.0, d = 0.0;
        for (int n = 0; n <= g->nosc.order; n++) {
            const double x[] = {(double)e.omega_e_radps, (double)e.iq_A, (double)e.id_A};
            for (int k = 0; k < NOSC_N_E; k++) {
                q -= pow(ei, n) * (double)g->nosc.lambda[n][0][k] * x[k];
                d -= pow(ei, n) * (double)g->nosc.lambda[n][1][k] * x[k];
            }
            const double theta = pow(ei, n) * (double)g->theta[n] * (double)copy.theta_error_e_rad;
            q -= ((n % 2) == 0) ? theta : 0.0;
            d -= ((n % 2) == 0) ? 0.0 : theta;
        }
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, q, (double)with.v_V.q - (double)without.v_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, d, (double)with.v_V.d - (double)without.v_V.d);
    }
}

static void test_a_speed_run_knows_no_angle_again(void)
{
    law_input_t in = near_its_reference();

    (void)error_of(&in, 0.02f, 0.0f);
    TEST_ASSERT_EQUAL_INT(NEAR_OPTIMAL_POSITION, state.follows);
    TEST_ASSERT_TRUE(fabsf(state.theta_error_e_rad) > 0.0f);
    in.aim = NULL;
    (void)near_optimal_error(&state, laws, &config, &view, &in);
    TEST_ASSERT_EQUAL_INT(NEAR_OPTIMAL_SPEED, state.follows);
    in.aim = &aim; /* the next run begins where the shaft is, and forgets the error */
    state.theta_error_e_rad = 1.0f;
    (void)near_optimal_position_error(&state, laws, &config, &view, &in);
    TEST_ASSERT_TRUE(base_within(state.theta_error_e_rad, 0.01f));
}

static void test_gains_of_the_position_are_checked_where_they_count(void)
{
    laws->position.near_rad = 0.0f;
    TEST_ASSERT_FALSE(near_optimal_check(laws, &config));
    config.positions = false;
    TEST_ASSERT_TRUE(near_optimal_check(laws, &config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_drive_without_positions_refuses_one);
    RUN_TEST(test_the_speed_is_not_looked_at_on_the_way_to_a_position);
    RUN_TEST(test_positions_and_profiles_out_of_range_are_refused);
    RUN_TEST(test_motions_out_of_range_are_refused);
    RUN_TEST(test_a_motion_is_the_reference_unless_the_shaft_is_far);
    RUN_TEST(test_errors_of_angle_and_speed_are_limited_as_one_in_the_same_share);
    RUN_TEST(test_the_voltage_has_the_positions_gains_and_the_angles_share);
    RUN_TEST(test_a_speed_run_knows_no_angle_again);
    RUN_TEST(test_gains_of_the_position_are_checked_where_they_count);
    return UNITY_END();
}
