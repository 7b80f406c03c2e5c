/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_V      1.5e-3 /* V, vectors up to 500 V, steep roots near a tangent included; worst 2.9e-4 */
#define TOL_CIRCLE 9.0e-7 /* relative overshoot of the circle; worst 1.7e-7 */
#define TOL_DIRECTION                                                                              \
    7.0e-5 /* V off the line through hold and v, or off the expected vector; worst 1.5e-5 */

#define CASES  2000
#define SEARCH 100 /* steps */

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

static double complex at(dq_t v_V, dq_t hold_V, double s)
{
    const double complex hold = support_complex((double)hold_V.d, (double)hold_V.q);
    const double complex v    = support_complex((double)v_V.d, (double)v_V.q);
    return hold + (s * (v - hold));
}

/* Oracle for EQ-VOLTAGE-1, by search over s: narrows 0 .. 1 around the shortest vector; if that fits,
 * bisects between it and the wanted voltage; if not, scales it. */
static double complex oracle_V(dq_t v_V, dq_t hold_V, double v_max_V)
{
    double lo = 0.0;
    double hi = 1.0;
    for (int n = 0; n < SEARCH; n++) {
        const double left  = lo + ((hi - lo) / 3.0);
        const double right = hi - ((hi - lo) / 3.0);
        if (cabs(at(v_V, hold_V, left)) < cabs(at(v_V, hold_V, right))) {
            hi = right;
        } else {
            lo = left;
        }
    }
    const double complex shortest = at(v_V, hold_V, 0.5 * (lo + hi));
    if (cabs(shortest) > v_max_V) {
        return shortest * (v_max_V / cabs(shortest));
    }

    double fits  = 0.5 * (lo + hi);
    double fails = 1.0;
    for (int n = 0; n < SEARCH; n++) {
        const double middle = 0.5 * (fits + fails);
        if (cabs(at(v_V, hold_V, middle)) <= v_max_V) {
            fits = middle;
        } else {
            fails = middle;
        }
    }
    return at(v_V, hold_V, fits);
}

static void assert_matches_oracle(dq_t v_V, dq_t hold_V, float v_max_V)
{
    const double complex expected = oracle_V(v_V, hold_V, (double)v_max_V);

    const voltage_limited_t out = voltage_limit(v_V, hold_V, v_max_V);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, creal(expected), (double)out.v_V.d);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, cimag(expected), (double)out.v_V.q);
}

static void test_voltage_inside_the_circle_is_untouched(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t v_V    = random_vector(70.0f); /* up to 99 V */
        const dq_t hold_V = random_vector(300.0f);

        const voltage_limited_t out = voltage_limit(v_V, hold_V, 100.0f);

        TEST_ASSERT_FALSE(out.limited);
        TEST_ASSERT_TRUE((out.v_V.d == v_V.d) && (out.v_V.q == v_V.q)); /* exact by design */
    }
}

static void test_voltage_on_the_circle_is_untouched(void)
{
    const dq_t v_V    = {.d = -60.0f, .q = 80.0f};
    const dq_t hold_V = {.d = 0.0f, .q = 50.0f};

    const voltage_limited_t out = voltage_limit(v_V, hold_V, 100.0f);

    TEST_ASSERT_FALSE(out.limited);
    TEST_ASSERT_TRUE((out.v_V.d == -60.0f) && (out.v_V.q == 80.0f));
}

static void test_voltage_beyond_the_circle_is_reported(void)
{
    const dq_t v_V    = {.d = -60.0f, .q = 80.01f};
    const dq_t hold_V = {.d = 0.0f, .q = 50.0f};

    const voltage_limited_t out = voltage_limit(v_V, hold_V, 100.0f);

    TEST_ASSERT_TRUE(out.limited);
}

static void test_limit_matches_search_with_hold_inside(void)
{
    for (int n = 0; n < CASES; n++) {
        assert_matches_oracle(random_vector(500.0f), random_vector(70.0f), 100.0f);
    }
}

static void test_limit_matches_search_with_hold_anywhere(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t hold_V = random_vector(200.0f);
        assert_matches_oracle(random_vector(300.0f), hold_V,
                              support_uniform(&random_state, 50.0f, 200.0f));
    }
}

/* From just inside the circle to just outside, down to steps of a millivolt. */
static void test_limit_matches_search_for_small_changes_across_the_circle(void)
{
    for (int n = 0; n < CASES; n++) {
        const double angle  = (double)support_uniform(&random_state, -3.14f, 3.14f);
        const double step   = pow(10.0, (double)support_uniform(&random_state, -3.0f, 0.0f));
        const double start  = 100.0 - (0.3 * step);
        const double end    = 100.0 + (0.7 * step);
        const dq_t   hold_V = {.d = (float)(start * cos(angle)), .q = (float)(start * sin(angle))};
        const dq_t   v_V    = {.d = (float)(end * cos(angle)), .q = (float)(end * sin(angle))};

        assert_matches_oracle(v_V, hold_V, 100.0f);
    }
}

static void test_no_voltage_wanted_is_untouched(void)
{
    const dq_t zero   = {0.0f, 0.0f};
    const dq_t hold_V = {.d = -120.0f, .q = 160.0f};

    const voltage_limited_t out = voltage_limit(zero, hold_V, 100.0f);

    TEST_ASSERT_TRUE(!out.limited && (out.v_V.d == 0.0f) && (out.v_V.q == 0.0f));
}

static void test_result_never_leaves_the_circle(void)
{
    for (int n = 0; n < 20 * CASES; n++) {
        const dq_t  v_V     = random_vector(2000.0f);
        const dq_t  hold_V  = random_vector(400.0f);
        const float v_max_V = support_uniform(&random_state, 1.0f, 230.0f);

        const voltage_limited_t out = voltage_limit(v_V, hold_V, v_max_V);

        const double beyond = (support_length(out.v_V) / (double)v_max_V) - 1.0;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_CIRCLE, 0.0, fmax(beyond, 0.0));
    }
}

static void test_direction_of_the_change_is_kept(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t           v_V    = random_vector(500.0f);
        const dq_t           hold_V = random_vector(70.0f); /* inside: always room */
        const double complex change = at(v_V, hold_V, 1.0) - at(v_V, hold_V, 0.0);

        const voltage_limited_t out = voltage_limit(v_V, hold_V, 100.0f);

        const double complex got   = support_complex((double)out.v_V.d, (double)out.v_V.q);
        const double complex along = (got - at(v_V, hold_V, 0.0)) * conj(change) / cabs(change);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DIRECTION, 0.0, cimag(along));
        TEST_ASSERT_TRUE(creal(along) >= -TOL_DIRECTION);
    }
}

static void test_wanted_voltage_equal_to_hold_is_scaled_into_the_circle(void)
{
    const dq_t hold_V = {.d = -120.0f, .q = 160.0f};

    const voltage_limited_t out = voltage_limit(hold_V, hold_V, 100.0f);

    TEST_ASSERT_TRUE(out.limited);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_DIRECTION, -60.0, (double)out.v_V.d);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_DIRECTION, 80.0, (double)out.v_V.q);
}

static void test_line_that_misses_the_circle_gives_the_direction_of_its_nearest_point(void)
{
    const dq_t hold_V = {.d = -100.0f, .q = 200.0f};
    const dq_t v_V    = {.d = 100.0f, .q = 200.0f};

    const voltage_limited_t out = voltage_limit(v_V, hold_V, 100.0f);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_DIRECTION, 0.0, (double)out.v_V.d);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_DIRECTION, 100.0, (double)out.v_V.q);
}

static void test_limit_is_the_same_for_swapped_axes_and_signs(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t v_V           = random_vector(300.0f);
        const dq_t hold_V        = random_vector(150.0f);
        const dq_t turned_V      = {.d = -v_V.q, .q = v_V.d}; /* a quarter turn, exact in floats */
        const dq_t turned_hold_V = {.d = -hold_V.q, .q = hold_V.d};

        const voltage_limited_t out    = voltage_limit(v_V, hold_V, 100.0f);
        const voltage_limited_t turned = voltage_limit(turned_V, turned_hold_V, 100.0f);

        TEST_ASSERT_TRUE(turned.limited == out.limited);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, -(double)out.v_V.q, (double)turned.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (double)out.v_V.d, (double)turned.v_V.q);
    }
}

static void test_no_voltage_at_all_gives_zero(void)
{
    for (int n = 0; n < CASES; n++) {
        const dq_t v_V    = random_vector(300.0f);
        const dq_t hold_V = random_vector(150.0f);

        const voltage_limited_t out = voltage_limit(v_V, hold_V, 0.0f);

        TEST_ASSERT_TRUE((out.v_V.d == 0.0f) && (out.v_V.q == 0.0f) && out.limited);
    }
}

static void test_bad_number_never_looks_like_a_voltage_inside_the_circle(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        const dq_t bad[]  = {{.d = support_not_finite[i], .q = 1.0f},
                             {.d = 1.0f, .q = support_not_finite[i]}};
        const dq_t hold_V = {.d = 0.0f, .q = 50.0f};
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            const voltage_limited_t out = voltage_limit(bad[k], hold_V, 100.0f);

            TEST_ASSERT_TRUE(out.limited);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_voltage_inside_the_circle_is_untouched);
    RUN_TEST(test_voltage_on_the_circle_is_untouched);
    RUN_TEST(test_voltage_beyond_the_circle_is_reported);
    RUN_TEST(test_limit_matches_search_with_hold_inside);
    RUN_TEST(test_limit_matches_search_with_hold_anywhere);
    RUN_TEST(test_limit_matches_search_for_small_changes_across_the_circle);
    RUN_TEST(test_no_voltage_wanted_is_untouched);
    RUN_TEST(test_result_never_leaves_the_circle);
    RUN_TEST(test_direction_of_the_change_is_kept);
    RUN_TEST(test_wanted_voltage_equal_to_hold_is_scaled_into_the_circle);
    RUN_TEST(test_line_that_misses_the_circle_gives_the_direction_of_its_nearest_point);
    RUN_TEST(test_limit_is_the_same_for_swapped_axes_and_signs);
    RUN_TEST(test_no_voltage_at_all_gives_zero);
    RUN_TEST(test_bad_number_never_looks_like_a_voltage_inside_the_circle);
    return UNITY_END();
}
