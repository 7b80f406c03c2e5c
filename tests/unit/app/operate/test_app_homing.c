/* SPDX-License-Identifier: MIT */
/* Every method on an axis that follows its speed with a limited acceleration. */
#include "app_homing.h"

#include "app_control.h"

#include "unit_support.h"
#include "unity.h"

#define TURN     10000
#define PAIRS    2
#define MARK     1234 /* count of the index mark in a turn */
#define TS_s     2.0e-4f
#define CALL_s   1.0e-3
#define FAST_cps 40000.0 /* counts per second */
#define SLOW_cps 2000.0
#define RATE     1.0e6 /* counts per second squared: 20 ms from the fast speed to rest */

#define NEGATIVE_LIMIT (-60000)
#define POSITIVE_LIMIT 70000
#define LOWER          3000 /* edges of the home switch */
#define UPPER          9500

/* Which part of the axis the home switch is active on. */
typedef enum { ABOVE, BELOW, SHORT } form_t;

static app_homing_t   homing;
static app_objects_t  wanted;
static app_position_t position;
static app_angle_t    angle;
static uint32_t       ticks;
static form_t         form;
static double         x_cnt; /* operator's sense */
static double         v_cps;
static int            left_cnt; /* of a correction of the angle */
static uint16_t       forced;   /* inputs that are active anyway */

static float e_radps(double cps)
{
    return (float)(cps * 6.283185307179586 * PAIRS / TURN);
}

static int32_t motor_cnt(void)
{
    const double x = floor(x_cnt);

    return (int32_t)(wanted.reversed ? -x : x);
}

static void place(double at_cnt)
{
    x_cnt = at_cnt;
    v_cps = 0.0;
}

static void see(void)
{
    const int32_t at   = motor_cnt();
    const int32_t turn = ((at % TURN) + TURN) % TURN;

    position.actual  = app_position_at(&position, at + left_cnt);
    angle.before_cnt = (uint16_t)turn;
}

void setUp(void)
{
    const app_angle_t   encoder = {.pole_pairs  = PAIRS,
                                   .positions   = TURN,
                                   .rad_per_cnt = 6.2831853f * PAIRS / TURN,
                                   .reference   = APP_ANGLE_INDEX,
                                   .zero_cnt    = MARK};
    const app_objects_t o       = {.controlword           = APP_CONTROL_ENABLE_OPERATION,
                                   .inputs_used           = 7U,
                                   .homing_switch_e_radps = e_radps(FAST_cps),
                                   .homing_zero_e_radps   = e_radps(SLOW_cps),
                                   .homing_time_s         = 60.0f};

    angle    = encoder;
    wanted   = o;
    ticks    = 0xFFFFF000UL; /* wraps on the way */
    forced   = 0U;
    form     = SHORT;
    left_cnt = 0;
    app_position_init(&position, &angle);
    position.known = true;
    app_homing_reset(&homing);
    place(0.0);
}

void tearDown(void) {}

static bool home_switch(void)
{
    const bool above = x_cnt >= LOWER;
    const bool below = x_cnt <= UPPER;

    return (form == SHORT) ? (above && below) : ((form == ABOVE) ? above : below);
}

static uint16_t active(void)
{
    return (uint16_t)(forced | ((x_cnt <= NEGATIVE_LIMIT) ? BOARD_INPUT_NEGATIVE : 0) |
                      ((x_cnt >= POSITIVE_LIMIT) ? BOARD_INPUT_POSITIVE : 0) |
                      (home_switch() ? BOARD_INPUT_HOME : 0));
}

/* One millisecond. */
static float step(void)
{
    const app_homing_seen_t seen = {
        .position = &position, .angle = &angle, .active = active(), .ticks = ticks, .ts_s = TS_s};

    see();
    const float  speed = app_homing_tick(&homing, &wanted, &seen);
    const double motor = (double)speed / (double)e_radps(1.0);
    const double goal  = wanted.reversed ? -motor : motor;
    const double most  = RATE * CALL_s;

    v_cps += fmax(-most, fmin(most, goal - v_cps));
    x_cnt += v_cps * CALL_s;
    ticks += 5U;
    return speed;
}

static void start(int method)
{
    wanted.homing_method = (int16_t)method;
    wanted.controlword   = APP_CONTROL_ENABLE_OPERATION;
    (void)step();
    wanted.controlword = APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT;
}

/* Homes, and returns the zero that it found, in the operator's sense. */
static int32_t home(int method, double from_cnt)
{
    place(from_cnt);
    app_homing_reset(&homing);
    start(method);
    for (int n = 0; (n < 60000) && (homing.stage != APP_HOMING_ATTAINED); n++) {
        (void)step();
        TEST_ASSERT_TRUE_MESSAGE(homing.stage != APP_HOMING_FAILED, "failed");
        TEST_ASSERT_TRUE((x_cnt > (NEGATIVE_LIMIT - 2000)) && (x_cnt < (POSITIVE_LIMIT + 2000)));
    }
    TEST_ASSERT_EQUAL_INT(APP_HOMING_ATTAINED, homing.stage);
    TEST_ASSERT_TRUE(homing.fresh);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, step());
    const int32_t cnt = app_position_cnt(&position, &homing.zero);
    return wanted.reversed ? -cnt : cnt;
}

/* Oracle: edge and direction of a method with a switch, from the standard's pictures. */
static void edge_of(int method, int *edge, int *way)
{
    static const int edges[14] = {NEGATIVE_LIMIT, POSITIVE_LIMIT, LOWER, LOWER, UPPER,
                                  UPPER,          LOWER,          LOWER, UPPER, UPPER,
                                  UPPER,          UPPER,          LOWER, LOWER};
    static const int goes[14]  = {1, -1, -1, 1, 1, -1, -1, 1, -1, 1, 1, -1, 1, -1};

    *edge = edges[method - 1];
    *way  = goes[method - 1];
}

static form_t form_of(int method)
{
    return ((method == 3) || (method == 4)) ? ABOVE
                                            : (((method == 5) || (method == 6)) ? BELOW : SHORT);
}

/* The mark after an edge, in the motor's counts. */
static int next_mark(int edge, int way)
{
    int mark = wanted.reversed ? -MARK : MARK;

    while (((way > 0) && (mark > edge)) || ((way < 0) && (mark < edge))) {
        mark -= way * TURN;
    }
    while (((way > 0) && (mark <= edge)) || ((way < 0) && (mark >= edge))) {
        mark += way * TURN;
    }
    return mark;
}

static void each_method_from_everywhere(void)
{
    static const double from[] = {-55000.0, -1000.0, 2999.0,  3100.0, 6000.0,
                                  9400.0,   9502.0,  12000.0, 66000.0};
    const int           within = (int)(SLOW_cps * CALL_s) + 1;
    int                 edge   = 0;
    int                 way    = 0;

    for (int method = 1; method <= 14; method++) {
        edge_of(method, &edge, &way);
        form = form_of(method);
        for (int k = 0; k < SUPPORT_COUNT(from); k++) {
            const int32_t at = home(method + 16, from[k]);

            TEST_ASSERT_INT32_WITHIN(within, edge, at);
            TEST_ASSERT_INT32_WITHIN(1, next_mark(edge, way), home(method, from[k]));
        }
    }
}

static void test_each_method_finds_its_edge_and_its_mark_from_everywhere(void)
{
    each_method_from_everywhere();
}

static void test_and_so_it_does_for_an_operator_who_is_turned_round(void)
{
    wanted.reversed = true;
    each_method_from_everywhere();
}

static void test_the_next_mark_is_found_in_both_directions(void)
{
    for (int reversed = 0; reversed < 2; reversed++) {
        wanted.reversed = reversed != 0;
        for (int from = -12000; from < 12000; from += 777) {
            TEST_ASSERT_INT32_WITHIN(1, next_mark(from, -1), home(33, from));
            TEST_ASSERT_INT32_WITHIN(1, next_mark(from, 1), home(34, from));
        }
    }
}

/* An alignment does not know the mark; the first one that passes is it. */
static void test_the_first_mark_after_an_alignment_is_home(void)
{
    place(0.0);
    angle.reference = APP_ANGLE_ALIGNED;
    angle.zero_cnt  = 5U;
    start(34);
    for (int n = 0; (n < 6000) && (homing.stage != APP_HOMING_ATTAINED); n++) {
        if (x_cnt >= MARK) {
            angle.reference = APP_ANGLE_INDEX;
            angle.zero_cnt  = MARK;
        }
        (void)step();
    }
    TEST_ASSERT_INT32_WITHIN(1, MARK, app_position_cnt(&position, &homing.zero));
    TEST_ASSERT_TRUE(x_cnt < (MARK + 100));
}

static void test_the_present_position_is_home_without_a_motion(void)
{
    static const int methods[2] = {35, 37};

    for (int k = 0; k < 2; k++) {
        TEST_ASSERT_INT32_WITHIN(0, 4321, home(methods[k], 4321.0));
        TEST_ASSERT_TRUE(fabs(x_cnt - 4321.0) < 1.0e-9);
    }
}

/* During a correction by the index the zero is found where home is after it. */
static void test_a_correction_does_not_move_home(void)
{
    for (left_cnt = -60; left_cnt <= 60; left_cnt += 40) {
        angle.correct_ticks    = 300U;
        angle.correct_step_rad = (float)left_cnt * angle.rad_per_cnt / 300.0f;
        TEST_ASSERT_INT32_WITHIN(0, 4321, home(37, 4321.0));
        TEST_ASSERT_INT32_WITHIN(1, next_mark(4321.0, 1), home(34, 4321.0));
    }
}

static void test_the_zero_is_beside_home_by_the_offset(void)
{
    wanted.home_offset_cnt = -250;
    TEST_ASSERT_INT32_WITHIN(0, 4321 - 250, home(37, 4321.0));
}

static void test_it_begins_when_the_bit_rises_and_ends_when_it_falls(void)
{
    wanted.homing_method = 34;
    wanted.controlword   = APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT;
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, step()); /* it was high before */
    TEST_ASSERT_EQUAL_INT(APP_HOMING_IDLE, homing.stage);
    start(34);
    TEST_ASSERT_TRUE(step() > 0.0f);
    wanted.controlword = APP_CONTROL_ENABLE_OPERATION;
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, step());
    TEST_ASSERT_EQUAL_INT(APP_HOMING_IDLE, homing.stage);
    TEST_ASSERT_FALSE(homing.fresh);
    TEST_ASSERT_INT32_WITHIN(0, 77, home(37, 77.0));
    wanted.controlword = APP_CONTROL_ENABLE_OPERATION;
    (void)step();
    TEST_ASSERT_EQUAL_INT(APP_HOMING_ATTAINED, homing.stage); /* and stays so */
}

static int fails_after(int method, double from_cnt)
{
    int n = 0;

    place(from_cnt);
    app_homing_reset(&homing);
    start(method);
    for (; (n < 70000) && (homing.stage != APP_HOMING_FAILED); n++) {
        (void)step();
        TEST_ASSERT_TRUE(homing.stage != APP_HOMING_ATTAINED);
    }
    TEST_ASSERT_EQUAL_INT(APP_HOMING_FAILED, homing.stage);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, step());
    TEST_ASSERT_FALSE(homing.fresh);
    return n;
}

static void test_without_its_input_it_fails_at_once(void)
{
    wanted.inputs_used = (uint16_t)(7 - BOARD_INPUT_HOME);
    TEST_ASSERT_INT_WITHIN(1, 1, fails_after(7, 0.0));
    wanted.inputs_used = (uint16_t)(7 - BOARD_INPUT_NEGATIVE);
    TEST_ASSERT_INT_WITHIN(1, 1, fails_after(17, 0.0));
    wanted.inputs_used = 7U;
    TEST_ASSERT_INT_WITHIN(1, 1, fails_after(15, 0.0)); /* no such method */
    position.known = false;
    TEST_ASSERT_INT_WITHIN(1, 1, fails_after(37, 0.0));
}

static void test_a_limit_switch_in_the_way_ends_it(void)
{
    form = ABOVE; /* never active: the axis is below it, and method 5 goes back */
    (void)fails_after(5, 0.0);
    TEST_ASSERT_TRUE(x_cnt > (NEGATIVE_LIMIT - 2000));
    form   = SHORT; /* a second limit switch, after the one that reverses */
    forced = BOARD_INPUT_NEGATIVE;
    (void)fails_after(7, 20000.0);
    forced = 0U;
    (void)fails_after(34, POSITIVE_LIMIT); /* on it already */
}

static void test_its_time_ends_it(void)
{
    wanted.homing_time_s       = 1.5f;
    wanted.homing_zero_e_radps = 0.0f;
    TEST_ASSERT_INT_WITHIN(2, 1501, fails_after(34, 0.0));
}

static void test_lost_counts_end_it(void)
{
    place(0.0);
    start(34);
    TEST_ASSERT_TRUE(step() > 0.0f);
    position.known = false;
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, step());
    TEST_ASSERT_EQUAL_INT(APP_HOMING_FAILED, homing.stage);
}

/* A zero so far away that a target from there could not be counted. */
static void test_a_zero_beyond_all_turns_is_refused(void)
{
    position.zero.turns = APP_POSITION_ZERO_TURNS - 10L;
    (void)home(37, 0.0);
    wanted.home_offset_cnt = 11L * TURN / PAIRS;
    TEST_ASSERT_INT_WITHIN(1, 1, fails_after(37, 0.0));
}

static void test_these_methods_exist(void)
{
    for (int method = -200; method <= 200; method++) {
        const bool with = ((method >= 1) && (method <= 14)) || ((method >= 17) && (method <= 30));
        const bool one  = (method == 33) || (method == 34) || (method == 35) || (method == 37);

        TEST_ASSERT_EQUAL_INT(with || one, app_homing_knows((int16_t)method));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_method_finds_its_edge_and_its_mark_from_everywhere);
    RUN_TEST(test_and_so_it_does_for_an_operator_who_is_turned_round);
    RUN_TEST(test_the_next_mark_is_found_in_both_directions);
    RUN_TEST(test_the_first_mark_after_an_alignment_is_home);
    RUN_TEST(test_the_present_position_is_home_without_a_motion);
    RUN_TEST(test_a_correction_does_not_move_home);
    RUN_TEST(test_the_zero_is_beside_home_by_the_offset);
    RUN_TEST(test_it_begins_when_the_bit_rises_and_ends_when_it_falls);
    RUN_TEST(test_without_its_input_it_fails_at_once);
    RUN_TEST(test_a_limit_switch_in_the_way_ends_it);
    RUN_TEST(test_its_time_ends_it);
    RUN_TEST(test_lost_counts_end_it);
    RUN_TEST(test_a_zero_beyond_all_turns_is_refused);
    RUN_TEST(test_these_methods_exist);
    return UNITY_END();
}
