/* SPDX-License-Identifier: MIT */
#include "speed_ref.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_SHARE                                                                                  \
    2.0e-4          /* of one period's step, rounding of speeds up to 2000 rad/s not included */
#define TOL_ULP 3.0 /* spacings of the speed as single-precision number */

#define TS_s        2.0e-4f
#define FAR_e_radps 1.0e6f /* the reference never waits */

static support_random_t   random_state;
static speed_ref_limits_t limits;

static void set_jerk(float up, float down)
{
    limits.jerk_up_e_radps3   = up;
    limits.jerk_down_e_radps3 = down;
}

/* The one that ends the acceleration on the way. */
static double stopping_jerk(double direction)
{
    return (double)((direction > 0.0) ? limits.jerk_down_e_radps3 : limits.jerk_up_e_radps3);
}

void setUp(void)
{
    random_state.state       = 3u;
    limits.accel_hi_e_radps2 = 6000.0f;
    limits.accel_lo_e_radps2 = -6000.0f;
    set_jerk(1.0e6f, 1.0e6f);
    limits.near_e_radps = FAR_e_radps;
    limits.samples_1ps  = (float)(1.0 / (double)TS_s);
}

void tearDown(void) {}

static speed_ref_t started_at(float omega_e_radps)
{
    speed_ref_t r;
    speed_ref_reset(&r, omega_e_radps);
    return r;
}

static void update(speed_ref_t *r, float command)
{
    speed_ref_update(r, &limits, command, r->omega_e_radps, TS_s);
}

static double ulps(double speed)
{
    const float x = fmaxf(fabsf((float)speed), 1.0e-3f);
    return (double)nextafterf(x, INFINITY) - (double)x;
}

/* Relative rounding of accelerations and of the quotient that gives w_d''. */
static void assert_within_limits(const speed_ref_t *before, const speed_ref_t *after)
{
    const double up     = (double)limits.jerk_up_e_radps3;
    const double down   = (double)limits.jerk_down_e_radps3;
    const double top    = fmax((double)limits.accel_hi_e_radps2, -(double)limits.accel_lo_e_radps2);
    const double change = (double)after->omega_dot_e_radps2 - (double)before->omega_dot_e_radps2;

    TEST_ASSERT_TRUE(change <= (up * (double)TS_s) + (1.0e-6 * top));
    TEST_ASSERT_TRUE(-change <= (down * (double)TS_s) + (1.0e-6 * top));
    TEST_ASSERT_TRUE((double)after->omega_2dot_e_radps3 <=
                     (up * (1.0 + 1.0e-6)) + (1.0e-6 * top / (double)TS_s));
    TEST_ASSERT_TRUE(-(double)after->omega_2dot_e_radps3 <=
                     (down * (1.0 + 1.0e-6)) + (1.0e-6 * top / (double)TS_s));
    TEST_ASSERT_TRUE((double)after->omega_dot_e_radps2 <=
                     (double)limits.accel_hi_e_radps2 + (1.0e-6 * top));
    TEST_ASSERT_TRUE((double)after->omega_dot_e_radps2 >=
                     (double)limits.accel_lo_e_radps2 - (1.0e-6 * top));
}

static void test_reset_starts_at_the_given_speed_without_acceleration(void)
{
    speed_ref_t r = {1.0f, 2.0f, 3.0f, 4.0f};

    speed_ref_reset(&r, -300.0f);

    TEST_ASSERT_TRUE((r.omega_e_radps == -300.0f) && (r.omega_dot_e_radps2 == 0.0f));
    TEST_ASSERT_TRUE((r.omega_2dot_e_radps3 == 0.0f) && (r.accel_wanted_e_radps2 == 0.0f));
}

static void test_command_at_the_reference_changes_nothing(void)
{
    speed_ref_t r = started_at(123.0f);

    for (int n = 0; n < 100; n++) {
        update(&r, 123.0f);
    }

    TEST_ASSERT_TRUE((r.omega_e_radps == 123.0f) && (r.omega_dot_e_radps2 == 0.0f));
    TEST_ASSERT_TRUE((r.omega_2dot_e_radps3 == 0.0f) && (r.accel_wanted_e_radps2 == 0.0f));
}

/* Oracle for EQ-SPEED-REF-1. With n whole steps of the jerk, a* = n j Ts ends within the distance
 * j Ts^2 n (n + 1) / 2. Between them, a* follows the positive root of that quadratic in n. */
static void test_wanted_acceleration_is_the_one_that_still_stops(void)
{
    set_jerk(1.0e6f, 1.7e6f);
    for (int n = 1; n <= 400; n++) {
        for (int direction = -1; direction <= 1; direction += 2) {
            const double step     = stopping_jerk(direction) * (double)TS_s;
            const double distance = step * (double)TS_s * 0.5 * (double)n * (double)(n + 1);
            speed_ref_t  r        = started_at(0.0f);

            update(&r, (float)(distance * (double)direction));

            TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, (double)direction,
                                      (double)r.accel_wanted_e_radps2 / ((double)n * step));
        }
    }
}

static void test_wish_of_the_last_step_lands_on_the_command(void)
{
    for (int part = 1; part <= 100; part++) {
        const double distance =
            0.01 * (double)part * stopping_jerk(1.0) * (double)TS_s * (double)TS_s;
        speed_ref_t r = started_at(0.0f);

        update(&r, (float)distance);

        TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 1.0, (double)r.omega_e_radps / distance);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 1.0,
                                  (double)r.accel_wanted_e_radps2 * (double)TS_s / distance);
    }
}

/* The wish is told whatever the limits allow. */
static void test_wish_ignores_the_limits_of_acceleration(void)
{
    speed_ref_t narrow = started_at(0.0f);
    speed_ref_t wide   = started_at(0.0f);

    update(&wide, 700.0f);
    limits.accel_hi_e_radps2 = 10.0f;
    update(&narrow, 700.0f);

    TEST_ASSERT_TRUE(narrow.accel_wanted_e_radps2 == wide.accel_wanted_e_radps2);
    TEST_ASSERT_TRUE(narrow.omega_dot_e_radps2 == 10.0f);
}

/* From rest to rest over any distance: within the limits at every step, no overshoot, the command exactly.
 * A rest below one jerk step passes the command. With n j Ts left, n between one and two, it passes
 * by (n - 1) (2 - n) / 2 j Ts^2, at most an eighth of j Ts^2. */
static void assert_travels(float start, float distance)
{
    const float  command   = start + distance;
    const float  direction = (command < start) ? -1.0f : 1.0f;
    speed_ref_t  r         = started_at(start);
    const double rounding  = TOL_ULP * ulps(fmax(fabs((double)start), fabs((double)command)));
    /* Every period of the stop rounds the speed by half a spacing. */
    const double step = stopping_jerk((double)direction) * (double)TS_s;
    const double stop = fmax((double)limits.accel_hi_e_radps2, -(double)limits.accel_lo_e_radps2);
    const double most = (0.125 * step * (double)TS_s) + (0.5 * (stop / step) * rounding / TOL_ULP);
    const double allowed = rounding + most;

    for (int n = 0; n < 6000; n++) {
        const speed_ref_t before = r;
        update(&r, command);

        assert_within_limits(&before, &r);
        TEST_ASSERT_TRUE((double)(direction * (r.omega_e_radps - command)) <= allowed);
        TEST_ASSERT_TRUE((double)(direction * (r.omega_e_radps - before.omega_e_radps)) >=
                         -allowed);
    }
    TEST_ASSERT_DOUBLE_WITHIN(rounding, (double)command, (double)r.omega_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(rounding / (double)TS_s, 0.0, (double)r.omega_dot_e_radps2);
}

static void test_any_distance_is_travelled_without_overshoot(void)
{
    for (int step = 0; step <= 36; step++) {
        const float distance = powf(10.0f, -3.0f + ((float)step / 6.0f));
        assert_travels(0.0f, distance);
        assert_travels(0.0f, -distance);
        assert_travels(-300.0f, distance);
    }
}

static void test_any_limits_are_kept_without_overshoot(void)
{
    for (int n = 0; n < 60; n++) {
        limits.accel_hi_e_radps2 = support_uniform(&random_state, 3000.0f, 10000.0f);
        limits.accel_lo_e_radps2 = -support_uniform(&random_state, 3000.0f, 10000.0f);
        /* from soft to one step; the two differ by at most the share of current_ref_speed_limits() */
        const float jerk = powf(10.0f, support_uniform(&random_state, 5.0f, 7.5f));
        set_jerk(jerk, jerk * support_uniform(&random_state, 0.4f, 2.5f));
        assert_travels(support_uniform(&random_state, -500.0f, 500.0f),
                       support_uniform(&random_state, -500.0f, 500.0f));
    }
}

/* The exact optimum in continuous time: two ramps of the acceleration, at most one stretch between them. */
static void test_profile_takes_hardly_longer_than_the_fastest_one(void)
{
    static const float distances[] = {1.0f, 10.0f, 35.0f, 100.0f, 600.0f};
    const double       a           = 6000.0;
    const double       j           = 1.0e6;
    for (int i = 0; i < SUPPORT_COUNT(distances); i++) {
        const double s       = (double)distances[i];
        const double fastest = (s < a * a / j) ? (2.0 * sqrt(s / j)) : ((s / a) + (a / j));
        speed_ref_t  r       = started_at(0.0f);
        int          periods = 0;
        while ((double)r.omega_e_radps < 0.999 * s) {
            update(&r, distances[i]);
            periods++;
            TEST_ASSERT_TRUE(periods < 10000);
        }

        TEST_ASSERT_TRUE((double)periods * (double)TS_s <= (1.02 * fastest) + (4.0 * (double)TS_s));
        TEST_ASSERT_TRUE((double)periods * (double)TS_s >= (0.98 * fastest) - (2.0 * (double)TS_s));
    }
}

/* w_d is the sum of w_d', and w_d' the sum of w_d'', whatever happens to command and limits. */
static void test_derivatives_are_those_of_the_reference(void)
{
    speed_ref_t r = started_at(0.0f);
    for (int n = 0; n < 20000; n++) {
        const speed_ref_t before = r;
        limits.accel_hi_e_radps2 = support_uniform(&random_state, 0.0f, 9000.0f);
        limits.accel_lo_e_radps2 = -support_uniform(&random_state, 0.0f, 9000.0f);
        set_jerk(support_uniform(&random_state, 1.0e5f, 3.0e6f),
                 support_uniform(&random_state, 1.0e5f, 3.0e6f));

        update(&r, support_uniform(&random_state, -100.0f, 100.0f));

        const double at = fmax(fabs((double)before.omega_e_radps), fabs((double)r.omega_e_radps));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_ULP * ulps(at), (double)r.omega_dot_e_radps2 * (double)TS_s,
                                  (double)r.omega_e_radps - (double)before.omega_e_radps);
        TEST_ASSERT_DOUBLE_WITHIN(2.0e-3,
                                  (double)r.omega_dot_e_radps2 - (double)before.omega_dot_e_radps2,
                                  (double)r.omega_2dot_e_radps3 * (double)TS_s);
    }
}

static void test_random_commands_never_exceed_the_limits(void)
{
    speed_ref_t r = started_at(0.0f);
    for (int n = 0; n < 20000; n++) {
        const speed_ref_t before  = r;
        const float       command = support_uniform(&random_state, -50.0f, 50.0f);

        update(&r, command);

        assert_within_limits(&before, &r);
    }
}

/* Limits that shrink at once cannot be met at once: the acceleration comes down with the jerk. */
static void test_acceleration_beyond_new_limits_is_taken_back_with_the_jerk(void)
{
    speed_ref_t r = started_at(0.0f);
    for (int n = 0; n < 100; n++) {
        update(&r, 1.0e4f);
    }
    TEST_ASSERT_TRUE(r.omega_dot_e_radps2 == 6000.0f);

    limits.accel_hi_e_radps2 = 1000.0f;
    for (int n = 1; n <= 25; n++) {
        update(&r, 1.0e4f);

        TEST_ASSERT_DOUBLE_WITHIN(2.0e-2, 6000.0 - (200.0 * (double)n),
                                  (double)r.omega_dot_e_radps2);
        TEST_ASSERT_DOUBLE_WITHIN(10.0, -1.0e6, (double)r.omega_2dot_e_radps3);
    }
    update(&r, 1.0e4f);
    TEST_ASSERT_TRUE(r.omega_dot_e_radps2 == 1000.0f);
}

static void test_reference_without_any_acceleration_stays(void)
{
    speed_ref_t r            = started_at(40.0f);
    limits.accel_hi_e_radps2 = 0.0f;
    limits.accel_lo_e_radps2 = 0.0f;

    for (int n = 0; n < 100; n++) {
        update(&r, (n < 50) ? 900.0f : -900.0f);
    }

    TEST_ASSERT_TRUE((r.omega_e_radps == 40.0f) && (r.omega_dot_e_radps2 == 0.0f));
}

static void test_reference_waits_near_the_actual_speed(void)
{
    limits.near_e_radps = 15.0f;
    for (int direction = -1; direction <= 1; direction += 2) {
        speed_ref_t r = started_at(0.0f);
        for (int n = 0; n < 1000; n++) {
            speed_ref_update(&r, &limits, 600.0f * (float)direction, 100.0f, TS_s);

            TEST_ASSERT_TRUE(base_in_range(r.omega_e_radps, 85.0f, 115.0f));
        }
        TEST_ASSERT_TRUE(r.omega_e_radps == 100.0f + (15.0f * (float)direction));
    }
}

/* A blocked motor that comes free: the reference goes on from where the motor is. */
static void test_reference_follows_a_motor_that_is_carried_away(void)
{
    speed_ref_t r       = started_at(100.0f);
    limits.near_e_radps = 15.0f;
    for (int speed = 100; speed >= -300; speed--) {
        speed_ref_update(&r, &limits, 100.0f, (float)speed, TS_s);

        TEST_ASSERT_TRUE(
            base_in_range(r.omega_e_radps, (float)speed - 15.0f, (float)speed + 15.0f));
    }
    for (int n = 0; n < 3000; n++) {
        speed_ref_update(&r, &limits, 100.0f, r.omega_e_radps, TS_s);
    }
    TEST_ASSERT_DOUBLE_WITHIN(TOL_SHARE, 100.0, (double)r.omega_e_radps);
}

static void test_opposite_commands_give_opposite_references(void)
{
    speed_ref_t plus    = started_at(20.0f);
    speed_ref_t minus   = started_at(-20.0f);
    limits.near_e_radps = 30.0f;

    for (int n = 0; n < 5000; n++) {
        const float              command  = support_uniform(&random_state, -40.0f, 40.0f);
        const float              speed    = support_uniform(&random_state, -20.0f, 20.0f);
        const float              hi       = support_uniform(&random_state, 0.0f, 9000.0f);
        const float              lo       = -support_uniform(&random_state, 0.0f, 9000.0f);
        const speed_ref_limits_t forward  = {hi, lo, 1.0e6f, 1.7e6f, 30.0f, limits.samples_1ps};
        const speed_ref_limits_t mirrored = {-lo, -hi, 1.7e6f, 1.0e6f, 30.0f, limits.samples_1ps};

        speed_ref_update(&plus, &forward, command, speed, TS_s);
        speed_ref_update(&minus, &mirrored, -command, -speed, TS_s);

        TEST_ASSERT_TRUE(plus.omega_e_radps == -minus.omega_e_radps);
        TEST_ASSERT_TRUE(plus.omega_dot_e_radps2 == -minus.omega_dot_e_radps2);
        TEST_ASSERT_TRUE(plus.omega_2dot_e_radps3 == -minus.omega_2dot_e_radps3);
        TEST_ASSERT_TRUE(plus.accel_wanted_e_radps2 == -minus.accel_wanted_e_radps2);
    }
}

static void test_bad_command_moves_the_reference_by_one_finite_step_at_most(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        speed_ref_t       r      = started_at(100.0f);
        const speed_ref_t before = r;

        update(&r, support_not_finite[i]);

        assert_within_limits(&before, &r);
        TEST_ASSERT_TRUE(base_in_range(r.omega_e_radps, 99.9f, 100.1f));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_reset_starts_at_the_given_speed_without_acceleration);
    RUN_TEST(test_command_at_the_reference_changes_nothing);
    RUN_TEST(test_wanted_acceleration_is_the_one_that_still_stops);
    RUN_TEST(test_wish_of_the_last_step_lands_on_the_command);
    RUN_TEST(test_wish_ignores_the_limits_of_acceleration);
    RUN_TEST(test_any_distance_is_travelled_without_overshoot);
    RUN_TEST(test_any_limits_are_kept_without_overshoot);
    RUN_TEST(test_profile_takes_hardly_longer_than_the_fastest_one);
    RUN_TEST(test_derivatives_are_those_of_the_reference);
    RUN_TEST(test_random_commands_never_exceed_the_limits);
    RUN_TEST(test_acceleration_beyond_new_limits_is_taken_back_with_the_jerk);
    RUN_TEST(test_reference_without_any_acceleration_stays);
    RUN_TEST(test_reference_waits_near_the_actual_speed);
    RUN_TEST(test_reference_follows_a_motor_that_is_carried_away);
    RUN_TEST(test_opposite_commands_give_opposite_references);
    RUN_TEST(test_bad_command_moves_the_reference_by_one_finite_step_at_most);
    return UNITY_END();
}
