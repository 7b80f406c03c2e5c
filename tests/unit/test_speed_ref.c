/* SPDX-License-Identifier: MIT */
#include "speed_ref.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_RADPS 4.0e-2 /* rad/s after 1000 sums of single precision; worst 7.4e-3 */

#define ACCEL_RADPS2 6000.0f
#define TS_s         2.0e-4f
#define STEP_RADPS   1.2f /* ACCEL_RADPS2 * TS_s */

void setUp(void) {}
void tearDown(void) {}

static speed_ref_t started_at(float omega_e_radps)
{
    speed_ref_t r;
    speed_ref_reset(&r, omega_e_radps);
    return r;
}

static void test_reset_starts_at_the_given_speed_without_acceleration(void)
{
    speed_ref_t r = {.omega_e_radps = 1.0f, .omega_dot_e_radps2 = 2.0f};

    speed_ref_reset(&r, -300.0f);

    TEST_ASSERT_TRUE((r.omega_e_radps == -300.0f) && (r.omega_dot_e_radps2 == 0.0f));
}

/* Oracle: the ramp in closed form, w0 + sign min(n a Ts, |command - w0|). */
static void test_reference_matches_closed_form_ramp(void)
{
    static const float commands[] = {-900.0f, -300.0f, -1.0f, 0.0f, 0.5f, 250.0f, 1100.0f};

    for (int i = 0; i < SUPPORT_COUNT(commands); i++) {
        const double start    = 100.0;
        const double distance = (double)commands[i] - start;
        speed_ref_t  r        = started_at((float)start);

        for (int n = 1; n <= 1000; n++) {
            const double covered  = fmin((double)n * 1.2, fabs(distance));
            const double expected = start + copysign(covered, distance);

            speed_ref_update(&r, commands[i], ACCEL_RADPS2, TS_s);

            TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS, expected, (double)r.omega_e_radps);
        }
    }
}

static void test_derivative_is_the_acceleration_until_the_last_step(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        speed_ref_t r = started_at(0.0f);

        for (int n = 1; n <= 10; n++) {
            speed_ref_update(&r, (float)direction * 10.5f * STEP_RADPS, ACCEL_RADPS2, TS_s);

            TEST_ASSERT_TRUE(r.omega_dot_e_radps2 == ((float)direction * ACCEL_RADPS2));
        }
        speed_ref_update(&r, (float)direction * 10.5f * STEP_RADPS, ACCEL_RADPS2, TS_s);

        TEST_ASSERT_TRUE(r.omega_dot_e_radps2 == 0.0f);
    }
}

static void test_reference_arrives_exactly_and_stays(void)
{
    speed_ref_t r = started_at(0.0f);

    for (int n = 0; n < 400; n++) {
        speed_ref_update(&r, 333.3f, ACCEL_RADPS2, TS_s);
    }

    TEST_ASSERT_TRUE((r.omega_e_radps == 333.3f) && (r.omega_dot_e_radps2 == 0.0f));
}

static void test_small_change_of_command_is_taken_at_once(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        const float command = 50.0f + ((float)direction * 0.99f * STEP_RADPS);
        speed_ref_t r       = started_at(50.0f);

        speed_ref_update(&r, command, ACCEL_RADPS2, TS_s);

        TEST_ASSERT_TRUE((r.omega_e_radps == command) && (r.omega_dot_e_radps2 == 0.0f));
    }
}

static void test_change_beyond_one_step_is_not_taken_at_once(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        const float command = 50.0f + ((float)direction * 1.01f * STEP_RADPS);
        speed_ref_t r       = started_at(50.0f);

        speed_ref_update(&r, command, ACCEL_RADPS2, TS_s);

        TEST_ASSERT_TRUE(r.omega_dot_e_radps2 == ((float)direction * ACCEL_RADPS2));
    }
}

static void test_direction_is_that_of_the_distance_however_small(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        speed_ref_t r = started_at(50.0f);

        speed_ref_update(&r, 50.0f + ((float)direction * 1.0e-2f), 10.0f, TS_s);

        TEST_ASSERT_TRUE(r.omega_dot_e_radps2 == ((float)direction * 10.0f));
    }
}

static void test_random_commands_never_exceed_the_acceleration_or_overshoot(void)
{
    support_random_t random = {1u};
    speed_ref_t      r      = started_at(0.0f);

    for (int n = 0; n < 10000; n++) {
        const double before  = (double)r.omega_e_radps;
        const float  command = support_uniform(&random, -5.0f, 5.0f);

        speed_ref_update(&r, command, ACCEL_RADPS2, TS_s);

        const double after = (double)r.omega_e_radps;
        TEST_ASSERT_TRUE(fabs(after - before) <= (1.0 + 1.0e-6) * (double)STEP_RADPS);
        TEST_ASSERT_TRUE(after >= fmin(before, (double)command));
        TEST_ASSERT_TRUE(after <= fmax(before, (double)command));
    }
}

static void test_opposite_commands_give_opposite_references(void)
{
    support_random_t random = {2u};
    speed_ref_t      plus   = started_at(20.0f);
    speed_ref_t      minus  = started_at(-20.0f);

    for (int n = 0; n < 1000; n++) {
        const float command = support_uniform(&random, -40.0f, 40.0f);

        speed_ref_update(&plus, command, ACCEL_RADPS2, TS_s);
        speed_ref_update(&minus, -command, ACCEL_RADPS2, TS_s);

        TEST_ASSERT_TRUE(plus.omega_e_radps == -minus.omega_e_radps);
        TEST_ASSERT_TRUE(plus.omega_dot_e_radps2 == -minus.omega_dot_e_radps2);
    }
}

static void test_bad_command_moves_the_reference_by_one_finite_step_at_most(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        speed_ref_t r = started_at(100.0f);

        speed_ref_update(&r, support_not_finite[i], ACCEL_RADPS2, TS_s);

        TEST_ASSERT_TRUE(base_in_range(r.omega_e_radps, 98.79f, 101.21f));
        TEST_ASSERT_TRUE(base_in_range(r.omega_dot_e_radps2, -ACCEL_RADPS2, ACCEL_RADPS2));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_reset_starts_at_the_given_speed_without_acceleration);
    RUN_TEST(test_reference_matches_closed_form_ramp);
    RUN_TEST(test_derivative_is_the_acceleration_until_the_last_step);
    RUN_TEST(test_reference_arrives_exactly_and_stays);
    RUN_TEST(test_small_change_of_command_is_taken_at_once);
    RUN_TEST(test_change_beyond_one_step_is_not_taken_at_once);
    RUN_TEST(test_direction_is_that_of_the_distance_however_small);
    RUN_TEST(test_random_commands_never_exceed_the_acceleration_or_overshoot);
    RUN_TEST(test_opposite_commands_give_opposite_references);
    RUN_TEST(test_bad_command_moves_the_reference_by_one_finite_step_at_most);
    return UNITY_END();
}
