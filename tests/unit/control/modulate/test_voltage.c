/* SPDX-License-Identifier: MIT */
#include "voltage.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_V     2.0e-3 /* V, vectors up to 600 V; worst 3.5e-4 */
#define TOL_REACH 1.0e-6 /* relative overshoot of the reach; worst 2e-7 */
#define TOL_TURN  1.0e-6 /* rad, turn of the vector by the cut; worst 1.5e-7 */

#define CASES 5000

static const double circle_V = 295.0 / 1.7320508075688772;

static support_random_t random_state;
static dq_t             wanted_V;
static double           theta_rad;

void setUp(void)
{
    random_state.state = 17u;
}

void tearDown(void) {}

static void draw(float limit_V)
{
    theta_rad  = (double)support_uniform(&random_state, -6.28f, 6.28f);
    wanted_V.d = support_uniform(&random_state, -limit_V, limit_V);
    wanted_V.q = support_uniform(&random_state, -limit_V, limit_V);
}

static voltage_t produce(bool hexagon)
{
    return voltage_produce(wanted_V, frames_angle((float)theta_rad), 295.0f, hexagon);
}

/* How far a hexagon whose edges lie v_dc / sqrt(3) from its centre reaches in the direction of the wanted vector. */
static double hexagon_V(void)
{
    const double sixth  = 1.0471975511965976;
    const double angle  = theta_rad + atan2((double)wanted_V.q, (double)wanted_V.d);
    const double within = remainder(angle - (0.5 * sixth), sixth);
    return circle_V / cos(within);
}

static void test_what_fits_the_circle_is_produced_as_it_is(void)
{
    for (int n = 0; n < CASES; n++) {
        draw(120.0f); /* 169.7 V at most */
        for (int hexagon = 0; hexagon < 2; hexagon++) {
            const voltage_t v = produce(hexagon != 0);

            TEST_ASSERT_FALSE(v.limited);
            TEST_ASSERT_TRUE((v.v_V.d == wanted_V.d) && (v.v_V.q == wanted_V.q));
        }
    }
}

/* The phase voltages, less what all three have in common: line to line. */
static void assert_duty_produces(const voltage_t *v)
{
    const double third  = 2.0943951023931953;
    const double angle  = theta_rad + atan2((double)v->v_V.q, (double)v->v_V.d);
    const double length = support_length(v->v_V);
    const double a_V    = length * cos(angle);
    const double b_V    = length * cos(angle - third);
    const double c_V    = length * cos(angle + third);
    const abc_t  duty   = v->duty;
    const double dc_V   = 295.0;

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, a_V - b_V, dc_V * ((double)duty.a - (double)duty.b));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, b_V - c_V, dc_V * ((double)duty.b - (double)duty.c));
}

/* EQ-VOLTAGE-1 with the reach worked out from geometry. */
static void assert_cut_to_reach(bool hexagon)
{
    int limited = 0;
    for (int n = 0; n < CASES; n++) {
        draw(400.0f);
        const double length  = support_length(wanted_V);
        const double reach_V = hexagon ? hexagon_V() : circle_V;
        const double cut     = fmin(reach_V / length, 1.0);

        const voltage_t v = produce(hexagon);

        if (fabs(length - reach_V) > 0.01) {
            TEST_ASSERT_TRUE(v.limited == (length > reach_V));
        }
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, cut * (double)wanted_V.d, (double)v.v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, cut * (double)wanted_V.q, (double)v.v_V.q);
        TEST_ASSERT_TRUE(support_length(v.v_V) <= fmax(reach_V, 0.0) * (1.0 + TOL_REACH));
        assert_duty_produces(&v);
        limited += v.limited ? 1 : 0;
    }
    TEST_ASSERT_TRUE(limited > 1000);
}

static void test_circle_cuts_the_length(void)
{
    assert_cut_to_reach(false);
}

static void test_hexagon_cuts_the_length(void)
{
    assert_cut_to_reach(true);
}

static void test_cut_vector_keeps_its_direction(void)
{
    for (int n = 0; n < CASES; n++) {
        draw(2000.0f);
        for (int hexagon = 0; hexagon < 2; hexagon++) {
            const dq_t   v      = produce(hexagon != 0).v_V;
            const double before = atan2((double)wanted_V.q, (double)wanted_V.d);
            const double after  = atan2((double)v.q, (double)v.d);

            TEST_ASSERT_DOUBLE_WITHIN(TOL_TURN, 0.0, remainder(after - before, 2.0 * acos(-1.0)));
        }
    }
}

static void test_hexagon_produces_what_lies_between_it_and_the_circle(void)
{
    int between = 0;
    for (int n = 0; n < CASES; n++) {
        draw(200.0f);
        const double length = support_length(wanted_V);
        if ((length > circle_V) && (length < hexagon_V() - 0.01)) {
            const voltage_t v = produce(true);

            TEST_ASSERT_FALSE(v.limited);
            TEST_ASSERT_TRUE((v.v_V.d == wanted_V.d) && (v.v_V.q == wanted_V.q));
            between++;
        }
    }
    TEST_ASSERT_TRUE(between > 100);
}

/* At the corner the reach is 2/3 of the dc link, in the middle of an edge that of the circle. */
static void test_corner_and_edge_of_the_hexagon(void)
{
    wanted_V.d = 300.0f;
    wanted_V.q = 0.0f;
    for (int side = 0; side < 6; side++) {
        theta_rad = 1.0471975511965976 * (double)side;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 295.0 * 2.0 / 3.0, (double)produce(true).v_V.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, circle_V, (double)produce(false).v_V.d);
        theta_rad += 0.5235987755982988;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, circle_V, (double)produce(true).v_V.d);
    }
}

static void test_outside_begins_at_the_circle(void)
{
    for (int n = 0; n < CASES; n++) {
        draw(200.0f);
        const float  v_dc_V = support_uniform(&random_state, 80.0f, 400.0f);
        const double beyond = support_length(wanted_V) - ((double)v_dc_V / sqrt(3.0));
        if (fabs(beyond) > 1.0e-3) {
            TEST_ASSERT_TRUE(voltage_is_outside(wanted_V, v_dc_V) == (beyond > 0.0));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_fits_the_circle_is_produced_as_it_is);
    RUN_TEST(test_circle_cuts_the_length);
    RUN_TEST(test_hexagon_cuts_the_length);
    RUN_TEST(test_cut_vector_keeps_its_direction);
    RUN_TEST(test_hexagon_produces_what_lies_between_it_and_the_circle);
    RUN_TEST(test_corner_and_edge_of_the_hexagon);
    RUN_TEST(test_outside_begins_at_the_circle);
    return UNITY_END();
}
