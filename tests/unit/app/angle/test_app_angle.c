/* SPDX-License-Identifier: MIT */
#include "app_angle.h"

#include <math.h>
#include <string.h>

#include "board_config.h"
#include "encoder_form.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_RAD   2.0e-6 /* rad, up to 2 pi; worst 5e-7 */
#define TOL_RADPS 1.0e-2 /* rad/s, up to 31 krad/s; worst 2e-3 */
#define TS_S      200.0e-6f

static const double two_pi = 6.283185307179586;

static app_angle_config_t config;
static drive_config_t     drive;
static app_angle_t        angle;

void setUp(void)
{
    (void)memset(&angle, 0xFF, sizeof angle); /* init has to set everything */
    config                           = board_config.angle;
    drive.ts_s                       = TS_S;
    drive.hardware.pole_pairs        = 2U;
    drive.hardware.encoder_positions = 10000UL;
    drive.hardware.edge_times        = false;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_angle_init(&angle, &config, &drive));
}

void tearDown(void) {}

static app_angle_reading_t read_angle(const board_sample_t *raw)
{
    app_angle_reading_t reading;

    (void)memset(&reading, 0xFF, sizeof reading); /* an update has to set everything */
    app_angle_update(&angle, raw, &reading);
    return reading;
}

static app_angle_reading_t at(int position)
{
    const board_sample_t raw = {.position_cnt = (uint16_t)position, .valid = true};
    return read_angle(&raw);
}

static app_angle_reading_t at_with_index(int position, int index)
{
    const board_sample_t raw = {.position_cnt = (uint16_t)position,
                                .index_cnt    = (uint16_t)index,
                                .index_seen   = true,
                                .valid        = true};
    return read_angle(&raw);
}

static void start_over(uint16_t pole_pairs, float index_theta_rad)
{
    drive.hardware.pole_pairs = pole_pairs;
    config.index_theta_e_rad  = index_theta_rad;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_angle_init(&angle, &config, &drive));
}

static void assert_angle(double expected_rad, float actual_rad)
{
    TEST_ASSERT_TRUE(base_in_range(actual_rad, 0.0f, BASE_TWO_PI));
    TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, 0.0, remainder((double)actual_rad - expected_rad, two_pi));
}

static void test_angle_means_nothing_before_the_first_index(void)
{
    for (int position = 0; position < 10000; position += 7) {
        (void)at(position);
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
    }
}

static void test_index_refers_the_angle_at_every_position(void)
{
    static const int   pairs[] = {1, 2, 3, 7, 64};
    static const float marks[] = {0.0f, 0.7f, 3.2f, 6.28f};
    for (int p = 0; p < SUPPORT_COUNT(pairs); p++) {
        for (int k = 0; k < SUPPORT_COUNT(marks); k++) {
            for (int index = 0; index < 10000; index += 3333) {
                start_over((uint16_t)pairs[p], marks[k]);
                (void)at_with_index(index, index);
                TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
                for (int position = 0; position < 10000; position += 11) {
                    const double turns = ((double)(position - index) + 0.5) / 10000.0;
                    assert_angle((double)marks[k] + (pairs[p] * two_pi * turns),
                                 at(position).theta_e_rad);
                }
            }
        }
    }
}

static void test_counts_are_within_a_limit_up_to_both_ends(void)
{
    static const int32_t numbers[] = {
        INT32_MIN, INT32_MIN + 1, -65536, -101,  -100,     -99, -1, 0, 1,
        99,        100,           101,    65536, INT32_MAX};
    static const int32_t limits[] = {0, 1, 100, 65536, INT32_MAX};
    for (int i = 0; i < SUPPORT_COUNT(numbers); i++) {
        for (int k = 0; k < SUPPORT_COUNT(limits); k++) {
            const int64_t cnt = numbers[i];
            TEST_ASSERT_EQUAL_INT((cnt <= limits[k]) && (cnt >= -(int64_t)limits[k]),
                                  app_angle_cnt_within(numbers[i], limits[k]));
        }
    }
}

/* Every pair of positions: the same place, in the shorter direction. */
static void test_turned_counts_take_the_shorter_way(void)
{
    for (int positions = 2; positions < 40; positions++) {
        for (int from = 0; from < positions; from++) {
            for (int to = 0; to < positions; to++) {
                const int turned =
                    app_angle_turned_cnt((uint16_t)positions, (uint16_t)from, (uint16_t)to);
                TEST_ASSERT_EQUAL_INT(0, (from + turned - to) % positions);
                TEST_ASSERT_TRUE((2 * turned <= positions) && (-2 * turned <= positions));
                if (2 * (to - from) == positions || 2 * (from - to) == positions) {
                    TEST_ASSERT_EQUAL_INT(to - from, turned); /* neither way is shorter */
                }
            }
        }
    }
    TEST_ASSERT_EQUAL_INT(-1, app_angle_turned_cnt(65535U, 0U, 65534U));
    TEST_ASSERT_EQUAL_INT(1, app_angle_turned_cnt(65535U, 65534U, 0U));
}

static void test_speed_is_the_difference_of_positions_either_way_round(void)
{
    static const int from[] = {0, 1, 4999, 5000, 9998, 9999};
    for (int i = 0; i < SUPPORT_COUNT(from); i++) {
        for (int step = -4999; step <= 4999; step += 17) {
            setUp();
            (void)at(from[i]);
            const app_angle_reading_t r = at((from[i] + step + 10000) % 10000);
            TEST_ASSERT_TRUE(r.speed_valid);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS, 2.0 * step * two_pi / (10000.0 * 200.0e-6),
                                      (double)r.omega_e_radps);
        }
    }
}

static void test_first_sample_has_no_speed(void)
{
    const app_angle_reading_t r = at(5000);

    TEST_ASSERT_FALSE(r.speed_valid);
    TEST_ASSERT_TRUE(r.omega_e_radps == 0.0f);
}

static void test_dropped_reference_takes_angle_and_speed_away(void)
{
    (void)at_with_index(100, 50);
    app_angle_drop(&angle);

    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
    TEST_ASSERT_FALSE(at(200).speed_valid);
    TEST_ASSERT_TRUE(at(201).speed_valid);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
}

static void test_alignment_forgets_the_angle_of_the_index(void)
{
    start_over(2U, 1.5f);
    (void)at_with_index(100, 100);
    app_angle_align(&angle, 700U, 0.0f);
    assert_angle(2.0 * two_pi * 0.5 / 10000.0, at(700).theta_e_rad);
}

static void test_before_any_reference_the_position_itself_is_shown(void)
{
    assert_angle(2.0 * two_pi * 10.5 / 10000.0, at(10).theta_e_rad);
}

static void test_alignment_puts_the_zero_here_until_the_index(void)
{
    (void)at(4321);
    app_angle_align(&angle, 4321U, 0.0f);

    TEST_ASSERT_EQUAL_INT(APP_ANGLE_ALIGNED, angle.reference);
    assert_angle(2.0 * two_pi * 0.5 / 10000.0, at(4321).theta_e_rad);
    assert_angle(2.0 * two_pi * 100.5 / 10000.0, at(4421).theta_e_rad);
    assert_angle(2.0 * two_pi * -99.5 / 10000.0, at(4221).theta_e_rad);
}

/* EQ-APP-ANGLE-6 at a standing shaft: equal steps of at most a quarter of a rad/s from one angle to the other, both in counts. */
static void assert_approach(int position, double from_cnt, double to_cnt, float now_rad)
{
    const double per_cnt = 2.0 * two_pi / 10000.0;
    const double way     = (to_cnt - from_cnt) * per_cnt;
    const int    ticks   = (int)floor(fabs(way) / (0.25 * (double)TS_S)) + 1;

    assert_angle((from_cnt * per_cnt) + (way / ticks), now_rad);
    for (int n = 2; n <= ticks; n++) {
        assert_angle((from_cnt * per_cnt) + (way * n / ticks), at(position).theta_e_rad);
    }
    for (int n = 0; n < 3; n++) {
        assert_angle(to_cnt * per_cnt, at(position).theta_e_rad);
    }
    TEST_ASSERT_TRUE(fabs(way) / ticks <= 0.25 * (double)TS_S);
}

/* After alignment the index may be at any of the pole pairs. */
static void test_index_after_alignment_takes_over_within_its_bound(void)
{
    for (int pair = 0; pair < 2; pair++) {
        for (int error = -110; error <= 110; error++) {
            setUp();
            const int index = (4000 + (5000 * pair) + error) % 10000;
            (void)at(4000);
            app_angle_align(&angle, 4000U, 0.0f);

            const app_angle_reading_t r = at_with_index((index + 10) % 10000, index);

            if ((error >= -99) && (error <= 99)) {
                TEST_ASSERT_FALSE(r.index_fault);
                TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
                assert_approach((index + 10) % 10000, 10.5 + error, 10.5, r.theta_e_rad);
            }
            if ((error < -101) || (error > 101)) {
                TEST_ASSERT_TRUE(r.index_fault);
                TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
            }
        }
    }
}

static void test_index_after_alignment_knows_its_own_angle(void)
{
    start_over(2U, 1.5f);
    const int mark = 2000 + (int)lround(1.5 / (2.0 * two_pi) * 10000.0);
    (void)at(2000);
    app_angle_align(&angle, 2000U, 0.0f);

    TEST_ASSERT_FALSE(at_with_index(mark, mark).index_fault);

    start_over(2U, 1.5f);
    app_angle_align(&angle, 2000U, 0.0f);
    TEST_ASSERT_TRUE(at_with_index(2000, 2000).index_fault);
    TEST_ASSERT_EQUAL_UINT(0U, angle.corrections);
}

static void test_alignment_refers_to_the_angle_it_is_given(void)
{
    for (int position = 0; position < 10000; position += 777) {
        start_over(2U, 0.0f);
        app_angle_align(&angle, 2000U, 4.712389f);
        const double counts = fmod((double)position - 2000.0 + 10000.0, 10000.0) + 0.5;
        const double wanted = fmod(4.712389 + (2.0 * counts * two_pi / 10000.0), two_pi);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, wanted, (double)at(position).theta_e_rad);
    }
}

/* 16-bit counts of half a turn either way, whole lines. */
static void test_encoders_that_the_counter_cannot_hold_are_refused(void)
{
    const uint32_t good[] = {16UL, 1024UL, 5000UL, 65532UL};
    const uint32_t bad[]  = {0UL, 2UL, 1023UL, 65536UL, 4000000UL};

    config.index_correct_max_cnt = 3U;
    config.index_tolerance_cnt   = 1U;
    for (int i = 0; i < SUPPORT_COUNT(good); i++) {
        drive.hardware.encoder_positions = good[i];
        TEST_ASSERT_EQUAL_INT(CTL_OK, app_angle_init(&angle, &config, &drive));
        TEST_ASSERT_EQUAL_UINT(encoder_form_places(good[i]), angle.pattern_mask + 1u);
        const uint16_t half = (uint16_t)((good[i] / 2UL) - 1UL);
        TEST_ASSERT_EQUAL_INT((int)half, app_angle_turned_cnt(angle.positions, 0U, half));
        TEST_ASSERT_EQUAL_INT(-1,
                              app_angle_turned_cnt(angle.positions, 0U, (uint16_t)(good[i] - 1UL)));
    }
    for (int i = 0; i < SUPPORT_COUNT(bad); i++) {
        drive.hardware.encoder_positions = bad[i];
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_angle_init(&angle, &config, &drive));
    }
}

static void test_later_index_corrects_or_faults_by_its_distance(void)
{
    for (int error = -5000; error <= 5000; error++) {
        setUp();
        (void)at_with_index(9990, 9990);
        const int                 index    = (9990 + error + 10000) % 10000;
        const int                 position = (index + 20) % 10000;
        const app_angle_reading_t r        = at_with_index(position, index);

        const int distance = (error < 0) ? -error : error;
        if (distance <= 4) {
            TEST_ASSERT_FALSE(r.index_fault);
            TEST_ASSERT_EQUAL_UINT(0U, angle.corrections);
            assert_angle(2.0 * two_pi * (20.5 + error) / 10000.0, r.theta_e_rad);
        } else if (distance <= 100) {
            TEST_ASSERT_FALSE(r.index_fault);
            TEST_ASSERT_EQUAL_UINT(1U, angle.corrections);
            assert_approach(position, 20.5 + error, 20.5, r.theta_e_rad);
        } else {
            TEST_ASSERT_TRUE(r.index_fault);
            TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
        }
    }
}

static void test_correction_does_not_show_in_the_speed(void)
{
    (void)at_with_index(100, 0);
    const app_angle_reading_t r = at_with_index(110, 80);

    TEST_ASSERT_EQUAL_UINT(1U, angle.corrections);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS, 2.0 * 10.0 * two_pi / 2.0, (double)r.omega_e_radps);
}

static void test_corrections_are_counted_until_the_start(void)
{
    (void)at_with_index(0, 0);
    for (int n = 1; n <= 5; n++) {
        (void)at_with_index(10 * n, 10 * n);
        TEST_ASSERT_EQUAL_UINT((unsigned)n, angle.corrections);
    }
    setUp();
    TEST_ASSERT_EQUAL_UINT(0U, angle.corrections);
}

/* A correction goes on over the next turn, and another one begins where it has come to. */
static void test_correction_begins_where_the_one_before_is(void)
{
    (void)at_with_index(100, 0);
    (void)at_with_index(100, 80);
    const float before_rad = at(100).theta_e_rad;
    const float then_rad   = at_with_index(100, 40).theta_e_rad;

    TEST_ASSERT_EQUAL_UINT(2U, angle.corrections);
    TEST_ASSERT_DOUBLE_WITHIN(1.01 * (double)TS_S, (double)before_rad, (double)then_rad);
    for (int n = 0; n < 3000; n++) {
        (void)at(100);
    }
    assert_angle(2.0 * two_pi * 60.5 / 10000.0, at(100).theta_e_rad);
}

static void test_alignment_and_a_first_index_end_a_correction(void)
{
    (void)at_with_index(100, 0);
    (void)at_with_index(100, 80);
    app_angle_align(&angle, 100U, 0.0f);
    (void)at(100);
    assert_angle(2.0 * two_pi * 0.5 / 10000.0, at(100).theta_e_rad);

    setUp();
    (void)at_with_index(100, 0);
    (void)at_with_index(100, 80);
    app_angle_drop(&angle);
    assert_angle(2.0 * two_pi * 10.5 / 10000.0, at_with_index(100, 90).theta_e_rad);
    assert_angle(2.0 * two_pi * 10.5 / 10000.0, at(100).theta_e_rad);
}

static void test_index_fault_lasts_one_sample(void)
{
    (void)at_with_index(0, 0);
    TEST_ASSERT_TRUE(at_with_index(1000, 1000).index_fault);
    TEST_ASSERT_FALSE(at(1001).index_fault);
    TEST_ASSERT_FALSE(at_with_index(1010, 1005).index_fault);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
}

/* A shaft that passes whole positions as the test says: samples with the times of its last edges. */
static double shaft_cnt; /* positions, real */
static double edge_time; /* of the last edge */
static double now_time;

static app_angle_reading_t turn(double radps_e)
{
    const double per_cnt = 2.0 * two_pi / 10000.0;
    const double before  = shaft_cnt;

    now_time += (double)TS_S;
    shaft_cnt += radps_e * (double)TS_S / per_cnt;
    const bool   moved = floor(shaft_cnt) < floor(before) || floor(shaft_cnt) > floor(before);
    const double edge  = (radps_e > 0.0) ? floor(shaft_cnt) : (floor(shaft_cnt) + 1.0);
    if (moved) {
        edge_time = now_time - ((shaft_cnt - edge) * per_cnt / radps_e);
    }
    const double         wrapped = fmod(fmod(floor(shaft_cnt), 10000.0) + 10000.0, 10000.0);
    const board_sample_t raw     = {.position_cnt = (uint16_t)wrapped,
                                    .edge_age_cnt =
                                        (uint16_t)fmod((now_time - edge_time) * 75.0e6, 65536.0),
                                    .edge_seen = moved,
                                    .valid     = true};
    return read_angle(&raw);
}

static void start_edges(double at_cnt)
{
    drive.hardware.edge_times = true;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_angle_init(&angle, &config, &drive));
    app_angle_align(&angle, 0U, 0.0f);
    shaft_cnt = at_cnt;
    edge_time = 0.0;
    now_time  = 0.0;
    (void)turn(0.0);
}

/* One tick of the capture timer is 13 ns: at 1500 rad/s 2e-5 rad, and 1e-4 of the speed of one count per period. */
static void test_edge_times_give_angle_and_speed(void)
{
    static const double speeds[] = {1500.0, 400.0, 50.0, 6.5, -6.5, -400.0, -1500.0};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        start_edges(4321.7);
        for (int n = 0; n < 2000; n++) {
            const app_angle_reading_t r     = turn(speeds[i]);
            const double              theta = shaft_cnt * 2.0 * two_pi / 10000.0;
            const double              off   = remainder((double)r.theta_e_rad - theta, two_pi);
            if (r.band_rad > 0.0f) { /* no edge in this period */
                TEST_ASSERT_EQUAL_INT(0, r.edge_of_pattern);
                TEST_ASSERT_TRUE((fabs(speeds[i]) < 10.0) || (n < 3));
                TEST_ASSERT_TRUE(fabs(off) <= (double)r.band_rad + TOL_RAD);
            } else if (n > 3) {
                const double passed =
                    (speeds[i] > 0.0) ? floor(shaft_cnt) : (floor(shaft_cnt) + 1.0);
                TEST_ASSERT_EQUAL_INT(1 + (int)fmod(fmod(passed, 16.0) + 16.0, 16.0),
                                      r.edge_of_pattern);
                TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD + (fabs(speeds[i]) * 1.4e-8), 0.0, off);
                TEST_ASSERT_DOUBLE_WITHIN(fabs(speeds[i]) * 2.0e-4, speeds[i],
                                          (double)r.omega_e_radps);
            }
        }
    }
}

/* After a change of direction the capture has no time. The edge is taken in the middle of its
 * period, and its place within the line is not learned. */
static void test_an_edge_without_a_time_is_none_of_a_line(void)
{
    start_edges(4321.7);
    app_angle_reading_t before = turn(20.0);
    for (int n = 0; (n < 200) || (before.edge_of_pattern == 0); n++) {
        before = turn(20.0);
    }
    const board_sample_t raw = {
        .position_cnt = (uint16_t)(floor(shaft_cnt) + 1.0), .edge_seen = false, .valid = true};

    const app_angle_reading_t r = read_angle(&raw);

    TEST_ASSERT_EQUAL_INT(0, r.edge_of_pattern);
    TEST_ASSERT_TRUE(r.edge_gap_s > 0.0f);
    TEST_ASSERT_TRUE(r.band_rad == 0.0f);
}

/* Backwards below the angle's zero, with an edge passed long before the sample: the angle stays within a turn. */
static void test_an_angle_below_zero_wraps(void)
{
    const uint16_t late_cnt = (uint16_t)(0.9 * (double)TS_S * 75.0e6);
    board_sample_t raw      = {.position_cnt = 7U, .edge_seen = true, .valid = true};
    start_edges(12.5);
    (void)read_angle(&raw);
    raw.position_cnt = 2U;
    (void)read_angle(&raw);
    raw.position_cnt = 0U;
    raw.edge_age_cnt = late_cnt;

    const double theta = (double)read_angle(&raw).theta_e_rad;

    TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, two_pi - (0.5 * 2.0 * two_pi / 10000.0), theta);
}

/* EQ-APP-ANGLE-5: counts alone tell the angle to what the shaft turns in half a period; without one it is within the count. */
static void test_counts_that_come_one_at_a_time_tell_more_than_their_middle(void)
{
    static const double speeds[] = {1.5, 1.0, 0.3, -0.3, -1.0, -1.5};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        start_edges(4321.7);
        drive.hardware.edge_times = false;
        angle.edge_times          = false;
        int singles               = 0;
        for (int n = 0; n < 4000; n++) {
            const app_angle_reading_t r     = turn(speeds[i]);
            const double              theta = shaft_cnt * 2.0 * two_pi / 10000.0;
            const double              off   = remainder((double)r.theta_e_rad - theta, two_pi);
            const double              count = 2.0 * two_pi / 10000.0;
            TEST_ASSERT_EQUAL_INT(0, r.edge_of_pattern);
            if ((n > 20) && (r.band_rad > 0.0f)) {
                TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, 0.5 * count, (double)r.band_rad);
                TEST_ASSERT_TRUE(fabs(off) <= (double)r.band_rad + TOL_RAD);
                TEST_ASSERT_TRUE(r.edge_gap_s > 0.0f);
            } else if (n > 100) {
                singles++;
                const double gap_s = count / fabs(speeds[i]);
                TEST_ASSERT_TRUE(fabs(off) <= (1.0 * fabs(speeds[i]) * (double)TS_S) + TOL_RAD);
                TEST_ASSERT_DOUBLE_WITHIN((double)TS_S, gap_s, (double)r.edge_gap_s);
            }
        }
        TEST_ASSERT_TRUE(singles > 100);
    }
}

static void test_counts_that_come_in_plenty_have_a_band_of_a_quarter(void)
{
    const double count = 2.0 * two_pi / 10000.0;
    (void)at(100);
    for (int n = 1; n < 50; n++) {
        const app_angle_reading_t r = at(100 + (n * (1 + n)));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, 0.25 * count, (double)r.band_rad);
        TEST_ASSERT_TRUE((r.edge_gap_s <= 0.0f) && (r.edge_age_s <= 0.0f));
        assert_angle((100.5 + (n * (1 + n))) * count, r.theta_e_rad);
    }
}

/* Slower than one count per period the speed comes from edge to edge, and without edges it goes to nothing. */
static void test_speed_without_edges_is_bounded_by_their_absence(void)
{
    start_edges(100.3);
    for (int n = 0; n < 3000; n++) {
        const app_angle_reading_t r = turn(1.0);
        if (n > 50) {
            TEST_ASSERT_DOUBLE_WITHIN(2.0e-3, 1.0, (double)r.omega_e_radps);
        }
    }
    float before = 2.0f;
    for (int n = 0; n < 5000; n++) {
        const app_angle_reading_t r = turn(0.0);
        TEST_ASSERT_TRUE(r.omega_e_radps <= before);
        TEST_ASSERT_TRUE(r.band_rad > 0.0f);
        before = r.omega_e_radps;
    }
    TEST_ASSERT_TRUE(before <= 1.3e-3f); /* a count in a second */
}

/* The edge on the way back is the one on the way forth: no count in between. */
static void test_a_shaft_that_turns_back_and_forth_has_no_speed_that_grows(void)
{
    start_edges(100.9);
    for (int n = 0; n < 400; n++) {
        const app_angle_reading_t r = turn(((n / 2) % 2 == 0) ? 0.8 : -0.8);
        TEST_ASSERT_TRUE(base_within(r.omega_e_radps, 6.3f));
    }
}

/* A shaft that speeds up by a count per period each period may; 17 counts at once may not. */
static void test_a_jump_drops_the_reference(void)
{
    (void)at_with_index(100, 100);
    int position = 100;
    for (int step = 0; step < 100; step++) {
        position += step;
        (void)at(position % 10000);
    }
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
    (void)at((position + 99 + 16) % 10000);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
    (void)at((position + 2 * (99 + 16) + 17) % 10000);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
    TEST_ASSERT_EQUAL_UINT16(1U, angle.jumps);
    for (int way = -1; way <= 1; way += 2) { /* either way, and as a single wrong reading */
        setUp();
        (void)at_with_index(5000, 5000);
        (void)at(5000);
        (void)at(5000 + (17 * way));
        (void)at(5000);
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
        TEST_ASSERT_EQUAL_UINT16(3U - 1U, angle.jumps);
    }
}

/* The angle itself goes on as it was: a drive that runs keeps it, until the next index. */
static void test_a_jump_leaves_the_angle_that_there_was(void)
{
    (void)at_with_index(0, 0);
    (void)at(0);
    (void)at(100);
    assert_angle(2.0 * two_pi * 100.5 / 10000.0, at(100).theta_e_rad);
    (void)at_with_index(100, 100);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
}

static int turned_to_cnt;

/* Turns on by so many counts a period without an index; whether one of them faults. */
static bool faults_within(int periods, int step)
{
    bool fault = false;
    for (int n = 0; n < periods; n++) {
        turned_to_cnt = (turned_to_cnt + step + 10000) % 10000;
        fault         = at(turned_to_cnt).index_fault || fault;
    }
    return fault;
}

static void test_an_index_has_to_come_in_every_turn(void)
{
    for (int way = -10; way <= 10; way += 20) {
        setUp();
        turned_to_cnt = 0;
        TEST_ASSERT_FALSE(faults_within(3000, way)); /* none yet: nothing is known of any */
        (void)at_with_index(turned_to_cnt, turned_to_cnt);
        TEST_ASSERT_FALSE(faults_within(1010, way)); /* a turn, and what it may correct */
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
        TEST_ASSERT_TRUE(faults_within(1, way));
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
        TEST_ASSERT_FALSE(faults_within(1009, way)); /* once per turn */
    }
    setUp(); /* to and fro is no turn */
    turned_to_cnt = 0;
    (void)at_with_index(0, 0);
    for (int n = 0; n < 10; n++) {
        TEST_ASSERT_FALSE(faults_within(500, 10));
        TEST_ASSERT_FALSE(faults_within(500, -10));
    }
}

static ctl_status_t init(void)
{
    return app_angle_init(&angle, &config, &drive);
}

static void test_constants_out_of_range_are_refused(void)
{
    drive.hardware.pole_pairs = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    drive.hardware.pole_pairs = 65U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.index_theta_e_rad = BASE_TWO_PI;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.index_theta_e_rad = -0.001f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.index_theta_e_rad = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.index_correct_max_cnt = (uint16_t)(config.index_tolerance_cnt - 1U);
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    config.index_correct_max_cnt = config.index_tolerance_cnt;
    TEST_ASSERT_EQUAL_INT(CTL_OK, init());
    config.index_correct_max_cnt = 2500U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    config.jump_cnt = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    setUp();
    drive.ts_s = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
    drive.ts_s = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, init());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angle_means_nothing_before_the_first_index);
    RUN_TEST(test_index_refers_the_angle_at_every_position);
    RUN_TEST(test_counts_are_within_a_limit_up_to_both_ends);
    RUN_TEST(test_turned_counts_take_the_shorter_way);
    RUN_TEST(test_speed_is_the_difference_of_positions_either_way_round);
    RUN_TEST(test_first_sample_has_no_speed);
    RUN_TEST(test_dropped_reference_takes_angle_and_speed_away);
    RUN_TEST(test_alignment_forgets_the_angle_of_the_index);
    RUN_TEST(test_before_any_reference_the_position_itself_is_shown);
    RUN_TEST(test_alignment_puts_the_zero_here_until_the_index);
    RUN_TEST(test_index_after_alignment_takes_over_within_its_bound);
    RUN_TEST(test_index_after_alignment_knows_its_own_angle);
    RUN_TEST(test_alignment_refers_to_the_angle_it_is_given);
    RUN_TEST(test_encoders_that_the_counter_cannot_hold_are_refused);
    RUN_TEST(test_later_index_corrects_or_faults_by_its_distance);
    RUN_TEST(test_correction_does_not_show_in_the_speed);
    RUN_TEST(test_corrections_are_counted_until_the_start);
    RUN_TEST(test_correction_begins_where_the_one_before_is);
    RUN_TEST(test_alignment_and_a_first_index_end_a_correction);
    RUN_TEST(test_index_fault_lasts_one_sample);
    RUN_TEST(test_edge_times_give_angle_and_speed);
    RUN_TEST(test_counts_that_come_in_plenty_have_a_band_of_a_quarter);
    RUN_TEST(test_an_edge_without_a_time_is_none_of_a_line);
    RUN_TEST(test_an_angle_below_zero_wraps);
    RUN_TEST(test_counts_that_come_one_at_a_time_tell_more_than_their_middle);
    RUN_TEST(test_speed_without_edges_is_bounded_by_their_absence);
    RUN_TEST(test_a_shaft_that_turns_back_and_forth_has_no_speed_that_grows);
    RUN_TEST(test_a_jump_drops_the_reference);
    RUN_TEST(test_a_jump_leaves_the_angle_that_there_was);
    RUN_TEST(test_an_index_has_to_come_in_every_turn);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
