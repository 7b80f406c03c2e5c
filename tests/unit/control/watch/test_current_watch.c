/* SPDX-License-Identifier: MIT */
#include "current_watch.h"

#include "unity.h"

#define TS_s  200.0e-6f
#define MAX_A 4.0f
#define W     300.0f /* electrical, of the frame */

static current_watch_t             watch;
static const current_watch_scale_t scale = {
    .ts_s = TS_s, .current_max_A = MAX_A, .open_s = 10.0e-3f, .jump_A = 1.7f};
static float theta; /* of the sample */

void setUp(void)
{
    theta = 0.3f;
    current_watch_reset(&watch);
}

void tearDown(void) {}

/* The phase currents of a constant vector, now. */
static abc_t phases(dq_t i_A)
{
    return frames_inverse_clarke(frames_inverse_park(i_A, frames_angle(theta)));
}

/* The law predicts `model` for the next sample and asks for `ref`; the frame turns on to it. */
static void expect(dq_t model, dq_t ref, dq_t d_Aps, bool predicted)
{
    theta                                = frames_wrap(theta + (W * TS_s));
    const float                    ahead = 0.5f * W * TS_s;
    const current_watch_expected_t e     = {.angle     = frames_angle(theta + ahead),
                                            .ahead_rad = ahead,
                                            .i_A =
                                                frames_inverse_park(model, frames_angle(theta + ahead)),
                                            .d_Aps     = d_Aps,
                                            .predicted = predicted};
    current_watch_expect(&watch, &e, TS_s);
    current_watch_ask(&watch, ref, e.angle);
}

/* Both, in every period. */
static current_watch_verdict_t judge(float ia_A, float ib_A)
{
    const current_watch_verdict_t now = current_watch_judge(&watch, ia_A, ib_A, &scale);

    return (now == CURRENT_WATCH_GOOD) ? current_watch_look(&watch, ia_A, ib_A, W, TS_s, &scale)
                                       : now;
}

static const dq_t none = {0.0f, 0.0f};
static const dq_t some = {.d = -0.5f, .q = 2.3f};

static void test_currents_of_the_model_are_good_for_ever(void)
{
    for (int k = 0; k < 5000; k++) {
        expect(some, some, none, true);
        const abc_t i = phases(some);
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, judge(i.a, i.b));
    }
    /* The turned model is right to second order of half a period's angle. */
    TEST_ASSERT_FLOAT_WITHIN(0.05f, 0.0f, watch.phase[0].residual_A);
}

static void test_nothing_is_expected_of_the_first_sample(void)
{
    TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, judge(3.0f, -3.0f));
}

/* Samples until it is found; 0: not within a second. */
static int found_after(dq_t model, float offset_a_A, float offset_b_A)
{
    for (int k = 1; k <= 5000; k++) {
        expect(model, none, none, true);
        const abc_t i = phases(model);
        if (judge(i.a + offset_a_A, i.b + offset_b_A) != CURRENT_WATCH_GOOD) {
            return k;
        }
    }
    return 0;
}

/* As the gate lets the second one of them pass. */
static void test_what_no_current_can_do_in_a_period_is_found_at_once(void)
{
    const current_watch_scale_t slow = {
        .ts_s = TS_s, .current_max_A = 40.0f, .open_s = 10.0e-3f, .jump_A = 1.6f};

    expect(none, none, none, true);
    TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, current_watch_judge(&watch, 1.5f, 0.0f, &slow));
    setUp();
    expect(none, none, none, true);
    TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_SENSOR, current_watch_judge(&watch, 0.0f, -1.7f, &slow));
}

/* A model that knows nothing of it: each sample adds all of it. 1.5 A are 3/8 of the limit, and 0.6 of what the current
 * has changed by is explained: 0.64 A, then 2.3. */
static void test_residuals_beyond_three_eighths_together_are_found_at_once(void)
{
    TEST_ASSERT_EQUAL_INT(2, found_after(none, 1.6f, 0.0f));
    setUp();
    TEST_ASSERT_EQUAL_INT(2, found_after(none, 0.0f, -1.6f));
}

/* With little inductance a wrong EMF is as large: 7/8 of the jump for a while, 3/8 of it for long. */
static void test_what_little_inductance_explains_is_no_sensor(void)
{
    const current_watch_scale_t little = {
        .ts_s = TS_s, .current_max_A = MAX_A, .open_s = 10.0e-3f, .jump_A = 10.0f};

    for (int k = 0; k < 5; k++) {
        expect(none, none, none, true);
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, current_watch_judge(&watch, 1.6f, 0.0f, &little));
    }
    setUp();
    for (int k = 0; k < 500; k++) { /* R goes to 2.5 A */
        expect(none, none, none, true);
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, current_watch_judge(&watch, 0.1f, 0.0f, &little));
    }
}

static void test_a_small_lasting_residual_is_found_after_six_milliseconds(void)
{
    /* R goes to 0.04 tau / Ts = 1 A, between 0.6 and 1.5; i_slow follows, so that D does not count in the end. */
    const int samples = found_after(none, 0.04f, 0.0f);

    TEST_ASSERT_GREATER_THAN(30, samples); /* 6 ms */
    TEST_ASSERT_LESS_THAN(70, samples);
    setUp();
    TEST_ASSERT_EQUAL_INT(0, found_after(none, 0.02f, 0.0f)); /* 0.5 A */
}

/* With the wrong inductance a step leaves half of itself. */
static void test_what_the_current_changes_by_itself_explains_a_part(void)
{
    const current_watch_scale_t quick = {
        .ts_s = TS_s, .current_max_A = MAX_A, .open_s = 10.0e-3f, .jump_A = 3.6f};

    for (int k = 0; k < 100; k++) {
        const float now    = (k < 10) ? -3.5f : 3.5f; /* i_a; all of the step at once */
        const dq_t  actual = {.d = now, .q = 0.0f};
        const float model  = (k == 10) ? 0.0f : now;
        theta              = 0.0f;
        const current_watch_expected_t e = {
            .angle = frames_angle(0.0f), .i_A = {.alpha = model, .beta = 0.0f}, .predicted = true};
        current_watch_expect(&watch, &e, TS_s);
        const abc_t i = phases(actual);
        if (k > 0) { /* after the first sample all is as before */
            TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD,
                                  current_watch_judge(&watch, i.a, i.b, &quick));
        } else {
            current_watch_reset(&watch);
            current_watch_start(&watch, i.a, i.b);
        }
    }
}

/* Disturbances that stand still in the rotor's frame are the motor's, EQ-CURRENT-WATCH-1. */
static void test_constant_disturbances_are_the_motors(void)
{
    const dq_t d_Aps = {.d = 300.0f, .q = -500.0f};

    for (int k = 0; k < 5000; k++) {
        expect(some, some, d_Aps, true);
        const abc_t i = phases(some);
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, judge(i.a, i.b));
    }
    TEST_ASSERT_FLOAT_WITHIN(1.0f, 300.0f, watch.d_slow_Aps.d);
    TEST_ASSERT_FLOAT_WITHIN(1.0f, -500.0f, watch.d_slow_Aps.q);
}

/* With a sensor offset, an observer predicts the reading by disturbances that turn. */
static void test_disturbances_that_turn_are_a_sensors(void)
{
    bool found = false;

    for (int k = 0; k < 500; k++) {
        const float turn  = W * TS_s * (float)k;
        const dq_t  d_Aps = {.d = 900.0f * cosf(turn), .q = -900.0f * sinf(turn)};
        expect(some, some, d_Aps, true);
        const abc_t i = phases(some);
        found         = found || (judge(i.a, i.b) == CURRENT_WATCH_SENSOR);
    }
    TEST_ASSERT_TRUE(found);
}

/* To an observer, a sensor that drifts is a disturbance that stands still in the stator. At 300 rad/s
 * S goes to 0.6 d / 60 per s: the filter of d takes the rest. Samples until it is found. */
static int drift_found_after(float d_Aps, float ia_A, float omega_e_radps)
{
    for (int k = 1; k <= 5000; k++) {
        const float                    at = frames_wrap(omega_e_radps * TS_s * (float)k);
        const dq_t                     d  = {.d = d_Aps * cosf(at), .q = -d_Aps * sinf(at)};
        const current_watch_expected_t e  = {
             .angle = frames_angle(at), .d_Aps = d, .predicted = true};
        current_watch_expect(&watch, &e, TS_s);
        if (current_watch_look(&watch, ia_A, 0.0f, omega_e_radps, TS_s, &scale) !=
            CURRENT_WATCH_GOOD) {
            return k;
        }
    }
    return 0;
}

/* 0.63 jump are 1.07 A: 107 A/s */
static void test_a_slow_drift_is_found_by_its_sum(void)
{
    TEST_ASSERT_EQUAL_INT(0, drift_found_after(102.0f, 2.0f, W));
    for (int way = 0; way < 2; way++) {
        const float sign = (way == 0) ? 1.0f : -1.0f;

        setUp();
        TEST_ASSERT_INT_WITHIN(100, 250, drift_found_after(sign * 112.0f, 2.0f, W));
        setUp();
        TEST_ASSERT_INT_WITHIN(100, 250, drift_found_after(112.0f, sign * 2.0f, -sign * W));
    }
    setUp();
    const int samples = drift_found_after(1000.0f, 2.0f, W);
    TEST_ASSERT_GREATER_THAN(4, samples);
    TEST_ASSERT_LESS_THAN(15, samples);
}

/* At 100 rad/s the filter leaves 0.24 d, and a fifth of the speed is forgotten. */
static void test_slow_turns_are_remembered_longer(void)
{
    TEST_ASSERT_EQUAL_INT(0, drift_found_after(80.0f, 2.0f, 100.0f));
    setUp();
    TEST_ASSERT_GREATER_THAN(0, drift_found_after(95.0f, 2.0f, 100.0f));
}

/* A quarter of i_max: 2 A */
static void test_the_bound_is_one_of_the_current(void)
{
    current_watch_scale_t twice = scale;

    twice.current_max_A = 2.0f * MAX_A;
    watch.models        = true;
    for (int way = 0; way < 2; way++) {
        float *const sum_A = (way == 0) ? &watch.drift_A.alpha : &watch.drift_A.beta;

        *sum_A = 1.95f;
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD,
                              current_watch_look(&watch, 0.0f, 3.0f, W, TS_s, &twice));
        *sum_A = -2.1f;
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_SENSOR,
                              current_watch_look(&watch, 0.0f, 3.0f, W, TS_s, &twice));
        *sum_A = 0.0f;
    }
}

static void test_a_sum_means_nothing_at_rest_or_without_current(void)
{
    TEST_ASSERT_EQUAL_INT(0, drift_found_after(1000.0f, 2.0f, 59.0f));
    setUp();
    TEST_ASSERT_GREATER_THAN(0, drift_found_after(1000.0f, 2.0f, 61.0f));
    setUp();
    TEST_ASSERT_EQUAL_INT(0, drift_found_after(200.0f, 1.2f, W));
    TEST_ASSERT_GREATER_THAN(0, drift_found_after(200.0f, 1.3f, W));
    setUp();
    watch.drift_A.alpha = NAN;
    watch.models        = true;
    TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_SENSOR,
                          current_watch_look(&watch, 0.0f, 2.0f, W, TS_s, &scale));
    watch.models = false;
    TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD,
                          current_watch_look(&watch, 0.0f, 2.0f, W, TS_s, &scale));
}

/* Four times the way through a count: the shipped motor's 0.34 ms leave 10 ms, a pump's 14.4 ms give 58. */
static void test_time_without_current_is_that_of_the_encoder(void)
{
    TEST_ASSERT_FLOAT_WITHIN(1.0e-9f, 10.0e-3f, current_watch_open_s(1.2566e-3f, 11000.0f));
    TEST_ASSERT_FLOAT_WITHIN(3.0e-4f, 57.5e-3f, current_watch_open_s(0.018408f, 89.0f));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-9f, 1.0f, current_watch_open_s(0.018408f, 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-9f, 1.0f, current_watch_open_s(0.018408f, NAN));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-9f, 1.0f, current_watch_open_s(NAN, 10.0f));
}

static void test_without_a_prediction_there_is_no_residual(void)
{
    for (int k = 0; k < 500; k++) {
        expect(none, none, none, false);
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, judge(3.0f, -1.0f));
    }
}

static int open_after(float ia_A, float ib_A, dq_t ref)
{
    for (int k = 1; k <= 500; k++) {
        theta                            = 0.0f;
        const current_watch_expected_t e = {.angle = frames_angle(0.0f)};
        current_watch_expect(&watch, &e, TS_s);
        current_watch_ask(&watch, ref, e.angle);
        if (judge(ia_A, ib_A) == CURRENT_WATCH_OPEN) {
            return k;
        }
    }
    return 0;
}

static void test_a_phase_without_current_is_found_after_ten_milliseconds(void)
{
    const dq_t in_a  = {.d = 0.2f, .q = 0.0f};   /* a: 0.2 A, b and c: -0.1 A */
    const dq_t in_bc = {.d = 0.0f, .q = -0.25f}; /* b: -0.22 A, c: 0.22 A */

    TEST_ASSERT_INT_WITHIN(1, 51, open_after(0.07f, 0.5f, in_a));
    setUp();
    TEST_ASSERT_INT_WITHIN(1, 51, open_after(0.5f, 0.07f, in_bc));
    setUp();
    TEST_ASSERT_INT_WITHIN(1, 51, open_after(0.5f, -0.45f, in_bc));
}

/* A lagging current is near zero in one phase after another. */
static void test_phases_without_current_in_turn_are_not_open(void)
{
    const dq_t all = {.d = 0.2f, .q = 0.4f}; /* a: 0.2 A, b: 0.25 A, c: -0.45 A */

    for (int k = 0; k < 1500; k++) {
        static const float turns[3][2]   = {{0.0f, 0.5f}, {0.5f, 0.0f}, {0.5f, -0.5f}};
        const float *const i_A           = turns[(k / 10) % 3];
        theta                            = 0.0f;
        const current_watch_expected_t e = {.angle = frames_angle(0.0f)};
        current_watch_expect(&watch, &e, TS_s);
        current_watch_ask(&watch, all, e.angle);
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, judge(i_A[0], i_A[1]));
    }
}

static void test_a_phase_that_carries_current_or_has_to_carry_none_is_not_open(void)
{
    const dq_t in_a = {.d = 0.2f, .q = 0.0f};
    const dq_t less = {.d = 0.15f, .q = 0.0f};

    TEST_ASSERT_EQUAL_INT(0, open_after(0.09f, 0.5f, in_a));
    setUp();
    TEST_ASSERT_EQUAL_INT(0, open_after(0.0f, 0.5f, less));
    setUp(); /* in a row */
    for (int k = 0; k < 500; k++) {
        theta                            = 0.0f;
        const current_watch_expected_t e = {.angle = frames_angle(0.0f)};
        current_watch_expect(&watch, &e, TS_s);
        current_watch_ask(&watch, in_a, e.angle);
        TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_GOOD, judge((k % 40) == 0 ? 0.1f : 0.0f, 0.5f));
    }
}

static void test_a_residual_that_is_no_number_is_a_fault(void)
{
    expect(none, none, none, true);
    watch.phase[1].residual_A = NAN;
    TEST_ASSERT_EQUAL_INT(CURRENT_WATCH_SENSOR, judge(0.0f, 0.0f));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_of_the_model_are_good_for_ever);
    RUN_TEST(test_nothing_is_expected_of_the_first_sample);
    RUN_TEST(test_what_no_current_can_do_in_a_period_is_found_at_once);
    RUN_TEST(test_residuals_beyond_three_eighths_together_are_found_at_once);
    RUN_TEST(test_what_little_inductance_explains_is_no_sensor);
    RUN_TEST(test_a_small_lasting_residual_is_found_after_six_milliseconds);
    RUN_TEST(test_what_the_current_changes_by_itself_explains_a_part);
    RUN_TEST(test_constant_disturbances_are_the_motors);
    RUN_TEST(test_disturbances_that_turn_are_a_sensors);
    RUN_TEST(test_a_slow_drift_is_found_by_its_sum);
    RUN_TEST(test_slow_turns_are_remembered_longer);
    RUN_TEST(test_the_bound_is_one_of_the_current);
    RUN_TEST(test_a_sum_means_nothing_at_rest_or_without_current);
    RUN_TEST(test_time_without_current_is_that_of_the_encoder);
    RUN_TEST(test_without_a_prediction_there_is_no_residual);
    RUN_TEST(test_a_phase_without_current_is_found_after_ten_milliseconds);
    RUN_TEST(test_phases_without_current_in_turn_are_not_open);
    RUN_TEST(test_a_phase_that_carries_current_or_has_to_carry_none_is_not_open);
    RUN_TEST(test_a_residual_that_is_no_number_is_a_fault);
    return UNITY_END();
}
