/* SPDX-License-Identifier: MIT */
#include "motion_watch.h"

#include <math.h>

#include "gain_tables.h"
#include "unity.h"

#define TS_s  200.0e-6f
#define MAX_A 4.0f

static motion_watch_t       watch;
static motion_watch_input_t in;

void setUp(void)
{
    const motion_watch_input_t healthy = {.motor           = &gain_tables_drive.motor,
                                          .current_max_A   = MAX_A,
                                          .ts_s            = TS_s,
                                          .now             = {300.0f, 2.3f, -0.5f},
                                          .command_e_radps = 300.0f,
                                          .dc_link_V       = 295.0f};
    in                                 = healthy;
    motion_watch_reset(&watch);
}

void tearDown(void) {}

/* Periods until it is found; 0: not within so many. A look at one equation is in every fourth. */
static int found_after(motion_watch_verdict_t verdict, int most)
{
    for (int k = 1; k <= most; k++) {
        const motion_watch_verdict_t found = motion_watch_judge(&watch, &in);
        if (found != MOTION_WATCH_GOOD) {
            TEST_ASSERT_EQUAL_INT(verdict, found);
            return k;
        }
    }
    return 0;
}

static void test_a_motor_that_runs_as_it_should_is_good(void)
{
    TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 10000));
}

/* A voltage across the current, which takes no power. With 2.8 A: 0.6 (0.193 Wb + 0.11391 H 2.8 A) w
 * + 0.035 295 V. The resistive part and 5.9 V are less than the last term. */
static void test_a_voltage_beyond_what_a_wrong_motor_explains_is_odd(void)
{
    const float lq_H = 0.11391f;
    const float ld_H = 0.07498f;
    for (int way = 0; way < 4; way++) {
        setUp();
        in.now.omega_e_radps = (way < 2) ? 0.0f : -200.0f;
        const float most_V   = (0.6f * 0.511948f * ((way < 2) ? 0.0f : 200.0f)) + 10.325f;
        in.command_e_radps   = in.now.omega_e_radps;
        in.now.iq_A          = ((way & 1) != 0) ? 2.8f : 0.0f;
        in.now.id_A          = ((way & 1) != 0) ? 0.0f : -2.8f;
        float *const d       = ((way & 1) != 0) ? &in.d_Aps.d : &in.d_Aps.q;
        const float  l_H     = ((way & 1) != 0) ? ld_H : lq_H;
        *d                   = -0.99f * most_V / l_H;
        TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 200));
        *d = 1.01f * most_V / l_H;
        TEST_ASSERT_INT_WITHIN(1, 51, found_after(MOTION_WATCH_ODD, 200)); /* 10 ms */
    }
    setUp();
    in.d_Aps.q = NAN;
    TEST_ASSERT_INT_WITHIN(1, 51, found_after(MOTION_WATCH_ODD, 200));
}

/* At rest, in V: the larger of 0.6 2.48 Ohm i + 0.02 v_dc and 0.035 v_dc. */
static void test_at_rest_the_larger_of_both_allowances_counts(void)
{
    const float lq_H = 0.11391f;
    for (int link = 0; link < 2; link++) {
        for (float i_A = 0.0f; i_A < 4.0f; i_A += 0.25f) {
            setUp();
            in.dc_link_V         = (link == 0) ? 295.0f : 60.0f;
            in.now.omega_e_radps = 0.0f;
            in.command_e_radps   = 0.0f;
            in.now.iq_A          = 0.0f;
            in.now.id_A          = -i_A;
            const float both_V   = (1.488f * i_A) + (0.02f * in.dc_link_V);
            const float most_V   = fmaxf(both_V, 0.035f * in.dc_link_V);
            in.d_Aps.q           = 0.99f * most_V / lq_H;
            TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 200));
            in.d_Aps.q = -1.01f * most_V / lq_H;
            TEST_ASSERT_INT_WITHIN(1, 51, found_after(MOTION_WATCH_ODD, 200));
        }
    }
}

/* The whole error is 4/3 of the share that is wrong, on the axis of the current. */
static void test_a_dead_time_wrong_by_5_us_of_200_is_good(void)
{
    for (float i_A = 0.1f; i_A < 4.0f; i_A += 0.1f) {
        for (int way = -1; way <= 1; way += 2) {
            setUp();
            in.now.omega_e_radps = 0.0f;
            in.command_e_radps   = 0.0f;
            in.now.id_A          = 0.0f;
            in.now.iq_A          = i_A;
            in.d_Aps.q           = (float)way * (4.0f / 3.0f) * (5.0f / 200.0f) * 295.0f / 0.11391f;
            TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 200));
        }
    }
}

/* At 300 rad/s with 2.3 and -0.5 A, in W:
 * 0.5 300 (0.193 + 0.03893 0.5) 2.3 + (0.6 2.48 2.8 + 5.9) 2.8 = 101.5 */
static void test_power_that_a_wrong_motor_does_not_explain_is_found(void)
{
    const float most_W = 101.5f;
    for (int way = 0; way < 4; way++) {
        setUp();
        const bool  along_d = (way & 1) != 0;
        const float share   = (way < 2) ? 1.0f : -1.0f;
        const float w_per_a = along_d ? (0.07498f * -0.5f) : (0.11391f * 2.3f);
        /* along d alone, EQ-MOTION-WATCH-1 would be first: both axes */
        in.d_Aps.q = share * 0.99f * most_W / (0.11391f * 2.3f);
        if (along_d) {
            in.d_Aps.q = share * 0.8f * most_W / (0.11391f * 2.3f);
            in.d_Aps.d = share * 0.19f * most_W / w_per_a;
        }
        TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 200));
        *(along_d ? &in.d_Aps.d : &in.d_Aps.q) += share * 0.02f * most_W / w_per_a;
        TEST_ASSERT_INT_WITHIN(1, 51, found_after(MOTION_WATCH_ODD, 200));
    }
}

/* The true motor is the believed one in another frame: the encoder's angle is off. */
static void test_a_wrong_angle_is_found_from_80_to_280_degrees(void)
{
    for (int degrees = 0; degrees < 360; degrees += 10) {
        setUp();
        const float off_rad = (float)degrees * 0.0174533f;
        in.now.id_A         = 0.0f;
        in.now.iq_A         = 3.7f;
        in.dc_link_V        = 60.0f; /* little of a dead time */
        /* v = EMF of the magnets, turned, less the EMF that is expected */
        in.d_Aps.q = gain_tables_drive.motor.l5 * 300.0f * (1.0f - cosf(off_rad));
        in.d_Aps.d =
            gain_tables_drive.motor.l5 * gain_tables_drive.motor.l9 * 300.0f * sinf(off_rad);
        const bool far   = (degrees >= 80) && (degrees <= 280);
        const bool near  = (degrees <= 60) || (degrees >= 300);
        const int  found = found_after(MOTION_WATCH_ODD, 200);
        TEST_ASSERT_TRUE(!far || (found > 0));
        TEST_ASSERT_TRUE(!near || (found == 0));
    }
}

static void push(float omega_e_radps)
{
    in.now.iq_A          = 3.7f;
    in.now.id_A          = 0.0f;
    in.now.omega_e_radps = omega_e_radps;
}

static void test_torque_without_an_edge_is_a_stall_after_50_ms(void)
{
    push(0.0f);
    in.edge_gap_s = 0.05f;
    TEST_ASSERT_INT_WITHIN(1, 249, found_after(MOTION_WATCH_STALL, 1000));
}

static void test_an_edge_begins_the_50_ms_anew(void)
{
    push(15.0f); /* faster than the other check sees */
    for (int k = 0; k < 3000; k++) {
        in.edge_gap_s = TS_s * (float)(k % 200);
        TEST_ASSERT_EQUAL_INT(MOTION_WATCH_GOOD, motion_watch_judge(&watch, &in));
    }
}

static void test_a_slow_shaft_at_the_limit_is_a_stall_after_half_a_second(void)
{
    push(-9.0f);
    TEST_ASSERT_INT_WITHIN(2, 2497, found_after(MOTION_WATCH_STALL, 4000));
    setUp(); /* not with less current, or where it has to stand */
    push(0.0f);
    in.now.iq_A   = 3.5f;
    in.edge_gap_s = 0.05f;
    TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 10000));
    setUp();
    push(0.0f);
    in.command_e_radps = 0.0f;
    in.edge_gap_s      = 0.05f;
    TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 10000));
}

static void test_a_speed_that_leaves_its_command_at_the_limit_is_found_after_250_ms(void)
{
    int k = 0;

    push(280.0f);
    while ((k < 5000) && (motion_watch_judge(&watch, &in) == MOTION_WATCH_GOOD)) {
        in.now.omega_e_radps -= 0.2f; /* 1000 rad/s^2 */
        k++;
    }
    /* 30 rad/s until it is 50 away, then 0.25 s. */
    TEST_ASSERT_INT_WITHIN(3, 150 + 1251, k);
}

static void test_a_speed_on_its_way_or_with_current_left_is_good(void)
{
    push(-300.0f);
    for (int k = 0; k < 3000; k++) {
        in.now.omega_e_radps += 0.2f;
        TEST_ASSERT_EQUAL_INT(MOTION_WATCH_GOOD, motion_watch_judge(&watch, &in));
    }
    in.command_e_radps = -300.0f; /* another command */
    TEST_ASSERT_EQUAL_INT(0, found_after(MOTION_WATCH_GOOD, 3000));
    setUp();
    in.now.omega_e_radps = 100.0f;
    for (int k = 0; k < 3000; k++) {
        in.now.omega_e_radps -= 0.1f;
        TEST_ASSERT_EQUAL_INT(MOTION_WATCH_GOOD, motion_watch_judge(&watch, &in));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_motor_that_runs_as_it_should_is_good);
    RUN_TEST(test_a_voltage_beyond_what_a_wrong_motor_explains_is_odd);
    RUN_TEST(test_at_rest_the_larger_of_both_allowances_counts);
    RUN_TEST(test_a_dead_time_wrong_by_5_us_of_200_is_good);
    RUN_TEST(test_power_that_a_wrong_motor_does_not_explain_is_found);
    RUN_TEST(test_a_wrong_angle_is_found_from_80_to_280_degrees);
    RUN_TEST(test_torque_without_an_edge_is_a_stall_after_50_ms);
    RUN_TEST(test_an_edge_begins_the_50_ms_anew);
    RUN_TEST(test_a_slow_shaft_at_the_limit_is_a_stall_after_half_a_second);
    RUN_TEST(test_a_speed_that_leaves_its_command_at_the_limit_is_found_after_250_ms);
    RUN_TEST(test_a_speed_on_its_way_or_with_current_left_is_good);
    return UNITY_END();
}
