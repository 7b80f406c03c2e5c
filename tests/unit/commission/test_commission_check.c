/* SPDX-License-Identifier: MIT */
#include "commission_check.h"

#include "held_winding.h"
#include "unit_support.h"
#include "unity.h"

#define TS_s    2.0e-4
#define BOUND_A 9.0

static commission_config_t     config;
static commission_check_t      check;
static commission_admittance_t found;
static held_winding_t          winding;
static double                  peak_A;
static int                     dies_tick; /* of both sensors */

void setUp(void)
{
    const commission_config_t c = {.ts_s = (float)TS_s, .current_max_A = (float)BOUND_A};
    const held_winding_t      w = {.ts_s = TS_s, .r_Ohm = 3.6, .ld_H = 0.036, .lq_H = 0.051};
    config                      = c;
    winding                     = w;
    peak_A                      = 0.0;
    dies_tick                   = INT16_MAX;
    commission_check_start(&check);
}

void tearDown(void) {}

/* Readings of two sensors with these gains. */
static ab_t sensed(ab_t i_A, double gain_a, double gain_b)
{
    const double a   = gain_a * (double)i_A.alpha;
    const double b   = gain_b * ((0.5 * sqrt(3.0) * (double)i_A.beta) - (0.5 * (double)i_A.alpha));
    const ab_t   out = {(float)a, (float)((a + (2.0 * b)) / sqrt(3.0))};
    return out;
}

static commission_step_t run(double gain_a, double gain_b)
{
    ab_t asked_V  = {0.0f, 0.0f};
    ab_t before_A = {0.0f, 0.0f};
    for (int k = 0; k < 2000; k++) {
        commission_signal_t s = winding_step(&winding, asked_V);
        peak_A                = fmax(peak_A, hypot(winding.id_A, winding.iq_A));
        s.i_A        = (k < dies_tick) ? sensed(s.i_A, gain_a, gain_b) : sensed(s.i_A, 0.0, 0.0);
        s.di_A.alpha = s.i_A.alpha - before_A.alpha;
        s.di_A.beta  = s.i_A.beta - before_A.beta;
        before_A     = s.i_A;
        const commission_answer_t out = commission_check_tick(&check, &config, &s, &found);
        asked_V                       = out.v_V;
        if (out.step != COMMISSION_BUSY) {
            return out.step;
        }
    }
    return COMMISSION_BUSY;
}

static void expect(commission_step_t step, double gain_a, double gain_b)
{
    for (double angle = -3.0; angle < 3.0; angle += 0.37) {
        setUp();
        winding.angle_rad = angle;
        winding.loss_V    = 1.0;
        TEST_ASSERT_EQUAL_INT(step, run(gain_a, gain_b));
        TEST_ASSERT_TRUE(peak_A < (0.3 * BOUND_A));
    }
}

static void test_a_healthy_winding_passes_at_any_angle(void)
{
    expect(COMMISSION_DONE, 1.0, 1.0);
    expect(COMMISSION_DONE, 1.05, 0.95);
}

static void test_a_dead_or_reversed_sensor_fails(void)
{
    expect(COMMISSION_FAILED, 0.0, 1.0);
    expect(COMMISSION_FAILED, 1.0, 0.0);
    expect(COMMISSION_FAILED, -1.0, 1.0);
    expect(COMMISSION_FAILED, 1.0, -1.0);
    expect(COMMISSION_FAILED, -1.0, -1.0);
}

static void test_a_sensor_with_half_or_double_gain_fails(void)
{
    expect(COMMISSION_FAILED, 0.4, 1.0);
    expect(COMMISSION_FAILED, 1.0, 0.4);
    expect(COMMISSION_FAILED, 2.5, 1.0);
}

/* A sensor that dies while the patterns are averaged: the last quarter is silent. */
static void test_a_sensor_that_dies_during_the_check_fails(void)
{
    for (int tick = 120; tick < 400; tick += 20) {
        setUp();
        dies_tick = tick;
        TEST_ASSERT_EQUAL_INT(COMMISSION_FAILED, run(1.0, 1.0));
    }
}

/* The largest pulse is 0.45 of the dc link for two periods, whatever the sensors show. */
static void test_two_dead_sensors_end_with_little_true_current(void)
{
    TEST_ASSERT_EQUAL_INT(COMMISSION_FAILED, run(0.0, 0.0));
    TEST_ASSERT_TRUE(peak_A < (1.1 * 0.45 * 540.0 * 2.0 * TS_s / winding.ld_H));
}

static void test_the_admittance_is_that_of_the_winding(void)
{
    winding.angle_rad = 0.7;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run(1.0, 1.0));
    const double mean = 0.5 * ((1.0 / 0.036) + (1.0 / 0.051));
    const double half = 0.5 * ((1.0 / 0.036) - (1.0 / 0.051));
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * mean, mean + (half * cos(1.4)), (double)found.aa);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * mean, half * sin(1.4), (double)found.ab);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * mean, mean - (half * cos(1.4)), (double)found.bb);
}

/* That of the larger inductance, at any angle. */
static void test_the_least_admittance_is_that_of_the_larger_inductance(void)
{
    for (double angle = -3.0; angle < 3.0; angle += 0.37) {
        setUp();
        winding.angle_rad = angle;
        TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run(1.0, 1.0));
        TEST_ASSERT_DOUBLE_WITHIN(0.05 / 0.051, 1.0 / 0.051,
                                  (double)commission_check_least(&found));
    }
}

static void test_a_salient_rotor_passes(void)
{
    for (double angle = -3.0; angle < 3.0; angle += 0.37) {
        setUp();
        winding.angle_rad = angle;
        winding.lq_H      = 7.0 * winding.ld_H;
        TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run(1.0, 1.0));
    }
}

static void test_what_is_not_a_number_fails(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        setUp();
        TEST_ASSERT_EQUAL_INT(COMMISSION_FAILED, run((double)support_not_finite[k], 1.0));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_healthy_winding_passes_at_any_angle);
    RUN_TEST(test_a_dead_or_reversed_sensor_fails);
    RUN_TEST(test_a_sensor_with_half_or_double_gain_fails);
    RUN_TEST(test_a_sensor_that_dies_during_the_check_fails);
    RUN_TEST(test_two_dead_sensors_end_with_little_true_current);
    RUN_TEST(test_the_admittance_is_that_of_the_winding);
    RUN_TEST(test_the_least_admittance_is_that_of_the_larger_inductance);
    RUN_TEST(test_a_salient_rotor_passes);
    RUN_TEST(test_what_is_not_a_number_fails);
    return UNITY_END();
}
