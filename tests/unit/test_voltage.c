/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_V      1.0e-3 /* V, circles up to 230 V, legs near zero included */
#define TOL_V2     1.2e-2 /* V^2, circle of 1e4 V^2 */
#define TOL_CIRCLE 9.0e-7 /* relative overshoot of the circle */

#define TOL_MAKE_V2 1.8e-1 /* V^2, up to 4e4 V^2: a root of a small difference; worst 0.035 */
#define CIRCLE_V    (295.0 / 1.7320508075688772)

#define CASES  5000
#define SEARCH 60 /* halvings */

static support_random_t random_state;

void setUp(void)
{
    random_state.state = 17u;
}

void tearDown(void) {}

static dq_t random_vector(float limit_V)
{
    dq_t v_V;
    v_V.d = support_uniform(&random_state, -limit_V, limit_V);
    v_V.q = support_uniform(&random_state, -limit_V, limit_V);
    return v_V;
}

/* The largest share of `wanted` that fits the circle beside `other`, by halving. */
static double fitting_part(double wanted, double other, double v_max_V)
{
    double fits  = 0.0;
    double fails = 1.0;
    if (hypot(wanted, other) <= v_max_V) {
        return wanted;
    }
    for (int n = 0; n < SEARCH; n++) {
        const double middle = 0.5 * (fits + fails);
        if (hypot(middle * wanted, other) <= v_max_V) {
            fits = middle;
        } else {
            fails = middle;
        }
    }
    return fits * wanted;
}

/* Oracle: the q axis reserves what the rule lets it keep, the d axis takes what fits beside that, the q axis
 * what fits beside the d axis. */
static double complex oracle_V(dq_t v_V, double hold_q_V, double v_max_V)
{
    const double keep_V =
        fmin(fmin(0.9 * fabs(hold_q_V), 0.9 * v_max_V), fabs((double)v_V.q)); /* reserved */
    if (support_length(v_V) <= v_max_V) {
        return support_complex((double)v_V.d, (double)v_V.q);
    }
    const double d_V = fitting_part((double)v_V.d, keep_V, v_max_V);
    return support_complex(d_V, fitting_part((double)v_V.q, d_V, v_max_V));
}

static void assert_matches_oracle(dq_t v_V, float hold_q_V, float v_max_V)
{
    const double complex expected = oracle_V(v_V, (double)hold_q_V, (double)v_max_V);

    const dq_t out = voltage_limit(v_V, hold_q_V, v_max_V);

    /* a leg near zero is the root of a small difference of squares */
    const double square    = 6.0e-7 * (double)v_max_V * (double)v_max_V;
    const double tolerance = TOL_V + fmin(square / fabs(cimag(expected)), sqrt(square));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, creal(expected), (double)out.d);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, cimag(expected), (double)out.q);
}

static void test_voltage_inside_the_circle_is_untouched(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t  v_V      = random_vector(70.0f); /* up to 99 V */
        const float hold_q_V = support_uniform(&random_state, -300.0f, 300.0f);

        const dq_t out = voltage_limit(v_V, hold_q_V, 100.0f);

        TEST_ASSERT_TRUE((out.d == v_V.d) && (out.q == v_V.q)); /* exact by design */
    }
}

static void test_voltage_on_the_circle_is_untouched(void)
{
    const dq_t v_V = {.d = -60.0f, .q = 80.0f};

    const dq_t out = voltage_limit(v_V, 50.0f, 100.0f);

    TEST_ASSERT_TRUE((out.d == -60.0f) && (out.q == 80.0f));
}

static void test_limit_matches_search_with_hold_inside(void)
{
    for (int n = 0; n < CASES; n++) {
        assert_matches_oracle(random_vector(500.0f),
                              support_uniform(&random_state, -100.0f, 100.0f), 100.0f);
    }
}

static void test_limit_matches_search_with_hold_anywhere(void)
{
    for (int n = 0; n < CASES; n++) {
        const float hold_q_V = support_uniform(&random_state, -300.0f, 300.0f);
        assert_matches_oracle(random_vector(300.0f), hold_q_V,
                              support_uniform(&random_state, 50.0f, 200.0f));
    }
}

static void test_result_never_leaves_the_circle(void)
{
    for (int n = 0; n < 20 * CASES; n++) {
        const dq_t  v_V      = random_vector(2000.0f);
        const float hold_q_V = support_uniform(&random_state, -400.0f, 400.0f);
        const float v_max_V  = support_uniform(&random_state, 1.0f, 230.0f);

        const dq_t out = voltage_limit(v_V, hold_q_V, v_max_V);

        const double beyond = (support_length(out) / (double)v_max_V) - 1.0;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_CIRCLE, 0.0, fmax(beyond, 0.0));
    }
}

/* A limit takes away from each axis; it never adds, and never turns one round. */
static void test_no_axis_grows_or_changes_sign(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t  v_V      = random_vector(500.0f);
        const float hold_q_V = support_uniform(&random_state, -300.0f, 300.0f);

        const dq_t out = voltage_limit(v_V, hold_q_V, 100.0f);

        TEST_ASSERT_TRUE((fabsf(out.d) <= fabsf(v_V.d)) && (fabsf(out.q) <= fabsf(v_V.q)));
        TEST_ASSERT_TRUE((out.d * v_V.d >= 0.0f) && (out.q * v_V.q >= 0.0f));
    }
}

static void test_q_axis_keeps_most_of_what_holds_its_current(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t   v_V      = random_vector(1000.0f);
        const float  hold_q_V = support_uniform(&random_state, -300.0f, 300.0f);
        const double keep_V = fmin(0.9 * fmin(fabs((double)hold_q_V), 100.0), fabs((double)v_V.q));

        const dq_t out = voltage_limit(v_V, hold_q_V, 100.0f);

        /* squares, because a leg near zero is the root of a small difference */
        const double q_V = (double)out.q;
        TEST_ASSERT_TRUE(q_V * q_V >= (keep_V * keep_V) - TOL_V2);
    }
}

static void test_d_axis_gets_its_wish_beside_what_the_q_axis_keeps(void)
{
    int granted = 0;
    for (int n = 0; n < CASES; n++) {
        const dq_t   v_V      = random_vector(200.0f);
        const float  hold_q_V = support_uniform(&random_state, -150.0f, 150.0f);
        const double keep_V = fmin(0.9 * fmin(fabs((double)hold_q_V), 100.0), fabs((double)v_V.q));

        const dq_t out = voltage_limit(v_V, hold_q_V, 100.0f);

        if (hypot((double)v_V.d, keep_V) < 99.99) {
            TEST_ASSERT_TRUE(out.d == v_V.d); /* exact by design */
            granted++;
        } else {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V, sqrt(1.0e4 - (keep_V * keep_V)),
                                      fmin(fabs((double)v_V.d), fabs((double)out.d)));
        }
    }
    TEST_ASSERT_TRUE(granted > 1000);
}

/* What is limited is not wasted: the result lies on the circle. */
static void test_limited_voltage_uses_the_whole_circle(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t  v_V      = random_vector(500.0f);
        const float hold_q_V = support_uniform(&random_state, -300.0f, 300.0f);

        const dq_t out = voltage_limit(v_V, hold_q_V, 100.0f);

        if (support_length(v_V) > 100.0) {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 100.0, support_length(out));
        }
    }
}

/* From just inside the circle to just outside: no jump. */
static void test_limit_begins_without_a_jump(void)
{
    for (int n = 0; n < CASES; n++) {
        const double angle    = (double)support_uniform(&random_state, -3.14f, 3.14f);
        const float  hold_q_V = support_uniform(&random_state, -300.0f, 300.0f);
        const double step     = pow(10.0, (double)support_uniform(&random_state, -3.0f, -1.0f));
        const dq_t   v_V      = {.d = (float)((100.0 + step) * cos(angle)),
                                 .q = (float)((100.0 + step) * sin(angle))};
        const double weak     = fmin(fabs(cos(angle)), fabs(sin(angle)));

        const dq_t out = voltage_limit(v_V, hold_q_V, 100.0f);

        if (weak > 0.05) {
            TEST_ASSERT_DOUBLE_WITHIN(30.0 * step, (double)v_V.d, (double)out.d);
            TEST_ASSERT_DOUBLE_WITHIN(30.0 * step, (double)v_V.q, (double)out.q);
        }
    }
}

static void test_no_voltage_wanted_is_untouched(void)
{
    const dq_t zero = {0.0f, 0.0f};

    const dq_t out = voltage_limit(zero, 160.0f, 100.0f);

    TEST_ASSERT_TRUE((out.d == 0.0f) && (out.q == 0.0f));
}

static void test_worked_examples(void)
{
    const dq_t both_V   = {.d = -300.0f, .q = 300.0f};
    const dq_t only_d_V = {.d = -300.0f, .q = 0.0f};
    const dq_t only_q_V = {.d = 0.0f, .q = -300.0f};

    const dq_t held  = voltage_limit(both_V, 200.0f / 3.0f, 100.0f); /* keeps 60 V */
    const dq_t rest  = voltage_limit(both_V, 0.0f, 100.0f);
    const dq_t d     = voltage_limit(only_d_V, 90.0f, 100.0f);
    const dq_t q     = voltage_limit(only_q_V, 0.0f, 100.0f);
    const dq_t above = voltage_limit(both_V, 400.0f, 100.0f); /* keeps 90 V */

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, -80.0, (double)held.d);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 60.0, (double)held.q);
    TEST_ASSERT_TRUE((rest.d == -100.0f) && (rest.q == 0.0f));
    TEST_ASSERT_TRUE((d.d == -100.0f) && (d.q == 0.0f));
    TEST_ASSERT_TRUE((q.d == 0.0f) && (q.q == -100.0f));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 90.0, (double)above.q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, -sqrt(1900.0), (double)above.d);
}

static void test_signs_of_the_axes_and_of_the_hold_do_not_matter(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t  v_V      = random_vector(300.0f);
        const dq_t  q_V      = {.d = v_V.d, .q = -v_V.q};
        const dq_t  d_V      = {.d = -v_V.d, .q = v_V.q};
        const float hold_q_V = support_uniform(&random_state, -150.0f, 150.0f);

        const dq_t out      = voltage_limit(v_V, hold_q_V, 100.0f);
        const dq_t of_q     = voltage_limit(q_V, -hold_q_V, 100.0f);
        const dq_t of_d     = voltage_limit(d_V, hold_q_V, 100.0f);
        const dq_t other_ho = voltage_limit(v_V, -hold_q_V, 100.0f);

        TEST_ASSERT_TRUE((of_q.d == out.d) && (of_q.q == -out.q));
        TEST_ASSERT_TRUE((of_d.d == -out.d) && (of_d.q == out.q));
        TEST_ASSERT_TRUE((other_ho.d == out.d) && (other_ho.q == out.q));
    }
}

static void test_no_voltage_at_all_gives_zero(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t  v_V      = random_vector(300.0f);
        const float hold_q_V = support_uniform(&random_state, -150.0f, 150.0f);

        const dq_t out = voltage_limit(v_V, hold_q_V, 0.0f);

        TEST_ASSERT_TRUE((out.d == 0.0f) && (out.q == 0.0f));
    }
}

static void test_bad_number_never_leaves_the_circle(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        const dq_t bad[] = {{.d = support_not_finite[i], .q = 1.0f},
                            {.d = 1.0f, .q = support_not_finite[i]}};
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            const dq_t out = voltage_limit(bad[k], 50.0f, 100.0f);

            TEST_ASSERT_TRUE(support_length(out) <= 100.0 * (1.0 + TOL_CIRCLE));
        }
    }
}

/* voltage_produce() on the shipped motor: what of a wanted voltage the modulator can make. */
static drive_config_t config;
static law_output_t   wanted;
static double         theta_rad;

static void draw_wanted(float limit_V)
{
    config     = gain_tables_drive;
    theta_rad  = (double)support_uniform(&random_state, -6.28f, 6.28f);
    wanted.v_V = random_vector(limit_V);
    wanted.now = support_random_meas(&random_state);
    wanted.d_q = support_uniform(&random_state, -200.0f, 200.0f);
}

static voltage_t produce(bool hexagon)
{
    config.overmodulation = hexagon;
    return voltage_produce(&config, &wanted, frames_angle((float)theta_rad), 295.0f);
}

/* The q voltage under which the q current of (4) stands still. */
static float hold_q_V(void)
{
    const nodo_meas_t *y = &wanted.now;
    const double       w = (double)y->omega_e_radps;
    return (float)((2.48 * (double)y->iq_A) + (w * (0.193 + (0.07498 * (double)y->id_A))) -
                   (0.11391 * (double)wanted.d_q));
}

/* How far a hexagon whose edges lie v_dc / sqrt(3) from its centre reaches in the direction of a vector. */
static double hexagon_V(dq_t v_V)
{
    const double sixth  = 1.0471975511965976;
    const double angle  = theta_rad + atan2((double)v_V.q, (double)v_V.d);
    const double within = remainder(angle - (0.5 * sixth), sixth);
    return CIRCLE_V / cos(within);
}

static void test_what_fits_the_circle_is_produced_as_it_is(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_wanted(120.0f); /* 169.7 V at most */
        for (int hexagon = 0; hexagon < 2; hexagon++) {
            const voltage_t v = produce(hexagon != 0);

            TEST_ASSERT_FALSE(v.limited);
            TEST_ASSERT_TRUE((v.v_V.d == wanted.v_V.d) && (v.v_V.q == wanted.v_V.q));
        }
    }
}

static void test_circle_limits_beside_the_voltage_that_holds_the_current(void)
{
    int limited = 0;
    for (int n = 0; n < CASES; n++) {
        draw_wanted(400.0f);
        const double         length = support_length(wanted.v_V);
        const double complex want   = oracle_V(wanted.v_V, (double)hold_q_V(), CIRCLE_V);

        const voltage_t v = produce(false);

        if (fabs(length - CIRCLE_V) > 0.01) {
            TEST_ASSERT_TRUE(v.limited == (length > CIRCLE_V));
        }
        TEST_ASSERT_DOUBLE_WITHIN(TOL_MAKE_V2, creal(want) * creal(want),
                                  (double)v.v_V.d * (double)v.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_MAKE_V2, cimag(want) * cimag(want),
                                  (double)v.v_V.q * (double)v.v_V.q);
        TEST_ASSERT_TRUE((v.v_V.d * wanted.v_V.d >= 0.0f) && (v.v_V.q * wanted.v_V.q >= 0.0f));
        limited += v.limited ? 1 : 0;
    }
    TEST_ASSERT_TRUE(limited > 1000);
}

static void test_hexagon_produces_what_lies_between_it_and_the_circle(void)
{
    int between = 0;
    for (int n = 0; n < CASES; n++) {
        draw_wanted(200.0f);
        const double length = support_length(wanted.v_V);
        if ((length > CIRCLE_V) && (length < hexagon_V(wanted.v_V) - 0.01)) {
            const voltage_t v = produce(true);

            TEST_ASSERT_FALSE(v.limited);
            TEST_ASSERT_TRUE((v.v_V.d == wanted.v_V.d) && (v.v_V.q == wanted.v_V.q));
            between++;
        }
    }
    TEST_ASSERT_TRUE(between > 100);
}

/* The rule of the circle with the hexagon's reach, then cut to the reach of where it has turned to. */
static void test_hexagon_limits_beside_the_voltage_that_holds_the_current(void)
{
    int turned = 0;
    for (int n = 0; n < CASES; n++) {
        draw_wanted(400.0f);
        const double reach_V = hexagon_V(wanted.v_V);
        if (support_length(wanted.v_V) < reach_V + 0.01) {
            continue;
        }
        const double complex ruled = oracle_V(wanted.v_V, (double)hold_q_V(), reach_V);
        const dq_t           there = {.d = (float)creal(ruled), .q = (float)cimag(ruled)};
        const double         cut   = fmin(hexagon_V(there) / cabs(ruled), 1.0);
        const double complex want  = cut * ruled;

        const voltage_t v = produce(true);

        TEST_ASSERT_TRUE(v.limited);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_MAKE_V2, creal(want) * creal(want),
                                  (double)v.v_V.d * (double)v.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_MAKE_V2, cimag(want) * cimag(want),
                                  (double)v.v_V.q * (double)v.v_V.q);
        TEST_ASSERT_TRUE(support_length(v.v_V) <= hexagon_V(v.v_V) * (1.0 + TOL_CIRCLE));
        turned += (cut < 0.99) ? 1 : 0;
    }
    TEST_ASSERT_TRUE(turned > 100);
}

/* At the corner the reach is 2/3 of the dc link, in the middle of an edge that of the circle. */
static void test_corner_and_edge_of_the_hexagon(void)
{
    const dq_t far_V = {.d = 300.0f, .q = 0.0f};

    draw_wanted(1.0f);
    wanted.v_V = far_V;
    for (int side = 0; side < 6; side++) {
        theta_rad = 1.0471975511965976 * (double)side;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 295.0 * 2.0 / 3.0, (double)produce(true).v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, CIRCLE_V, (double)produce(false).v_V.d);
        theta_rad += 0.5 * 1.0471975511965976;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, CIRCLE_V, (double)produce(true).v_V.d);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_voltage_inside_the_circle_is_untouched);
    RUN_TEST(test_voltage_on_the_circle_is_untouched);
    RUN_TEST(test_limit_matches_search_with_hold_inside);
    RUN_TEST(test_limit_matches_search_with_hold_anywhere);
    RUN_TEST(test_result_never_leaves_the_circle);
    RUN_TEST(test_no_axis_grows_or_changes_sign);
    RUN_TEST(test_q_axis_keeps_most_of_what_holds_its_current);
    RUN_TEST(test_d_axis_gets_its_wish_beside_what_the_q_axis_keeps);
    RUN_TEST(test_limited_voltage_uses_the_whole_circle);
    RUN_TEST(test_limit_begins_without_a_jump);
    RUN_TEST(test_no_voltage_wanted_is_untouched);
    RUN_TEST(test_worked_examples);
    RUN_TEST(test_signs_of_the_axes_and_of_the_hold_do_not_matter);
    RUN_TEST(test_no_voltage_at_all_gives_zero);
    RUN_TEST(test_bad_number_never_leaves_the_circle);
    RUN_TEST(test_what_fits_the_circle_is_produced_as_it_is);
    RUN_TEST(test_circle_limits_beside_the_voltage_that_holds_the_current);
    RUN_TEST(test_hexagon_produces_what_lies_between_it_and_the_circle);
    RUN_TEST(test_hexagon_limits_beside_the_voltage_that_holds_the_current);
    RUN_TEST(test_corner_and_edge_of_the_hexagon);
    return UNITY_END();
}
