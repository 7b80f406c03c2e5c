/* SPDX-License-Identifier: MIT */
#include "app_watch_inertia.h"

#include <math.h>
#include <stddef.h>

#include "unit_support.h"
#include "unity.h"

#define TS_s   200.0e-6f
#define MAX    750.0f /* rad/s, as the shipped drive */
#define CASES  300
#define REST_s 0.1
#define TURN   6.283185307179586

/* Worst of the cases: 0.006 of the ratio, by what the first and the last block of a change miss. */
#define TOLERANCE 0.03f

/* A load in rad/s^2 of the believed inertia, as a function of time and speed. */
typedef struct {
    double constant;
    double per_speed;
    double amplitude;
    double frequency_Hz;
    double phase_rad;
    double step; /* added from here on */
    double step_at_s;
} load_t;

static app_watch_inertia_t watch;
static support_random_t    random_state;
static uint32_t            ticks;
static double              time_s;
static double              speed;
static float               believed; /* by the observer, over the drive's */

void setUp(void)
{
    random_state.state = 11u;
    app_watch_inertia_reset(&watch, 1.0f);
    believed = 1.0f;
    ticks    = 4294967000u; /* wraps */
    time_s   = 0.0;
    speed    = 0.0;
}

void tearDown(void) {}

static double load_at(const load_t *l)
{
    return l->constant + (l->per_speed * speed) +
           (l->amplitude * sin((TURN * l->frequency_Hz * time_s) + l->phase_rad)) +
           ((time_s >= l->step_at_s) ? l->step : 0.0);
}

/* A shaft with k times the drive's inertia, for a time at an acceleration. The background sees
 * every `each`-th period. The observer's estimate is the present one: EQ-INERTIA-1 in double. */
static void turn(double k, double accel, double for_s, const load_t *l, unsigned each)
{
    const long periods = lround(for_s / (double)TS_s);

    for (long i = 0; i < periods; i++) {
        speed += accel * (double)TS_s;
        time_s += (double)TS_s;
        ticks++;
        if ((ticks % each) == 0u) {
            const app_watch_inertia_seen_t seen = {
                .ticks         = ticks,
                .believed      = believed,
                .runs          = true,
                .omega_e_radps = (float)speed,
                .d_omega       = (float)(((1.0 - (k / (double)believed)) * accel) + load_at(l))};
            app_watch_inertia_see(&watch, &seen, MAX, TS_s);
        }
    }
}

/* Rests, changes its speed, rests. */
static void change(double k, double by, double accel, const load_t *l, unsigned each)
{
    turn(k, 0.0, REST_s, l, each);
    turn(k, (by < 0.0) ? -accel : accel, fabs(by) / accel, l, each);
    turn(k, 0.0, REST_s, l, each);
}

static float uniform(float low, float high)
{
    return support_uniform(&random_state, low, high);
}

static void test_each_change_leaves_a_quarter_for_every_inertia_load_and_way(void)
{
    for (int i = 0; i < CASES; i++) {
        const double k     = (double)uniform(0.5f, 5.0f);
        const double by    = (double)uniform(150.0f, 400.0f) * (((i % 2) == 0) ? 1.0 : -1.0);
        const double accel = (double)uniform(4000.0f, 9000.0f) / k;
        const load_t load  = {.constant  = (double)uniform(-5000.0f, 5000.0f),
                              .per_speed = (double)uniform(-2.0f, 2.0f)};
        double       wants = 1.0;

        app_watch_inertia_reset(&watch, 1.0f);
        speed = -0.5 * by;
        for (uint16_t n = 1u; n <= 3u; n++) {
            const double way = ((n % 2u) == 1u) ? by : -by;

            change(k, way, accel, &load, 1u + (unsigned)(i % 9));
            wants += 0.75 * (k - wants);
            TEST_ASSERT_EQUAL_UINT16(n, watch.changes);
            TEST_ASSERT_FLOAT_WITHIN(TOLERANCE * (float)k, (float)wants, watch.ratio);
        }
    }
}

/* The observer goes over to what was learned: the next change still shows the drive's ratio. */
static void test_a_belief_that_follows_learns_the_same(void)
{
    for (int i = 0; i < CASES; i++) {
        const double k     = (double)uniform(0.5f, 5.0f);
        const load_t load  = {.constant = (double)uniform(-5000.0f, 5000.0f)};
        double       wants = 1.0;

        app_watch_inertia_reset(&watch, 1.0f);
        believed = 1.0f;
        speed    = -150.0;
        for (int n = 0; n < 3; n++) {
            change(k, ((n % 2) == 0) ? 300.0 : -300.0, 6000.0 / k, &load, 1u + (unsigned)(i % 9));
            wants += 0.75 * (k - wants);
            TEST_ASSERT_FLOAT_WITHIN(TOLERANCE * (float)k, (float)wants, watch.ratio);
            believed = watch.ratio;
        }
    }
}

/* d_w has a step where the belief changes. The blocks before and after do not belong together. */
static void test_a_new_belief_begins_a_rest(void)
{
    const load_t load = {.constant = 2000.0};

    turn(2.0, 0.0, REST_s, &load, 1u);
    turn(2.0, 3000.0, 0.05, &load, 1u);
    believed = 1.5f;
    turn(2.0, 3000.0, 0.05, &load, 1u);
    turn(2.0, 0.0, REST_s, &load, 1u);
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
    change(2.0, 300.0, 3000.0, &load, 1u);
    TEST_ASSERT_EQUAL_UINT16(1u, watch.changes);
}

static void test_it_starts_with_a_ratio_within_the_bounds(void)
{
    app_watch_inertia_reset(&watch, 2.5f);
    TEST_ASSERT_TRUE((watch.ratio == 2.5f) && (watch.changes == 0u));
    app_watch_inertia_reset(&watch, 0.001f);
    TEST_ASSERT_TRUE(watch.ratio == APP_WATCH_INERTIA_LEAST);
    app_watch_inertia_reset(&watch, 65.0f);
    TEST_ASSERT_TRUE(watch.ratio == APP_WATCH_INERTIA_MOST);
}

static void test_the_ratio_stays_within_its_bounds(void)
{
    const load_t none = {0};

    for (int i = 0; i < 8; i++) {
        change(9.0, ((i % 2) == 0) ? 300.0 : -300.0, 2000.0, &none, 1u);
    }
    TEST_ASSERT_TRUE(watch.ratio == APP_WATCH_INERTIA_MOST);
    for (int i = 0; i < 12; i++) {
        change(0.3, ((i % 2) == 0) ? 300.0 : -300.0, 9000.0, &none, 1u);
    }
    TEST_ASSERT_TRUE(watch.ratio == APP_WATCH_INERTIA_LEAST);
}

/* EQ-INERTIA-6. 3571 rad/s^2 are 0.75 N m. */
static void test_a_load_that_swings_teaches_nothing(void)
{
    for (int i = 0; i < CASES; i++) {
        const load_t load = {.amplitude    = 3571.0,
                             .frequency_Hz = (double)uniform(8.0f, 30.0f),
                             .phase_rad    = (double)uniform(0.0f, 6.28f)};

        change(1.0, ((i % 2) == 0) ? 200.0 : -200.0, 7000.0, &load, 1u);
    }
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
    TEST_ASSERT_TRUE(watch.ratio == 1.0f);
}

static void test_a_load_step_in_a_change_teaches_nothing(void)
{
    for (int i = 0; i < CASES; i++) {
        const double at   = time_s + REST_s + (double)uniform(0.0f, 0.028f);
        const load_t load = {.step = ((i % 3) == 0) ? 3571.0 : -3571.0, .step_at_s = at};

        change(1.0, ((i % 2) == 0) ? 200.0 : -200.0, 7000.0, &load, 1u);
    }
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
}

static void test_a_load_step_at_rest_teaches_nothing(void)
{
    const load_t load = {.step = 5000.0, .step_at_s = 0.2};

    turn(3.0, 0.0, 0.2, &load, 1u);
    turn(3.0, -2000.0, 0.005, &load, 1u); /* the dip */
    turn(3.0, 2000.0, 0.005, &load, 1u);
    turn(3.0, 0.0, 0.3, &load, 1u);
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
}

static void test_a_small_change_teaches_nothing(void)
{
    const load_t none = {0};

    change(3.0, 36.0, 2000.0, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
    change(3.0, 39.0, 2000.0, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(1u, watch.changes);
}

static void test_a_change_without_a_rest_before_teaches_nothing(void)
{
    const load_t none = {0};

    turn(3.0, 0.0, 0.03, &none, 1u);
    turn(3.0, 2000.0, 0.1, &none, 1u);
    turn(3.0, 0.0, REST_s, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
    change(3.0, -200.0, 2000.0, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(1u, watch.changes);
}

static void test_a_change_with_a_pause_is_one_change(void)
{
    const load_t none = {0};

    turn(3.0, 0.0, REST_s, &none, 1u);
    turn(3.0, 2000.0, 0.05, &none, 1u);
    turn(3.0, 0.0, 0.03, &none, 1u);
    turn(3.0, 2000.0, 0.05, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
    turn(3.0, 0.0, REST_s, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(1u, watch.changes);
    TEST_ASSERT_FLOAT_WITHIN(TOLERANCE, 2.5f, watch.ratio);
}

static void test_a_change_longer_than_a_second_is_forgotten(void)
{
    const load_t none = {0};

    turn(3.0, 0.0, REST_s, &none, 1u);
    turn(3.0, 250.0, 1.2, &none, 1u);
    turn(3.0, 0.0, REST_s, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
}

static void see_once(bool runs, float omega_e_radps, float d_omega)
{
    const app_watch_inertia_seen_t seen = {.ticks         = ++ticks,
                                           .believed      = believed,
                                           .runs          = runs,
                                           .omega_e_radps = omega_e_radps,
                                           .d_omega       = d_omega};

    app_watch_inertia_see(&watch, &seen, MAX, TS_s);
}

/* A trip in the change: the ratio stays, and the change is not taken up by the next run. */
static void test_the_end_of_a_run_freezes_the_ratio(void)
{
    const load_t none = {0};

    change(3.0, 200.0, 2000.0, &none, 1u);
    const float before = watch.ratio;
    turn(3.0, 0.0, REST_s, &none, 1u);
    turn(3.0, -2000.0, 0.05, &none, 1u);
    see_once(false, 0.0f, 0.0f);
    see_once(false, 500.0f, 1.0e6f);
    turn(3.0, -2000.0, 0.05, &none, 1u);
    turn(3.0, 0.0, REST_s, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(1u, watch.changes);
    TEST_ASSERT_TRUE(watch.ratio == before);
}

static void test_a_pass_that_comes_late_forgets_the_change(void)
{
    const load_t none = {0};

    turn(3.0, 0.0, REST_s, &none, 1u);
    turn(3.0, 2000.0, 0.05, &none, 1u);
    ticks += 70u; /* 14 ms */
    turn(3.0, 2000.0, 0.05, &none, 1u);
    turn(3.0, 0.0, REST_s, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(0u, watch.changes);
}

static void test_values_that_are_no_numbers_teach_nothing(void)
{
    const load_t none   = {0};
    const float  bad[2] = {NAN, INFINITY};

    for (size_t i = 0; i < 4; i++) {
        turn(3.0, 0.0, REST_s, &none, 1u);
        turn(3.0, 2000.0, 0.05, &none, 1u);
        see_once(true, (i < 2u) ? bad[i] : (float)speed, (i < 2u) ? 0.0f : bad[i - 2u]);
        turn(3.0, 2000.0, 0.05, &none, 1u);
        turn(3.0, 0.0, 0.1, &none, 1u);
        TEST_ASSERT_TRUE((watch.ratio >= 0.5f) && (watch.ratio <= 5.0f));
    }
    TEST_ASSERT_TRUE(watch.changes <= 2u); /* with a speed that was no number at one instant */
    turn(3.0, 0.0, 2.0, &none, 1u);
    const uint16_t before = watch.changes;
    change(3.0, 200.0, 2000.0, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(before + 1u, watch.changes);
}

static void test_the_count_stays_at_its_largest(void)
{
    const load_t none = {0};

    watch.changes = 65534u;
    change(1.0, 200.0, 2000.0, &none, 1u);
    change(1.0, -200.0, 2000.0, &none, 1u);
    TEST_ASSERT_EQUAL_UINT16(65535u, watch.changes);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_change_leaves_a_quarter_for_every_inertia_load_and_way);
    RUN_TEST(test_a_belief_that_follows_learns_the_same);
    RUN_TEST(test_a_new_belief_begins_a_rest);
    RUN_TEST(test_it_starts_with_a_ratio_within_the_bounds);
    RUN_TEST(test_the_ratio_stays_within_its_bounds);
    RUN_TEST(test_a_load_that_swings_teaches_nothing);
    RUN_TEST(test_a_load_step_in_a_change_teaches_nothing);
    RUN_TEST(test_a_load_step_at_rest_teaches_nothing);
    RUN_TEST(test_a_small_change_teaches_nothing);
    RUN_TEST(test_a_change_without_a_rest_before_teaches_nothing);
    RUN_TEST(test_a_change_with_a_pause_is_one_change);
    RUN_TEST(test_a_change_longer_than_a_second_is_forgotten);
    RUN_TEST(test_the_end_of_a_run_freezes_the_ratio);
    RUN_TEST(test_a_pass_that_comes_late_forgets_the_change);
    RUN_TEST(test_values_that_are_no_numbers_teach_nothing);
    RUN_TEST(test_the_count_stays_at_its_largest);
    return UNITY_END();
}
