/* SPDX-License-Identifier: MIT */
#include "angle_gate.h"

#include "unit_support.h"
#include "unity.h"

#define TS_s      2.0e-4f
#define COUNT_rad 1.2566371e-3f
#define GATE_rad  7.8e-3f

static const angle_gate_config_t config = {
    .gate_rad = GATE_rad, .step_rad = GATE_rad, .count_rad = COUNT_rad, .slow_e_radps2 = 2.7e4f};
static angle_gate_t gate;

void setUp(void)
{
    angle_gate_reset(&gate, 0.0f);
}

void tearDown(void) {}

/* A sample of a shaft that moves on, so that the innovation alone decides. */
static angle_gate_result_t moving(float error_rad)
{
    return angle_gate_pass(&gate, &config, gate.stood_rad + 0.06f, error_rad, 300.0f, TS_s);
}

static void assert_ignored(angle_gate_result_t r)
{
    TEST_ASSERT_TRUE((r.jump_rad == 0.0f) && (r.innovation_rad == 0.0f) && !r.used);
}

static void test_innovation_within_the_gate_passes_as_it_is(void)
{
    static const float errors[] = {0.0f, 1.0e-3f, -1.0e-3f, GATE_rad, -GATE_rad};
    for (int i = 0; i < SUPPORT_COUNT(errors); i++) {
        const angle_gate_result_t r = moving(errors[i]);
        TEST_ASSERT_TRUE(r.used && (r.innovation_rad == errors[i]) && (r.jump_rad == 0.0f) &&
                         (r.error_rad == errors[i]));
    }
    TEST_ASSERT_EQUAL_UINT16(0U, gate.ignored);
}

static void test_single_errors_are_ignored_and_counted(void)
{
    static const float errors[] = {0.05f, -0.05f, 3.0f, -3.0f, 7.9e-3f, -7.9e-3f, NAN};
    for (int i = 0; i < SUPPORT_COUNT(errors); i++) {
        assert_ignored(moving(errors[i]));
        TEST_ASSERT_TRUE(moving(1.0e-3f).used);
        TEST_ASSERT_EQUAL_UINT16(i + 1, gate.ignored);
    }
    TEST_ASSERT_EQUAL_INT(0, gate.lost);
}

static void test_count_of_ignored_samples_stays_at_its_end(void)
{
    for (uint32_t n = 0; n < 70000U; n++) {
        (void)moving(0.05f);
        (void)moving(0.0f);
    }
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, gate.ignored);
}

/* The angle takes the jump over; the speed gets what the shaft did meanwhile. */
static void test_an_error_that_stays_is_taken_over(void)
{
    for (int n = 0; n < 3; n++) {
        assert_ignored(moving(-0.05f + (1.0e-3f * (float)n)));
    }
    const angle_gate_result_t r = moving(-0.047f);

    TEST_ASSERT_TRUE(r.jump_rad == -0.05f);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-7f, 3.0e-3f, r.innovation_rad);
    TEST_ASSERT_FALSE(r.used);
    TEST_ASSERT_TRUE(moving(1.0e-3f).used);
    TEST_ASSERT_EQUAL_INT(0, gate.lost);
    TEST_ASSERT_EQUAL_UINT16(3U, gate.ignored);
}

static void test_what_is_left_of_a_jump_is_no_more_than_the_gate(void)
{
    for (int n = 0; n < 3; n++) {
        (void)moving(0.05f);
    }
    TEST_ASSERT_TRUE(moving(0.05f + (1.9f * GATE_rad)).innovation_rad == GATE_rad);
}

/* Across the turn: +pi - a and -pi + a are near to each other. */
static void test_a_jump_of_half_a_turn_is_one_jump(void)
{
    for (int n = 0; n < 3; n++) {
        (void)moving(3.14f);
    }
    const angle_gate_result_t r = moving(-3.14f);
    TEST_ASSERT_TRUE(r.jump_rad == 3.14f);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 2.0f * (BASE_PI - 3.14f), r.innovation_rad);
}

static void test_an_error_that_grows_is_a_lost_angle(void)
{
    for (int n = 1; n <= 4; n++) {
        TEST_ASSERT_EQUAL_INT(0, gate.lost);
        assert_ignored(moving(0.012f * (float)n));
    }
    TEST_ASSERT_EQUAL_INT(1, gate.lost);
    assert_ignored(moving(0.0f)); /* until the next run */
    angle_gate_reset(&gate, 1.0f);
    TEST_ASSERT_EQUAL_INT(0, gate.lost);
}

/* Periods until a shaft at this speed, whose angle stays within a count, is lost; 0: never. */
static int periods_until_lost(double omega, float toggle_rad)
{
    angle_gate_reset(&gate, 1.0f);
    (void)angle_gate_pass(&gate, &config, 2.0f, 0.0f, (float)omega, TS_s);
    for (int n = 1; n <= 100; n++) {
        const float theta_rad = 2.0f + ((n % 2 == 0) ? toggle_rad : 0.0f);
        (void)angle_gate_pass(&gate, &config, theta_rad, 0.0f, 0.0f, TS_s);
        if (gate.lost != 0) {
            return n;
        }
    }
    return 0;
}

/* EQ-ANGLE-GATE-2 in double. */
static int wanted_periods(double omega)
{
    double turned = 0.0;
    for (int n = 1; n <= 100; n++) {
        turned += fmax(fabs(omega) - (n * 2.7e4 * 2.0e-4), 0.0) * 2.0e-4;
        if ((n >= 3) && (turned > (3.5 * 1.2566371e-3))) {
            return n;
        }
    }
    return 0;
}

static void test_an_angle_that_stands_too_soon_is_lost(void)
{
    for (int w = -1500; w <= 1500; w++) {
        const double omega = (double)w + 0.37;
        TEST_ASSERT_EQUAL_INT(wanted_periods(omega), periods_until_lost(omega, 0.0f));
        TEST_ASSERT_EQUAL_INT(wanted_periods(omega), periods_until_lost(omega, COUNT_rad));
        TEST_ASSERT_EQUAL_INT(wanted_periods(omega), periods_until_lost(omega, -COUNT_rad));
    }
    TEST_ASSERT_EQUAL_INT(0, wanted_periods(14.0));
    TEST_ASSERT_NOT_EQUAL_INT(0, wanted_periods(20.0));
}

/* The hardest stop that a load can cause, and a crawl: the angle is believed. */
static void test_a_shaft_that_a_load_stops_is_not_lost(void)
{
    static const double speeds[] = {1500.0, -300.0, 60.0, 14.0, 3.0, -0.5};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        double w     = speeds[i];
        double theta = 0.3;
        angle_gate_reset(&gate, 0.3f);
        for (int n = 0; n < 3000; n++) {
            const double count = floor(theta / 1.2566371e-3) + 0.5;
            (void)angle_gate_pass(&gate, &config, (float)remainder(count * 1.2566371e-3, 6.2831853),
                                  0.0f, (float)w, TS_s);
            TEST_ASSERT_EQUAL_INT(0, gate.lost);
            if (n > 1000) {
                w = copysign(fmax(fabs(w) - (2.7e4 * 2.0e-4), 0.0), w);
            }
            theta += w * 2.0e-4;
        }
    }
}

/* EQ-ANGLE-GATE-4 */
static void test_no_more_is_used_than_a_load_causes(void)
{
    angle_gate_config_t c = config;
    c.step_rad            = 1.7e-3f;
    for (int n = -40; n <= 40; n++) {
        const float               error = 0.024f * GATE_rad * (float)n;
        const angle_gate_result_t r =
            angle_gate_pass(&gate, &c, gate.stood_rad + 0.06f, error, 300.0f, TS_s);
        TEST_ASSERT_TRUE(r.used);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-9f, fmaxf(fminf(error, 1.7e-3f), -1.7e-3f), r.innovation_rad);
    }
    c.step_rad = 1.1f * GATE_rad; /* beyond the gate there is nothing to use */
    TEST_ASSERT_FALSE(angle_gate_check(&c));
}

static void test_constants_out_of_range_are_refused(void)
{
    angle_gate_config_t c        = config;
    float *const        fields[] = {&c.gate_rad, &c.step_rad, &c.count_rad, &c.slow_e_radps2};
    const float         bad[]    = {NAN, INFINITY, -INFINITY, 0.0f, -1.0f, 1.0e13f};
    TEST_ASSERT_TRUE(angle_gate_check(&c));
    for (int i = 0; i < SUPPORT_COUNT(fields) * SUPPORT_COUNT(bad); i++) {
        const float good                = *fields[i / SUPPORT_COUNT(bad)];
        *fields[i / SUPPORT_COUNT(bad)] = bad[i % SUPPORT_COUNT(bad)];
        TEST_ASSERT_FALSE(angle_gate_check(&c));
        *fields[i / SUPPORT_COUNT(bad)] = good;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_innovation_within_the_gate_passes_as_it_is);
    RUN_TEST(test_single_errors_are_ignored_and_counted);
    RUN_TEST(test_count_of_ignored_samples_stays_at_its_end);
    RUN_TEST(test_an_error_that_stays_is_taken_over);
    RUN_TEST(test_what_is_left_of_a_jump_is_no_more_than_the_gate);
    RUN_TEST(test_a_jump_of_half_a_turn_is_one_jump);
    RUN_TEST(test_an_error_that_grows_is_a_lost_angle);
    RUN_TEST(test_an_angle_that_stands_too_soon_is_lost);
    RUN_TEST(test_a_shaft_that_a_load_stops_is_not_lost);
    RUN_TEST(test_no_more_is_used_than_a_load_causes);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
