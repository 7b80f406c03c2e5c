/* SPDX-License-Identifier: MIT */
#include "commission_probe.h"

#include "held_winding.h"
#include "unit_support.h"
#include "unity.h"

#define TS_s   2.0e-4
#define HELD_V 3.0 /* along alpha: a direct current */
#define DIES   400 /* tick, within a window */

static commission_config_t     config;
static commission_probe_t      probe;
static commission_admittance_t known;
static held_winding_t          winding;

void setUp(void)
{
    const commission_config_t c = {.ts_s = (float)TS_s, .current_max_A = 9.0f};
    const held_winding_t      w = {.ts_s = TS_s, .r_Ohm = 3.6, .ld_H = 0.036, .lq_H = 0.051};
    config                      = c;
    winding                     = w;
    commission_probe_start(&probe);
}

void tearDown(void) {}

/* The check would have found this at angle 0. The mean is that of any angle. */
static void know(void)
{
    known.aa      = (float)(1.0 / winding.ld_H);
    known.ab      = 0.0f;
    known.bb      = (float)(1.0 / winding.lq_H);
    known.pulse_V = 30.0f;
}

static ab_t sensed(ab_t i_A, double gain_a, double gain_b)
{
    const double a   = gain_a * (double)i_A.alpha;
    const double b   = gain_b * ((0.5 * sqrt(3.0) * (double)i_A.beta) - (0.5 * (double)i_A.alpha));
    const ab_t   out = {(float)a, (float)((a + (2.0 * b)) / sqrt(3.0))};
    return out;
}

/* @return ticks after DIES until the sensors, which then have these gains, are refused; 2000: never. */
static int refused_after(double angle_rad, double gain_a, double gain_b)
{
    ab_t asked_V  = {0.0f, 0.0f};
    ab_t before_A = {0.0f, 0.0f};

    setUp();
    winding.angle_rad = angle_rad;
    know();
    for (int k = 0; k < 2000; k++) {
        commission_signal_t s = winding_step(&winding, asked_V);
        s.i_A                 = (k < DIES) ? s.i_A : sensed(s.i_A, gain_a, gain_b);
        s.di_A.alpha          = s.i_A.alpha - before_A.alpha;
        s.di_A.beta           = s.i_A.beta - before_A.beta;
        before_A              = s.i_A;
        if (!commission_probe_tick(&probe, &config, &s, &known, &asked_V)) {
            return k - DIES;
        }
        asked_V.alpha += (float)HELD_V;
    }
    return 2000;
}

static void test_a_healthy_winding_answers_at_any_angle(void)
{
    for (double angle = -3.0; angle < 3.0; angle += 0.37) {
        TEST_ASSERT_EQUAL_INT(2000, refused_after(angle, 1.0, 1.0));
        TEST_ASSERT_EQUAL_INT(2000, refused_after(angle, 1.1, 0.95));
    }
}

/* Two dead sensors: the windows that end after them. One: three more. */
static void test_a_sensor_that_dies_is_refused_in_some_windows(void)
{
    for (double angle = -3.0; angle < 3.0; angle += 0.37) {
        TEST_ASSERT_TRUE(refused_after(angle, 0.0, 0.0) <= (2 * COMMISSION_PROBE_TICKS));
        TEST_ASSERT_TRUE(refused_after(angle, 0.0, 1.0) <= (4 * COMMISSION_PROBE_TICKS));
        TEST_ASSERT_TRUE(refused_after(angle, 1.0, 0.0) <= (4 * COMMISSION_PROBE_TICKS));
    }
}

static void test_gains_of_both_are_refused(void)
{
    TEST_ASSERT_TRUE(refused_after(0.4, 0.5, 0.5) <= (5 * COMMISSION_PROBE_TICKS));
    TEST_ASSERT_TRUE(refused_after(0.4, 2.0, 2.0) <= (5 * COMMISSION_PROBE_TICKS));
    TEST_ASSERT_TRUE(refused_after(0.4, -1.0, -1.0) <= (2 * COMMISSION_PROBE_TICKS));
}

/* Much reluctance: the admittance of one axis is a seventh of the other's, but not zero. */
static void test_a_salient_rotor_is_no_dead_sensor(void)
{
    for (double angle = -3.0; angle < 3.0; angle += 0.37) {
        setUp();
        commission_probe_start(&probe);
        winding.lq_H = 7.0 * winding.ld_H;
        ab_t asked_V = {0.0f, 0.0f};
        ab_t last_A  = {0.0f, 0.0f};
        know();
        winding.angle_rad = angle;
        for (int k = 0; k < 500; k++) {
            commission_signal_t s = winding_step(&winding, asked_V);
            s.di_A.alpha          = s.i_A.alpha - last_A.alpha;
            s.di_A.beta           = s.i_A.beta - last_A.beta;
            last_A                = s.i_A;
            TEST_ASSERT_TRUE(commission_probe_tick(&probe, &config, &s, &known, &asked_V));
        }
    }
}

/* Neither the voltage nor the current has a mean, and its torque leaves no speed and no way of a window. */
static void test_a_window_leaves_no_voltage_and_no_motion(void)
{
    const commission_signal_t quiet = {.dc_link_V = 540.0f};
    dq_t                      v_V = {0.0f, 0.0f}, i = {0.0f, 0.0f}, speed = {0.0f, 0.0f};

    know();
    for (int k = 0; k < COMMISSION_PROBE_TICKS; k++) {
        ab_t pulse_V;
        (void)commission_probe_tick(&probe, &config, &quiet, &known, &pulse_V);
        TEST_ASSERT_TRUE(hypotf(pulse_V.alpha, pulse_V.beta) <= (2.001f * known.pulse_V));
        v_V.d += pulse_V.alpha;
        v_V.q += pulse_V.beta;
        i.d += v_V.d;
        i.q += v_V.q;
        speed.d += i.d;
        speed.q += i.q;
    }
    TEST_ASSERT_TRUE((v_V.d == 0.0f) && (v_V.q == 0.0f));
    TEST_ASSERT_TRUE((i.d == 0.0f) && (i.q == 0.0f));
    TEST_ASSERT_TRUE((speed.d == 0.0f) && (speed.q == 0.0f));
}

static void test_the_pulses_stay_in_the_dc_link(void)
{
    const commission_signal_t low = {.dc_link_V = 40.0f};
    ab_t                      pulse_V;

    know();
    (void)commission_probe_tick(&probe, &config, &low, &known, &pulse_V);
    TEST_ASSERT_TRUE(fabsf(pulse_V.alpha) <= (0.4501f * 40.0f));
}

static void test_what_is_no_number_is_refused(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        bool ok = true;
        setUp();
        know();
        for (int n = 0; n < (3 * COMMISSION_PROBE_TICKS); n++) {
            ab_t                      pulse_V;
            const commission_signal_t s = {.di_A      = {support_not_finite[k], 0.0f},
                                           .dc_link_V = 540.0f};
            ok = ok && commission_probe_tick(&probe, &config, &s, &known, &pulse_V);
        }
        TEST_ASSERT_FALSE(ok);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_healthy_winding_answers_at_any_angle);
    RUN_TEST(test_a_sensor_that_dies_is_refused_in_some_windows);
    RUN_TEST(test_gains_of_both_are_refused);
    RUN_TEST(test_a_salient_rotor_is_no_dead_sensor);
    RUN_TEST(test_a_window_leaves_no_voltage_and_no_motion);
    RUN_TEST(test_the_pulses_stay_in_the_dc_link);
    RUN_TEST(test_what_is_no_number_is_refused);
    return UNITY_END();
}
