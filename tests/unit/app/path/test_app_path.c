/* SPDX-License-Identifier: MIT */
/* Set-points of a sine at several rates: the path against the sine itself, a period later. */
#include "app_path.h"

#include <math.h>
#include <string.h>

#include "unit_support.h"
#include "unity.h"

#define PI        3.14159265358979323846
#define PAIRS     2.0
#define COUNTS    10000.0
#define CNT_rad   (2.0 * PI * PAIRS / COUNTS) /* electrical */
#define TURNS     2.0
#define MOST_rad  (TURNS * 2.0 * PI * PAIRS)
#define CIRCLE    (2.0 * PI) /* a turn of the sine, which has 1 Hz */
#define INERTIA   0.00042    /* of the shipped drive [kg m^2] */
#define RATED_Nm  1.5
#define TS_s      2.0e-4
#define SPEED_MAX 1150.0f
#define ACCEL_MAX 6600.0f
#define JERK_MAX  1.3e6f
#define FROM_s    1.5 /* the filter has settled */

static support_random_t  random_state;
static app_path_t        path;
static position_t        shaft;
static position_motion_t now;
static double            time_s;
static position_motion_t before;
static double            jerk_seen; /* largest change of the acceleration over time */
static double            accel_seen;
static double            speed_seen;

static void set_up_with(float period_s)
{
    const app_path_aim_t aim = {
        .track = {.period_s = period_s, .speed_e_radps = SPEED_MAX, .accel_e_radps2 = ACCEL_MAX},
        .jerk_e_radps3 = JERK_MAX};
    const position_t at = {0, 0.0f};

    (void)memset(&path, 0xFF,
                 sizeof path); /* the end of a run and its begin have to set everything */
    path.aim = aim;
    app_path_end(&path);
    random_state.state = 1u;
    shaft              = at;
    time_s             = 0.0;
    jerk_seen          = 0.0;
    accel_seen         = 0.0;
    speed_seen         = 0.0;
}

void setUp(void)
{
    set_up_with(0.02f);
}

void tearDown(void) {}

static position_t position_of(double counts)
{
    const double     x_rad = counts * CNT_rad;
    const double     turns = round(x_rad / (2.0 * PI));
    const position_t at    = {(int32_t)turns, (float)(x_rad - (turns * 2.0 * PI))};

    return at;
}

static double counts_of(const position_t *at)
{
    return ((2.0 * PI * (double)at->turns) + (double)at->theta_e_rad) / CNT_rad;
}

static void give(double counts)
{
    path.aim.point.at = position_of(round(counts));
    path.aim.fresh    = true;
}

/* A period with a shaft that follows at once. */
static void tick(void)
{
    const position_t was = shaft;

    before = now;
    app_path_tick(&path, &shaft, (float)TS_s, &now);
    shaft = now.at;
    time_s += TS_s;
    if (time_s > (1.5 * TS_s)) {
        jerk_seen =
            fmax(jerk_seen,
                 fabs((double)now.omega_dot_e_radps2 - (double)before.omega_dot_e_radps2) / TS_s);
    }
    accel_seen = fmax(accel_seen, fabs((double)now.omega_dot_e_radps2));
    speed_seen = fmax(speed_seen, fabs((double)position_way_rad(&was, &now.at)) / TS_s);
}

static void pass(double length_s)
{
    for (const double end_s = time_s + length_s; time_s < (end_s - (0.5 * TS_s));) {
        tick();
    }
}

typedef struct {
    double rms_cnt;
    double most_cnt;
    double ripple; /* largest torque beside the sine's, of the rated one */
} offset_t;

static double sine_cnt(double at_s)
{
    return MOST_rad / CNT_rad * sin(CIRCLE * at_s);
}

/* How a sine of set-points comes out, against the sine a period later. */
static offset_t follow(double period_s, bool given, double jitter, int lost_each)
{
    const double length_s = 6.0;
    offset_t     off      = {0.0, 0.0, 0.0};
    double       sum      = 0.0;
    int          n        = 0;
    int          k        = 1;
    double       next_s   = period_s;

    set_up_with((float)period_s);
    path.aim.point.given = given;
    while (time_s < length_s) {
        if (time_s >= (next_s - (0.5 * TS_s))) {
            const double speed = MOST_rad * CIRCLE * cos(CIRCLE * (double)k * period_s);
            const double step  = 0.1 / 60.0 * 2.0 * PI * PAIRS; /* of 60B1h */

            if ((lost_each == 0) || ((k % lost_each) != 0)) {
                give(sine_cnt((double)k * period_s));
                path.aim.point.omega_e_radps = (float)(round(speed / step) * step);
            }
            k++;
            next_s = period_s *
                     ((double)k + (jitter * (double)support_uniform(&random_state, -1.0f, 1.0f)));
        }
        tick();
        if (time_s >
            FROM_s) { /* a tick gives the motion at its end; it sees a set-point at its begin */
            const double at_s = time_s - TS_s - period_s;
            const double d    = counts_of(&now.at) - sine_cnt(at_s);
            const double a =
                (double)now.omega_dot_e_radps2 + (MOST_rad * CIRCLE * CIRCLE * sin(CIRCLE * at_s));

            sum += d * d;
            n++;
            off.most_cnt = fmax(off.most_cnt, fabs(d));
            off.ripple   = fmax(off.ripple, fabs(a) * INERTIA / PAIRS / RATED_Nm);
        }
    }
    off.rms_cnt = sqrt(sum / (double)n);
    return off;
}

static void test_a_sine_comes_out_a_period_later(void)
{
    static const struct {
        double period_s;
        double rms_cnt; /* with the speeds not given */
        double ripple;
        double given_cnt; /* and given */
        double given_ripple;
    } rates[] = {{0.001, 1.0, 0.01, 0.5, 0.002},
                 {0.005, 0.7, 0.01, 0.4, 0.004},
                 {0.02, 0.7, 0.01, 0.7, 0.004},
                 {0.05, 7.0, 0.03, 5.0, 0.008},
                 {0.1, 90.0, 0.09, 25.0, 0.02}};

    for (int i = 0; i < SUPPORT_COUNT(rates); i++) {
        const offset_t off = follow(rates[i].period_s, false, 0.0, 0);
        TEST_ASSERT_TRUE(off.rms_cnt <= rates[i].rms_cnt);
        TEST_ASSERT_TRUE(off.ripple <= rates[i].ripple);
        const offset_t with = follow(rates[i].period_s, true, 0.0, 0);
        TEST_ASSERT_TRUE(with.rms_cnt <= rates[i].given_cnt);
        TEST_ASSERT_TRUE(with.ripple <= rates[i].given_ripple);
        TEST_ASSERT_TRUE(jerk_seen <= (1.001 * (double)JERK_MAX));
        TEST_ASSERT_FALSE(path.lost);
    }
}

static void test_jitter_and_loss_cost_a_tenth_of_a_period(void)
{
    static const double periods_s[] = {0.001, 0.005, 0.02, 0.05, 0.1};

    for (int i = 0; i < SUPPORT_COUNT(periods_s); i++) {
        const double   steepest = sine_cnt(0.25) * CIRCLE; /* counts in a second */
        const offset_t off      = follow(periods_s[i], false, 0.3, 100);
        TEST_ASSERT_TRUE(off.most_cnt <= (steepest * ((0.1 * periods_s[i]) + (1.5 * TS_s))));
        TEST_ASSERT_TRUE(jerk_seen <= (1.1 * (double)JERK_MAX));
        TEST_ASSERT_FALSE(path.lost);
    }
}

/* A line far from zero: each set-point is where the path is a period later, to a part of a count. */
static void test_a_line_is_passed_through_after_any_number_of_turns(void)
{
    const double from_cnt = 9.0e8;
    const double each_cnt = 123.0;

    shaft = position_of(from_cnt);
    for (int k = 0; k < 200; k++) {
        give(from_cnt + (each_cnt * (double)k));
        pass(0.02);
        if (k > 20) {
            const double later = 1.0 - (TS_s / 0.02); /* the newest came a period less a tick ago */
            TEST_ASSERT_DOUBLE_WITHIN(1.0, from_cnt + (each_cnt * ((double)k - 1.0 + later)),
                                      counts_of(&now.at));
            TEST_ASSERT_FLOAT_WITHIN(0.05f, (float)(each_cnt * CNT_rad / 0.02), now.omega_e_radps);
        }
    }
}

static void test_without_a_set_point_the_path_comes_to_rest_within_its_limits(void)
{
    const position_t at    = shaft;
    path.aim.start_e_radps = 600.0f;
    tick();
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, (float)(600.0 * TS_s), position_way_rad(&at, &now.at));
    pass(1.0);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, now.omega_e_radps);
    TEST_ASSERT_TRUE(accel_seen <= (1.01 * (double)ACCEL_MAX));
    TEST_ASSERT_TRUE(jerk_seen <= (1.05 * (double)JERK_MAX));
    TEST_ASSERT_FALSE(path.lost);
    const double rest_cnt = counts_of(&now.at);
    pass(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, rest_cnt, counts_of(&now.at));
}

static void test_a_step_of_the_set_points_takes_the_time_that_the_limits_need(void)
{
    static const double steps_cnt[] = {-3000.0, 800000.0};

    for (int i = 0; i < SUPPORT_COUNT(steps_cnt); i++) {
        setUp();
        for (int k = 0; k < 400; k++) {
            give((k < 20) ? 0.0 : steps_cnt[i]);
            pass(0.02);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1.0, steps_cnt[i], counts_of(&now.at));
        TEST_ASSERT_FLOAT_WITHIN(0.1f, 0.0f, now.omega_e_radps);
        TEST_ASSERT_TRUE(speed_seen <= (1.02 * (double)SPEED_MAX)); /* floats of an angle */
        TEST_ASSERT_TRUE(accel_seen <= (1.05 * (double)ACCEL_MAX));
        TEST_ASSERT_TRUE(jerk_seen <= (1.1 * (double)JERK_MAX));
    }
}

static void test_it_runs_on_for_its_time_and_then_says_that_it_is_lost(void)
{
    const double each_cnt = 200.0;

    for (int k = 0; k < 50; k++) {
        give(each_cnt * (double)k);
        pass(0.02);
    }
    pass(0.06 - (2.0 * TS_s)); /* the last 20 ms were the first of 80 */
    TEST_ASSERT_FALSE(path.lost);
    TEST_ASSERT_FLOAT_WITHIN(0.1f, (float)(each_cnt * CNT_rad / 0.02), now.omega_e_radps);
    /* 80 ms less three ticks after the last one came, the path is a period before that */
    TEST_ASSERT_DOUBLE_WITHIN(2.0, each_cnt * (49.0 + ((0.06 - (3.0 * TS_s)) / 0.02)),
                              counts_of(&now.at));
    pass(4.0 * TS_s);
    TEST_ASSERT_TRUE(path.lost);
    pass(5.0);
    TEST_ASSERT_FLOAT_WITHIN(0.5f, (float)(each_cnt * CNT_rad / 0.02), now.omega_e_radps);
    app_path_end(&path);
    TEST_ASSERT_FALSE(path.lost);
}

static void test_after_two_periods_without_set_points_the_speed_stays(void)
{
    for (int k = 0; k < 50; k++) {
        give(5.0 * (double)(k * k));
        pass(0.02);
    }
    TEST_ASSERT_TRUE((double)now.omega_dot_e_radps2 > (0.9 * 10.0 * CNT_rad / 4.0e-4));
    pass(0.2);
    const float speed_e_radps = now.omega_e_radps;
    TEST_ASSERT_DOUBLE_WITHIN(20.0, 5.0 * 2.0 * 51.0, (double)speed_e_radps * 0.02 / CNT_rad);
    pass(0.2);
    TEST_ASSERT_FLOAT_WITHIN(0.1f, speed_e_radps, now.omega_e_radps);
}

static void test_the_first_set_point_may_come_late(void)
{
    pass(1.0);
    give(0.0);
    pass(0.02);
    TEST_ASSERT_FALSE(path.lost);
}

/* It comes three fifths of a period early. The one before it keeps its place and its time. */
static void test_an_early_set_point_waits(void)
{
    for (int k = 0; k < 60; k++) {
        give(0.0);
        pass((k < 59) ? 0.02 : 0.008);
    }
    give(500.0);
    pass(0.012);
    TEST_ASSERT_DOUBLE_WITHIN(3.0, 0.0, counts_of(&now.at));
    pass(0.021);
    TEST_ASSERT_DOUBLE_WITHIN(60.0, 500.0, counts_of(&now.at));
}

/* A ramp of 2000 counts in a second, at another rate than the period's. Some of it is lost. Then the
 * master stays there. */
static void run_to_2000(float period_s, double rate, double lost, bool given)
{
    const double each_s = (double)period_s / rate;
    const double end_s  = 1.8 + (60.0 * (each_s + (double)period_s));
    double       next_s = 0.0;

    set_up_with(period_s);
    path.aim.point.given = given;
    while (time_s < end_s) {
        if (time_s >= next_s) {
            if (support_uniform(&random_state, 0.0f, 1.0f) >= (float)lost) {
                give(2000.0 * fmin(time_s, 1.0));
                path.aim.point.omega_e_radps = (time_s < 1.0) ? (float)(2000.0 * CNT_rad) : 0.0f;
            }
            next_s += each_s * (1.0 + (0.3 * (double)support_uniform(&random_state, -1.0f, 1.0f)));
        }
        tick();
    }
}

static void test_set_points_at_another_rate_are_reached(void)
{
    static const float  periods_s[] = {0.001f, 0.002f, 0.005f, 0.01f, 0.02f, 0.05f, 0.1f};
    static const double lost[]      = {0.0, 0.2, 0.5};

    for (int i = 0; i < SUPPORT_COUNT(periods_s); i++) {
        for (double slow = 0.3; slow < 4.0; slow += 0.1) {
            for (int n = 0; n < 2 * SUPPORT_COUNT(lost); n++) {
                run_to_2000(periods_s[i], 1.0 / slow, lost[n / 2], (n % 2) != 0);
                TEST_ASSERT_DOUBLE_WITHIN(1.0, 2000.0, counts_of(&now.at));
                TEST_ASSERT_FLOAT_WITHIN(0.1f, 0.0f, now.omega_e_radps);
                if (n < 2) { /* nothing is lost */
                    TEST_ASSERT_TRUE(speed_seen <= (15.0 * 2000.0 * CNT_rad));
                }
            }
        }
    }
}

static void test_three_set_points_make_a_parabola(void)
{
    for (int k = 0; k < 3; k++) {
        give(100.0 * (double)(k * k));
        pass(0.02 - TS_s);
        tick();
    }
    path.aim.fresh = false;
    TEST_ASSERT_FLOAT_WITHIN(0.01f, (float)(400.0 * CNT_rad), path.track.s[0]);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, (float)(100.0 * CNT_rad), path.track.s[1]);
}

static void test_fast_set_points_may_pause_for_20_ms(void)
{
    set_up_with(0.001f);
    for (int k = 0; k < 50; k++) {
        give(0.0);
        pass(0.001);
    }
    pass(0.018);
    TEST_ASSERT_FALSE(path.lost);
    pass(0.002);
    TEST_ASSERT_TRUE(path.lost);
}

static void test_a_following_error_deviates_after_its_time(void)
{
    path.aim.window_rad = (float)(10.0 * CNT_rad);
    path.aim.time_out_s = 0.01f;
    pass(0.1);
    for (int n = 0; n < 200; n++) {
        const position_t away = position_of((n < 100) ? 9.0 : -11.0);
        app_path_tick(&path, &away, (float)TS_s, &now);
        TEST_ASSERT_EQUAL_INT(n >= 100, path.beyond_s > 0.0f);
        TEST_ASSERT_EQUAL_INT(n >= 150, path.deviates); /* sums of a period round down */
    }
    app_path_end(&path);
    TEST_ASSERT_FALSE(path.deviates);
    path.aim.window_rad = 0.0f; /* any */
    for (int n = 0; n < 200; n++) {
        const position_t away = position_of(1.0e6 * (double)n);
        app_path_tick(&path, &away, (float)TS_s, &now);
        TEST_ASSERT_FALSE(path.deviates);
    }
}

static void test_a_way_moves_a_position_by_its_turns(void)
{
    static const double ways_rad[] = {0.0, 3.0, -3.5, 6.2, -6.4, 100.0, -1234.5};

    for (int i = 0; i < SUPPORT_COUNT(ways_rad); i++) {
        const position_t from = {5, -2.0f};
        const position_t to   = app_track_moved(&from, (float)ways_rad[i]);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-4f, (float)ways_rad[i], position_way_rad(&from, &to));
        TEST_ASSERT_TRUE(position_ok(&to));
    }
    const position_t last = {POSITION_TURNS_MAX, 1.0f};
    const position_t to   = app_track_moved(&last, 100.0f);
    TEST_ASSERT_TRUE(position_ok(&to));
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        const position_t bad = app_track_moved(&last, support_not_finite[k]);
        TEST_ASSERT_TRUE(bad.turns <= POSITION_TURNS_MAX);
    }
}

/* drive_tick() refuses such a speed or position: unit.position_run. */
static void test_a_number_that_is_none_shows_in_the_motion(void)
{
    float *const numbers[] = {&path.c[1], &path.c[2], &path.c[3],  &path.c[4],
                              &path.c[5], &path.u,    &path.per_s, &path.from.theta_e_rad};

    for (int i = 0; i < SUPPORT_COUNT(numbers); i++) {
        setUp();
        for (int k = 0; k < 10; k++) {
            give(100.0 * (double)k);
            pass(0.02);
        }
        TEST_ASSERT_TRUE(base_within(now.omega_e_radps, SPEED_MAX));
        pass(5.0 * TS_s);
        *numbers[i] = NAN;
        tick();
        TEST_ASSERT_FALSE(base_within(now.omega_e_radps, SPEED_MAX) && position_ok(&now.at));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sine_comes_out_a_period_later);
    RUN_TEST(test_jitter_and_loss_cost_a_tenth_of_a_period);
    RUN_TEST(test_a_line_is_passed_through_after_any_number_of_turns);
    RUN_TEST(test_without_a_set_point_the_path_comes_to_rest_within_its_limits);
    RUN_TEST(test_a_step_of_the_set_points_takes_the_time_that_the_limits_need);
    RUN_TEST(test_it_runs_on_for_its_time_and_then_says_that_it_is_lost);
    RUN_TEST(test_after_two_periods_without_set_points_the_speed_stays);
    RUN_TEST(test_the_first_set_point_may_come_late);
    RUN_TEST(test_an_early_set_point_waits);
    RUN_TEST(test_set_points_at_another_rate_are_reached);
    RUN_TEST(test_three_set_points_make_a_parabola);
    RUN_TEST(test_fast_set_points_may_pause_for_20_ms);
    RUN_TEST(test_a_following_error_deviates_after_its_time);
    RUN_TEST(test_a_number_that_is_none_shows_in_the_motion);
    RUN_TEST(test_a_way_moves_a_position_by_its_turns);
    return UNITY_END();
}
