/* SPDX-License-Identifier: MIT */
#include "speed_difference.h"

#include "unit_support.h"
#include "unity.h"

#define TS_s 2.0e-4f
#define TOL_radps                                                                                  \
    2.0e-3 /* rad/s: angles of some radians in single precision over 1 ms; worst 7e-4 */

static const speed_difference_config_t config = {
    .periods = 5, .inv_span_1ps = 1000.0f, .edge_gap_max_s = 4.0e-4f, .count_rad = 1.2566371e-3f};
static speed_difference_t s;
static drive_sample_t     sample;

void setUp(void)
{
    const drive_sample_t at = {.theta_e_rad = 6.0f, .omega_e_radps = 300.0f, .valid = true};

    sample = at;
    speed_difference_reset(&s, &config, &sample, TS_s);
}

void tearDown(void) {}

static double next(double theta_rad)
{
    const double turn = 2.0 * 3.14159265358979;
    float        w    = NAN;

    sample.theta_e_rad = (float)(theta_rad - (turn * floor(theta_rad / turn)));
    (void)speed_difference_update(&s, &config, &sample, TS_s, &w);
    return (double)w;
}

/* The mean of the last five periods of a shaft that accelerates is its speed half of them ago; turns do not show. */
static void test_it_is_the_speed_half_a_window_ago(void)
{
    for (int k = 0; k <= 500; k++) {
        const double t    = 2.0e-4 * k;
        const double w    = next(6.0 + (300.0 * t) + (0.5 * 5000.0 * t * t));
        const double then = 300.0 + (5000.0 * (t - 5.0e-4));

        if (k >= 5) {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_radps, then, w);
        }
    }
}

static void test_backwards_as_forwards(void)
{
    sample.omega_e_radps = -900.0f;
    sample.theta_e_rad   = -6.0f;
    speed_difference_reset(&s, &config, &sample, TS_s);

    for (int k = 0; k <= 100; k++) {
        TEST_ASSERT_DOUBLE_WITHIN(TOL_radps, -900.0, next(-6.0 - (900.0 * 2.0e-4 * k)));
    }
}

/* As if it had turned at the sample's speed before: no transient. */
static void test_it_starts_at_the_samples_speed(void)
{
    for (int k = 0; k <= 10; k++) {
        TEST_ASSERT_DOUBLE_WITHIN(TOL_radps, 300.0, next(6.0 + (0.06 * k)));
    }
}

/* A flipped bit in the place of the next angle: nothing is written elsewhere, and five periods later all is well. */
static void test_a_place_that_does_not_exist_is_none(void)
{
    static const int16_t places[] = {-1, 5, 32767};

    for (int i = 0; i < SUPPORT_COUNT(places); i++) {
        s.oldest = places[i];
        for (int k = 0; k <= 10; k++) {
            const double w = next(6.0 + (0.06 * k));
            if (k >= 5) {
                TEST_ASSERT_DOUBLE_WITHIN(TOL_radps, 300.0, w);
            }
        }
    }
}

static void test_edges_are_taken_while_they_are_frequent(void)
{
    float w = 0.0f;

    sample.omega_e_radps = 123.0f;
    sample.edge_gap_s    = 4.0e-4f;
    TEST_ASSERT_EQUAL_INT(SPEED_DIFFERENCE_TIMED,
                          speed_difference_update(&s, &config, &sample, TS_s, &w));
    TEST_ASSERT_TRUE(w == 123.0f);
    sample.edge_gap_s = 4.1e-4f;
    TEST_ASSERT_EQUAL_INT(SPEED_DIFFERENCE_COUNTED,
                          speed_difference_update(&s, &config, &sample, TS_s, &w));
    TEST_ASSERT_FALSE(w == 123.0f);
    sample.edge_gap_s = 0.0f; /* not from edges */
    TEST_ASSERT_EQUAL_INT(SPEED_DIFFERENCE_COUNTED,
                          speed_difference_update(&s, &config, &sample, TS_s, &w));
}

/* The last edge of each period on a disc of 10,000 edges, two pole pairs, at a constant speed. Edge n is at n + off[n % 4]
 * counts, which the sample does not know. */
static void edge_sample(double speed_radps, double t, double *edge_s, long *edge)
{
    static const double off[] = {-0.17, 0.03, -0.03, 0.17}; /* quadrature 0.2, duty 0.14 */
    const double        count = 2.0 * 3.14159265358979 * 2.0 / 10000.0;
    const double        at    = (t * speed_radps) / count;
    long                n     = (long)floor(at);

    if (speed_radps > 0.0) {
        n = (((double)(n + 1) + off[(((n + 1) % 4) + 4) % 4]) <= at) ? (n + 1) : n;
        n = (((double)n + off[((n % 4) + 4) % 4]) > at) ? (n - 1) : n;
    } else {
        n = (((double)n + off[((n % 4) + 4) % 4]) < at) ? (n + 1) : n;
        n = (((double)n + off[((n % 4) + 4) % 4]) < at) ? (n + 1) : n;
    }
    const double at_s = ((double)n + off[((n % 4) + 4) % 4]) * count / speed_radps;

    if ((n != *edge) && (at_s > (t - 2.0e-4))) {
        sample.omega_e_radps   = (float)((double)(n - *edge) * count / (at_s - *edge_s));
        sample.edge_gap_s      = (float)(at_s - *edge_s);
        sample.edge_age_s      = (float)(t - at_s);
        sample.edge_of_pattern = (int16_t)(1 + (((n % 16) + 16) % 16));
        *edge                  = n;
        *edge_s                = at_s;
    } else {
        sample.edge_age_s      = 0.0f;
        sample.edge_of_pattern = 0;
        sample.edge_gap_s      = (float)base_max(sample.edge_gap_s, (float)(t - *edge_s));
    }
}

/* As if whole lines were timed: quadrature and duty errors of a fifth of a count leave nothing. */
static void test_errors_of_quadrature_and_duty_have_no_effect(void)
{
    static const double speeds[] = {4.9, 23.0, 211.3, 300.0, -300.0, 523.0};

    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        double edge_s = 0.0;
        double left   = 0.0; /* largest error at the end, and that of the sample */
        double raw    = 0.0;
        long   edge   = 0;

        setUp();
        for (int k = 1; k <= 3000; k++) {
            float w = NAN;
            edge_sample(speeds[i], 2.0e-4 * k, &edge_s, &edge);
            const bool timed =
                speed_difference_update(&s, &config, &sample, TS_s, &w) == SPEED_DIFFERENCE_TIMED;
            if (timed && (k > 2500)) {
                left = fmax(left, fabs((double)w - speeds[i]));
                raw  = fmax(raw, fabs((double)sample.omega_e_radps - speeds[i]));
            }
        }
        TEST_ASSERT_TRUE(raw > 0.5);
        TEST_ASSERT_DOUBLE_WITHIN(0.02 * raw, 0.0, left);
    }
}

/* A flipped bit in the place of an edge before: never a number from beyond the pattern. */
static void test_a_place_that_does_not_exist_is_bounded(void)
{
    static const uint16_t places[] = {16U, 17U, 32768U, 65535U};

    for (int i = 0; i < SUPPORT_COUNT(places); i++) {
        for (uint16_t known = 0U; known < 4U; known++) {
            float w = NAN;

            setUp();
            for (int k = 0; k < ENCODER_FORM_EDGES; k++) {
                s.edges.offset_rad[k] = ((k % 2) == 0) ? 1.0e-4f : -1.0e-4f;
            }
            s.edges.place[0]       = places[i];
            s.edges.place[1]       = places[i];
            s.edges.known          = known;
            sample.edge_gap_s      = 2.0e-4f;
            sample.edge_age_s      = 1.0e-5f;
            sample.edge_of_pattern = 1;
            (void)speed_difference_update(&s, &config, &sample, TS_s, &w);
            TEST_ASSERT_FLOAT_WITHIN((known == 0U) ? 0.0f : 1.1f, sample.omega_e_radps, w);
        }
    }
}

static void test_check_wants_every_constant(void)
{
    speed_difference_config_t c = config;
    TEST_ASSERT_TRUE(speed_difference_check(&c, TS_s));
    c.periods = 0;
    TEST_ASSERT_FALSE(speed_difference_check(&c, TS_s));
    c.periods      = SPEED_DIFFERENCE_PERIODS_MAX + 1;
    c.inv_span_1ps = 1.0f / (TS_s * (float)c.periods);
    TEST_ASSERT_FALSE(speed_difference_check(&c, TS_s));
    c = config;
    TEST_ASSERT_FALSE(speed_difference_check(&c, 1.01f * TS_s));
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        c.inv_span_1ps = support_not_finite[k];
        TEST_ASSERT_FALSE(speed_difference_check(&c, TS_s));
        c.inv_span_1ps   = config.inv_span_1ps;
        c.edge_gap_max_s = support_not_finite[k];
        TEST_ASSERT_FALSE(speed_difference_check(&c, TS_s));
        c           = config;
        c.count_rad = support_not_finite[k];
        TEST_ASSERT_FALSE(speed_difference_check(&c, TS_s));
        c = config;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_is_the_speed_half_a_window_ago);
    RUN_TEST(test_backwards_as_forwards);
    RUN_TEST(test_it_starts_at_the_samples_speed);
    RUN_TEST(test_a_place_that_does_not_exist_is_none);
    RUN_TEST(test_edges_are_taken_while_they_are_frequent);
    RUN_TEST(test_errors_of_quadrature_and_duty_have_no_effect);
    RUN_TEST(test_a_place_that_does_not_exist_is_bounded);
    RUN_TEST(test_check_wants_every_constant);
    return UNITY_END();
}
