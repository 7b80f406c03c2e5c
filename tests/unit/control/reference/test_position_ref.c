/* SPDX-License-Identifier: MIT */
#include "position_ref.h"

#include "unit_support.h"
#include "unity.h"

#define CASES 300
#define TS_s  2.0e-4f
#define FAR   3.0f /* the reference never waits for a shaft that follows */

/* Rounding of single precision, in shares of a limit. */
#define TOL_SHARE 2.0e-4

/* The way takes that much longer than the fastest there is: what is not planned with, and some periods about the end. */
#define SLOWER_SHARE 1.5e-2
#define SLOWER_TICKS 25.0

#define BEYOND_RAD 1.0e-4 /* worst 4e-5 */

/* Share of a slow motion that rounding of the angle causes, always in the same direction. */
#define ROUNDED_SHARE 1.0e-3

#define TICKS_MAX 1000000L

static support_random_t   random_state;
static position_profile_t profile;
static position_ref_t     ref;
static position_t         target;

static position_t place(int32_t turns, float theta_e_rad)
{
    const position_t p = {turns, theta_e_rad};
    return p;
}

void setUp(void)
{
    const position_t         origin = {0, 0.0f};
    const position_profile_t usual  = {.speed_e_radps  = 300.0f,
                                       .accel_e_radps2 = 5.0e3f,
                                       .decel_e_radps2 = 5.0e3f,
                                       .jerk_e_radps3  = 5.0e5f};
    random_state.state              = 11u;
    profile                         = usual;
    target                          = origin;
    position_ref_start(&ref, &origin, 0.0f, 0.0f);
}

void tearDown(void) {}

static void update(void)
{
    const position_t is = ref.at; /* a shaft that follows */
    position_ref_update(&ref, &profile, &target, &is, FAR, TS_s);
}

static double left_rad(void)
{
    return (6.283185307179586 * ((double)target.turns - (double)ref.at.turns)) +
           ((double)target.theta_e_rad - (double)ref.at.theta_e_rad);
}

/* From far beyond a kink to far beyond another: powers of ten. */
static float spread(float lo_exponent, float hi_exponent)
{
    return powf(10.0f, support_uniform(&random_state, lo_exponent, hi_exponent));
}

static void draw_profile(void)
{
    profile.speed_e_radps  = spread(0.5f, 3.2f);
    profile.accel_e_radps2 = spread(2.5f, 4.5f);
    profile.decel_e_radps2 = spread(2.5f, 4.5f);
    profile.jerk_e_radps3  = spread(4.5f, 7.5f);
}

/* One period on, and what may change in it; from a state within the limits. */
static void update_within_limits(void)
{
    const position_ref_t was  = ref;
    const double         step = (double)TS_s * (double)profile.jerk_e_radps3;
    const double most = fmax((double)profile.accel_e_radps2, (double)profile.decel_e_radps2);

    update();
    const double change = fabs((double)ref.omega_dot_e_radps2 - (double)was.omega_dot_e_radps2);
    TEST_ASSERT_TRUE(change <= (step * (1.0 + TOL_SHARE)) + (most * 1.0e-6));
    TEST_ASSERT_TRUE(fabs((double)ref.omega_dot_e_radps2) <= (most * (1.0 + TOL_SHARE)) + step);
    TEST_ASSERT_TRUE(fabs((double)ref.omega_e_radps) <=
                     ((double)profile.speed_e_radps * (1.0 + TOL_SHARE)) + (step * (double)TS_s));
}

/* Ticks to the target; limits are kept on the way, and the target is passed by no more than a period of jerk. */
static long ticks_to_target(void)
{
    const double sign = (left_rad() < 0.0) ? -1.0 : 1.0;
    const double spill =
        BEYOND_RAD + (4.0 * (double)profile.jerk_e_radps3 * pow((double)TS_s, 3.0));
    long ticks = 0;

    do {
        update_within_limits();
        TEST_ASSERT_TRUE((sign * left_rad()) >= -spill);
        ticks++;
    } while (!ref.arrived && (ticks < TICKS_MAX));
    return ticks;
}

/* Time to the speed v and back to rest, without steady speed, and the way of it; both limits of acceleration alike. */
static double ramps_s(double v, double a, double j)
{
    return 2.0 * (((v * j) > (a * a)) ? ((v / a) + (a / j)) : (2.0 * sqrt(v / j)));
}

static double fastest_s(double way)
{
    const double a    = (double)profile.accel_e_radps2;
    const double j    = (double)profile.jerk_e_radps3;
    const double v    = (double)profile.speed_e_radps;
    const double full = 0.5 * v * ramps_s(v, a, j);
    double       lo   = 0.0;
    double       hi   = v;

    if (way >= full) {
        return ramps_s(v, a, j) + ((way - full) / v);
    }
    for (int i = 0; i < 60; i++) {
        const double mid = 0.5 * (lo + hi);
        if ((0.5 * mid * ramps_s(mid, a, j)) < way) {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    return ramps_s(lo, a, j);
}

static void test_comes_to_the_target_in_the_least_time_and_rests_there(void)
{
    for (int i = 0; i < CASES; i++) {
        const position_t start = place(0, support_uniform(&random_state, -3.0f, 3.0f));
        draw_profile();
        profile.decel_e_radps2 = profile.accel_e_radps2;
        target                 = place((int32_t)support_uniform(&random_state, -60.0f, 60.0f),
                                       support_uniform(&random_state, -3.0f, 3.0f));
        position_ref_start(&ref, &start, 0.0f, 0.0f);

        const double least = fastest_s(fabs(left_rad())) / (double)TS_s;
        const double took  = (double)ticks_to_target();
        TEST_ASSERT_TRUE(ref.arrived);
        TEST_ASSERT_TRUE(took >= ((least * (1.0 - ROUNDED_SHARE)) - 2.0));
        TEST_ASSERT_TRUE(took <= (least * (1.0 + SLOWER_SHARE)) + SLOWER_TICKS);
        TEST_ASSERT_EQUAL_INT32(target.turns, ref.at.turns);
        TEST_ASSERT_TRUE(base_within(target.theta_e_rad - ref.at.theta_e_rad, 0.0f));
        update();
        TEST_ASSERT_TRUE(ref.arrived && base_within(ref.omega_e_radps, 0.0f));
    }
}

static void test_brakes_with_the_deceleration_of_its_own(void)
{
    target                 = place(30, 0.0f);
    profile.decel_e_radps2 = 1.0e3f;
    double most            = 0.0;
    double least           = 0.0;
    while (!ref.arrived) {
        update_within_limits();
        most  = fmax(most, (double)ref.omega_dot_e_radps2);
        least = fmin(least, (double)ref.omega_dot_e_radps2);
    }
    TEST_ASSERT_DOUBLE_WITHIN(5.0, 5.0e3, most);
    TEST_ASSERT_DOUBLE_WITHIN(15.0, -1.0e3, least); /* 99 % is planned */
}

static void test_a_target_that_moves_away_while_it_is_neared_is_reached_all_the_same(void)
{
    for (int i = 0; i < CASES; i++) {
        draw_profile();
        for (int turn = 0; turn < 4; turn++) {
            const long until = (long)support_uniform(&random_state, 1.0f, 900.0f);
            target           = place((int32_t)support_uniform(&random_state, -20.0f, 20.0f),
                                     support_uniform(&random_state, -3.0f, 3.0f));
            for (long k = 0; k < until; k++) {
                update_within_limits();
            }
        }
        for (long k = 0; (k < TICKS_MAX) && !ref.arrived; k++) {
            update_within_limits();
        }
        TEST_ASSERT_TRUE(ref.arrived);
        TEST_ASSERT_DOUBLE_WITHIN(0.0, 0.0, left_rad());
    }
}

static void test_limits_that_shrink_on_the_way_are_kept_soon_and_the_target_reached(void)
{
    for (int i = 0; i < CASES; i++) {
        draw_profile();
        target = place((int32_t)support_uniform(&random_state, -20.0f, 20.0f), 0.5f);
        for (int k = 0; k < 300; k++) {
            update();
        }
        draw_profile();
        for (long k = 0; (k < TICKS_MAX) && !ref.arrived; k++) {
            update();
        }
        TEST_ASSERT_TRUE(ref.arrived);
        TEST_ASSERT_DOUBLE_WITHIN(0.0, 0.0, left_rad());
    }
}

static void test_a_speed_above_the_limit_falls_to_it(void)
{
    const position_t origin = place(0, 0.0f);

    target = place(1000, 0.0f);
    position_ref_start(&ref, &origin, 900.0f, 0.0f);
    for (int k = 0; k < 1000; k++) {
        update();
    }
    TEST_ASSERT_FLOAT_WITHIN(0.05f, 300.0f, ref.omega_e_radps);
}

static void test_a_million_turns_end_as_exactly_as_one(void)
{
    const position_t start = place(999990, 1.0f);

    target = place(1000000, -2.0f);
    position_ref_start(&ref, &start, 0.0f, 0.0f);
    const long ticks = ticks_to_target();
    position_ref_start(&ref, &(position_t){-5, 1.0f}, 0.0f, 0.0f);
    target = place(5, -2.0f);
    TEST_ASSERT_EQUAL_INT64(ticks, ticks_to_target());
}

static void test_the_way_back_is_the_mirror_image(void)
{
    position_ref_t   there = ref;
    position_ref_t   back  = ref;
    const position_t t     = place(8, 1.0f);
    const position_t b     = place(-8, -1.0f);

    for (int k = 0; k < 3000; k++) {
        const position_t there_is = there.at;
        const position_t back_is  = back.at;
        position_ref_update(&there, &profile, &t, &there_is, FAR, TS_s);
        position_ref_update(&back, &profile, &b, &back_is, FAR, TS_s);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-4f, 0.0f,
                                 position_way_rad(&b, &back.at) + position_way_rad(&t, &there.at));
    }
    TEST_ASSERT_TRUE(there.arrived && back.arrived);
}

static void test_waits_for_a_shaft_that_stands_and_goes_on_when_it_turns(void)
{
    const position_t stuck = place(0, 0.0f);

    target = place(3, 0.0f);
    for (int k = 0; k < 2000; k++) {
        position_ref_update(&ref, &profile, &target, &stuck, 0.1f, TS_s);
        TEST_ASSERT_TRUE(base_within(position_way_rad(&stuck, &ref.at), 0.1000001f));
        TEST_ASSERT_FALSE(ref.arrived);
    }
    for (long k = 0; (k < 5000) && !ref.arrived; k++) {
        update();
    }
    TEST_ASSERT_TRUE(ref.arrived);
}

static void test_a_profile_has_every_limit_above_zero_and_not_above_the_drives(void)
{
    const position_profile_t most      = profile;
    float *const             members[] = {&profile.speed_e_radps, &profile.accel_e_radps2,
                                          &profile.decel_e_radps2, &profile.jerk_e_radps3};

    TEST_ASSERT_TRUE(position_profile_ok(&profile, &most));
    for (int i = 0; i < SUPPORT_COUNT(members); i++) {
        const float good  = *members[i];
        const float bad[] = {0.0f, -1.0f, 1.001f * good, NAN, INFINITY};
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            *members[i] = bad[k];
            TEST_ASSERT_FALSE(position_profile_ok(&profile, &most));
        }
        *members[i] = good;
    }
}

static void test_moved_positions_count_their_turns(void)
{
    position_t p   = place(0, 0.0f);
    double     sum = 0.0;

    for (int k = 0; k < 20000; k++) {
        const float by = support_uniform(&random_state, -1.0f, 3.0f);
        p              = position_moved(&p, by);
        sum += (double)by;
        TEST_ASSERT_TRUE(position_ok(&p));
    }
    const double counted = (6.283185307179586 * (double)p.turns) + (double)p.theta_e_rad;
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-2, sum, counted); /* rounding of 20,000 sums */
}

static void test_the_last_turn_is_not_left(void)
{
    position_t up   = place(POSITION_TURNS_MAX, 3.0f);
    position_t down = place(-POSITION_TURNS_MAX, -3.0f);

    for (int k = 0; k < 10; k++) {
        up   = position_moved(&up, 1.0f);
        down = position_moved(&down, -1.0f);
    }
    TEST_ASSERT_EQUAL_INT32(POSITION_TURNS_MAX, up.turns);
    TEST_ASSERT_EQUAL_INT32(-POSITION_TURNS_MAX, down.turns);
    up.turns++;
    TEST_ASSERT_FALSE(position_ok(&up));
    down.theta_e_rad = NAN;
    TEST_ASSERT_FALSE(position_ok(&down));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_comes_to_the_target_in_the_least_time_and_rests_there);
    RUN_TEST(test_brakes_with_the_deceleration_of_its_own);
    RUN_TEST(test_a_target_that_moves_away_while_it_is_neared_is_reached_all_the_same);
    RUN_TEST(test_limits_that_shrink_on_the_way_are_kept_soon_and_the_target_reached);
    RUN_TEST(test_a_speed_above_the_limit_falls_to_it);
    RUN_TEST(test_a_million_turns_end_as_exactly_as_one);
    RUN_TEST(test_the_way_back_is_the_mirror_image);
    RUN_TEST(test_waits_for_a_shaft_that_stands_and_goes_on_when_it_turns);
    RUN_TEST(test_a_profile_has_every_limit_above_zero_and_not_above_the_drives);
    RUN_TEST(test_moved_positions_count_their_turns);
    RUN_TEST(test_the_last_turn_is_not_left);
    return UNITY_END();
}
