/* SPDX-License-Identifier: MIT */
#include "app_disc.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "board_config.h"
#include "unit_support.h"
#include "unity.h"

#include "app_angle.h"

#define POSITIONS 2000
#define WORDS     (2 + (POSITIONS / 2))
#define TS_s      200.0e-6
#define TOL_CNT   2.0e-3 /* 1/512 of the map's steps, and the float angle */

static const double two_pi = 6.283185307179586;

static double     edge_off_cnt[POSITIONS]; /* where the disc's edges are, whole steps of the map */
static uint16_t   map[WORDS];
static app_disc_t disc;

static app_angle_config_t config;
static drive_config_t     drive;
static app_angle_t        angle;

/* Place of an edge in the turn that begins at position 0. */
static int in_turn(long edge)
{
    const long rest = edge % POSITIONS;
    return (int)((rest < 0) ? (rest + POSITIONS) : rest);
}

static void put_octet(int n, int octet)
{
    const unsigned low = (unsigned)octet & 0xFFu;
    const unsigned was = map[2 + (n / 2)];
    map[2 + (n / 2)] =
        (uint16_t)(((n % 2) != 0) ? ((was & 0xFFu) | (low << 8)) : ((was & 0xFF00u) | low));
}

/* An own error of each edge, up to most / 256 counts either way. */
static void make_disc(uint32_t seed, float most)
{
    support_random_t random = {seed};

    map[0] = APP_DISC_FORMAT;
    map[1] = POSITIONS;
    for (int n = 0; n < POSITIONS; n++) {
        const int octet = (int)lroundf(support_uniform(&random, -most, most));
        edge_off_cnt[n] = octet / 256.0;
        put_octet(n, octet);
    }
}

void setUp(void)
{
    (void)memset(&disc, 0xFF, sizeof disc);
    (void)memset(&angle, 0xFF, sizeof angle);
    make_disc(1U, 44.0f);
    app_disc_init(&disc, POSITIONS);
    config                           = board_config.angle;
    config.index_tolerance_cnt       = 4U;
    config.index_correct_max_cnt     = 100U;
    config.jump_cnt                  = 100U;
    drive.ts_s                       = (float)TS_s;
    drive.hardware.pole_pairs        = 2U;
    drive.hardware.encoder_positions = POSITIONS;
    drive.hardware.edge_times        = true;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_angle_init(&angle, &config, &drive));
}

void tearDown(void) {}

static void test_only_a_map_of_this_number_of_positions_is_one(void)
{
    TEST_ASSERT_TRUE(app_disc_check(map, WORDS, POSITIONS));
    for (uint32_t count = 0U; count < 2U * WORDS; count++) {
        TEST_ASSERT_EQUAL_INT(count == WORDS, app_disc_check(map, count, POSITIONS));
    }
    for (uint32_t positions = POSITIONS - 9U; positions < POSITIONS + 9U; positions++) {
        TEST_ASSERT_EQUAL_INT(positions == POSITIONS, app_disc_check(map, WORDS, positions));
    }
    for (unsigned bit = 0U; bit < 16U; bit++) {
        for (int word = 0; word < 2; word++) {
            map[word] = (uint16_t)(map[word] ^ (1u << bit));
            TEST_ASSERT_FALSE(app_disc_check(map, WORDS, POSITIONS));
            map[word] = (uint16_t)(map[word] ^ (1u << bit));
        }
    }
    const uint16_t odd[3] = {APP_DISC_FORMAT, 1U, 0U};
    TEST_ASSERT_TRUE(app_disc_check(odd, 3U, 1U));
}

/* Every octet at every parity and for several places of the index. */
static void test_each_edge_has_its_octet(void)
{
    static const int zeros[] = {0, 1, 2, 999, POSITIONS - 1};
    for (int z = 0; z < SUPPORT_COUNT(zeros); z++) {
        for (int n = 0; n < POSITIONS; n++) {
            put_octet(n, (n * 7) % 256);
        }
        app_disc_init(&disc, POSITIONS);
        app_disc_take(&disc, map);
        app_disc_index(&disc, (uint16_t)zeros[z]);
        TEST_ASSERT_EQUAL_INT(APP_DISC_COMPARES, disc.state);
        disc.state = APP_DISC_IN_FORCE;
        (void)app_disc_turned_cnt(&disc, (uint16_t)zeros[z], 1.0f, 0.0f);
        double before = 0.0;
        for (int n = 1; n < POSITIONS; n++) {
            const int    octet  = (n * 7) % 256;
            const double off    = ((octet < 128) ? octet : (octet - 256)) / 256.0;
            const int    edge   = (zeros[z] + n) % POSITIONS;
            const float  turned = app_disc_turned_cnt(&disc, (uint16_t)edge, 1.0f, 1.0e-4f);
            TEST_ASSERT_TRUE((double)app_disc_off_cnt(&disc) == off);
            TEST_ASSERT_TRUE((double)turned == 1.0 + off - before);
            before = off;
        }
    }
}

static void test_a_damaged_zero_reads_nothing_beyond_the_map(void)
{
    app_disc_take(&disc, map);
    app_disc_index(&disc, 0U);
    disc.state    = APP_DISC_IN_FORCE;
    disc.zero_cnt = 50000U;
    for (unsigned edge = 0U; edge < POSITIONS; edge++) {
        (void)app_disc_turned_cnt(&disc, (uint16_t)edge, 1.0f, 1.0e-4f); /* ASan looks on */
        TEST_ASSERT_TRUE((app_disc_off_cnt(&disc) == 0.0f) ||
                         (app_disc_place(&disc, (uint16_t)edge) < POSITIONS));
    }
    app_disc_lose(&disc);
    app_disc_index(&disc, POSITIONS); /* no such position */
    TEST_ASSERT_EQUAL_INT(APP_DISC_NO_INDEX, disc.state);
    TEST_ASSERT_FALSE(disc.have_zero);
}

/* Edges at a speed, each so many counts after the one before, of a shaft whose speed varies. */
static app_disc_state_t run_edges(long first, int step, int edges, double varies, uint32_t seed)
{
    support_random_t random   = {seed};
    double           before_s = 0.0;
    double           at_s     = 0.0;
    double           place    = (double)first + edge_off_cnt[in_turn(first)];
    long             edge     = first;

    for (int n = 0; n < edges; n++) {
        const int    turned = step + ((n % 3 == 0) ? 1 : 0);
        const double speed =
            230.0e3 * (1.0 + (varies * (double)support_uniform(&random, -1.0f, 1.0f)));
        edge += turned;
        const double now = (double)edge + edge_off_cnt[in_turn(edge)];
        at_s += (now - place) / speed;
        (void)app_disc_turned_cnt(&disc, (uint16_t)in_turn(edge), (float)turned,
                                  (float)(at_s - before_s));
        place    = now;
        before_s = at_s;
    }
    return disc.state;
}

static void test_the_map_of_this_disc_comes_into_force(void)
{
    app_disc_take(&disc, map);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NO_INDEX, run_edges(0, 47, 2000, 0.0, 3U));
    app_disc_index(&disc, 0U);
    TEST_ASSERT_EQUAL_INT(APP_DISC_COMPARES, run_edges(0, 47, (int)APP_DISC_COMPARED - 1, 0.0, 3U));
    TEST_ASSERT_TRUE(app_disc_off_cnt(&disc) == 0.0f);
    TEST_ASSERT_EQUAL_INT(APP_DISC_IN_FORCE, run_edges(0, 47, 4, 0.0, 3U));
    TEST_ASSERT_EQUAL_INT(APP_DISC_IN_FORCE, run_edges(0, 47, 4000, 0.0, 3U));
    app_disc_index(&disc, 0U); /* the same place, in every turn */
    TEST_ASSERT_EQUAL_INT(APP_DISC_IN_FORCE, disc.state);
    app_disc_index(&disc, 1U); /* counts were lost */
    TEST_ASSERT_EQUAL_INT(APP_DISC_COMPARES, disc.state);
    app_disc_lose(&disc);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NO_INDEX, disc.state);
}

/* A map that was learned is off by hundredths of a count. */
static void test_a_map_with_errors_of_its_own_comes_into_force(void)
{
    support_random_t random = {7U};
    for (int n = 0; n < POSITIONS; n++) {
        put_octet(n, (int)lround((256.0 * edge_off_cnt[n]) +
                                 (double)support_uniform(&random, -10.0f, 10.0f)));
    }
    app_disc_take(&disc, map);
    app_disc_index(&disc, 0U);
    TEST_ASSERT_EQUAL_INT(APP_DISC_IN_FORCE, run_edges(0, 47, 600, 1.0e-4, 3U));
}

/* EQ-DISC-4 in double, with an index in mid-run and an edge of unknown time. */
static void test_sums_are_those_of_edges_that_follow_one_another(void)
{
    double plain    = 0.0;
    double mapped   = 0.0;
    double plain_w  = 0.0;
    double mapped_w = 0.0;
    int    before   = 0;

    app_disc_take(&disc, map);
    app_disc_index(&disc, 5U);
    (void)run_edges(0, 47, 100, 1.0e-3, 3U);
    app_disc_index(&disc, 0U);
    for (int n = 0; n < 200; n++) {
        const int    turned    = 31 + (n % 17);
        const int    edge      = (before + turned) % POSITIONS;
        const bool   known     = (n != 0) && (n != 100);
        const double real      = turned + edge_off_cnt[edge] - edge_off_cnt[before];
        const double between_s = known ? (real / (230.0e3 + (500.0 * (n % 5)))) : 0.0;
        (void)app_disc_turned_cnt(&disc, (uint16_t)edge, (float)turned,
                                  (n == 0) ? 1.0e-4f : (float)between_s);
        if (known && (n != 1) && (n != 101)) {
            plain += fabs(turned - (plain_w * between_s));
            mapped += fabs(real - (mapped_w * between_s));
        }
        plain_w  = known ? (turned / between_s) : 0.0;
        mapped_w = known ? (real / between_s) : 0.0;
        before   = edge;
    }
    TEST_ASSERT_EQUAL_UINT(196U, disc.compared);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-3 * plain, plain, (double)disc.plain_cnt);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-2 * mapped, mapped, (double)disc.mapped_cnt);
    TEST_ASSERT_TRUE(mapped < 0.7 * plain);
}

static void test_no_map_and_no_index_change_nothing(void)
{
    app_disc_index(&disc, 0U);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NONE, run_edges(0, 47, 2000, 0.0, 3U));
    TEST_ASSERT_TRUE(disc.have_zero);
    app_disc_take(&disc, NULL);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NONE, disc.state);
}

/* Over many discs: that of another one, and the right one from a wrong index. */
static void test_the_map_of_another_disc_does_not(void)
{
    for (uint32_t seed = 2U; seed < 40U; seed++) {
        uint16_t own[WORDS];
        make_disc(seed, 44.0f);
        (void)memcpy(own, map, sizeof own);
        app_disc_init(&disc, POSITIONS);
        app_disc_take(&disc, own);
        app_disc_index(&disc, 0U);
        TEST_ASSERT_EQUAL_INT(APP_DISC_IN_FORCE, run_edges(0, 47, 600, 1.0e-4, seed));

        app_disc_index(&disc, (uint16_t)(1U + (seed % 7U)));
        TEST_ASSERT_EQUAL_INT(APP_DISC_OTHER, run_edges(0, 47, 600, 1.0e-4, seed));
        TEST_ASSERT_TRUE(app_disc_off_cnt(&disc) == 0.0f);

        make_disc(seed + 1000U, 44.0f); /* the disc; own stays the map */
        app_disc_lose(&disc);
        app_disc_index(&disc, 0U);
        TEST_ASSERT_EQUAL_INT(APP_DISC_OTHER, run_edges(0, 47, 600, 1.0e-4, seed));
        TEST_ASSERT_EQUAL_INT(APP_DISC_OTHER, run_edges(0, 47, 6000, 1.0e-4, seed));
    }
}

/* A shaft that jerks by counts hides errors of a tenth. */
static void test_a_rough_shaft_decides_nothing(void)
{
    app_disc_take(&disc, map);
    app_disc_index(&disc, 0U);
    TEST_ASSERT_EQUAL_INT(APP_DISC_COMPARES, run_edges(0, 47, 20000, 0.05, 5U));
    TEST_ASSERT_EQUAL_INT(APP_DISC_IN_FORCE, run_edges(0, 47, 2000, 0.0, 5U));
}

static void test_rare_edges_are_not_compared(void)
{
    app_disc_take(&disc, map);
    app_disc_index(&disc, 0U);
    TEST_ASSERT_EQUAL_INT(APP_DISC_COMPARES, run_edges(0, 230, 4000, 0.0, 5U)); /* 1 ms apart */
}

/* A sample of a shaft at so many counts, EQ-ENCODER-7 for an index at `zero`. */
static board_sample_t sample_at(double shaft_cnt, double cntps, int zero, long *before)
{
    long count = (long)floor(shaft_cnt);
    if (shaft_cnt < (double)count + edge_off_cnt[in_turn(count)]) {
        count--;
    } else if (shaft_cnt >= (double)(count + 1) + edge_off_cnt[in_turn(count + 1)]) {
        count++;
    }
    const long     edge  = (cntps > 0.0) ? count : (count + 1);
    const double   age_s = (shaft_cnt - ((double)edge + edge_off_cnt[in_turn(edge)])) / cntps;
    const int      turn  = (int)floor((double)count / POSITIONS);
    const int      last  = (int)floor((double)*before / POSITIONS);
    board_sample_t raw   = {.position_cnt = (uint16_t)in_turn(count + zero), .valid = true};
    raw.edge_age_cnt     = (uint16_t)lround(age_s * (double)BOARD_CAPTURE_Hz);
    raw.edge_seen        = count != *before;
    raw.index_seen       = turn != last;
    raw.index_cnt        = (uint16_t)zero;
    *before              = count;
    return raw;
}

/* Largest error of the angle over a turn, and of the speed as a share, from a place on. */
typedef struct {
    double angle_cnt;
    double speed;
} worst_t;

static worst_t turn_shaft(double *shaft_cnt, double cntps, int zero, int samples)
{
    worst_t worst  = {0.0, 0.0};
    long    before = (long)floor(*shaft_cnt - (cntps * TS_s));

    for (int k = 0; k < samples; k++) {
        const board_sample_t raw = sample_at(*shaft_cnt, cntps, zero, &before);
        app_angle_reading_t  r;
        app_angle_update(&angle, &raw, &r);
        if (k > samples / 2) {
            const double true_rad =
                (double)config.index_theta_e_rad + (2.0 * two_pi * *shaft_cnt / POSITIONS);
            const double error =
                remainder((double)r.theta_e_rad - true_rad, two_pi) * POSITIONS / (2.0 * two_pi);
            const double true_w = 2.0 * two_pi * cntps / POSITIONS;
            worst.angle_cnt     = fmax(worst.angle_cnt, fabs(error));
            worst.speed         = fmax(worst.speed, fabs(((double)r.omega_e_radps / true_w) - 1.0));
            const float number  = app_angle_edge(&angle, &r);
            const long  edge    = (cntps > 0.0) ? before : (before + 1);
            TEST_ASSERT_EQUAL_INT(in_turn(edge), (int)number);
        }
        *shaft_cnt += cntps * TS_s;
    }
    return worst;
}

/* With the map the angle is that of the shaft, in both directions; without it, it is the disc's. */
static void test_angle_and_speed_are_those_of_the_shaft(void)
{
    static const int zeros[] = {0, 777, POSITIONS - 1};
    for (int z = 0; z < SUPPORT_COUNT(zeros); z++) {
        for (int with = 0; with <= 1; with++) {
            setUp();
            if (with != 0) {
                app_disc_take(&angle.disc, map);
            }
            double  shaft_cnt = -300.3;
            worst_t worst     = turn_shaft(&shaft_cnt, 61234.5, zeros[z], 3000);
            TEST_ASSERT_EQUAL_INT((with != 0) ? APP_DISC_IN_FORCE : APP_DISC_NONE,
                                  angle.disc.state);
            for (int direction = 1; direction >= -1; direction -= 2) {
                if (with != 0) {
                    TEST_ASSERT_DOUBLE_WITHIN(TOL_CNT, 0.0, worst.angle_cnt);
                    TEST_ASSERT_DOUBLE_WITHIN(3.0e-4, 0.0,
                                              worst.speed); /* 13 ns of the capture in 0.2 ms */
                } else {
                    TEST_ASSERT_TRUE(worst.angle_cnt > 0.15);
                    TEST_ASSERT_TRUE(worst.speed > 0.02);
                }
                worst = turn_shaft(&shaft_cnt, -71234.5, zeros[z], 3000);
            }
        }
    }
}

/* Turning backward its edge is another one on a real mark: such an index does not place the map. */
static void test_an_index_turning_backward_places_no_map(void)
{
    app_disc_take(&angle.disc, map);
    long   before    = 10000;
    double shaft_cnt = 9999.5;
    for (int k = 0; k < 4000; k++) {
        const board_sample_t raw = sample_at(shaft_cnt, -61234.5, 5, &before);
        app_angle_reading_t  r;
        app_angle_update(&angle, &raw, &r);
        TEST_ASSERT_TRUE(app_angle_edge(&angle, &r) == -1.0f);
        shaft_cnt -= 61234.5 * TS_s;
    }
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NO_INDEX, angle.disc.state);
}

static void test_a_shaft_that_turns_back_compares_nothing_and_places_nothing(void)
{
    double              shaft_cnt = 0.3;
    app_angle_reading_t r;
    app_disc_take(&angle.disc, map);
    (void)turn_shaft(&shaft_cnt, 61234.5, 0, 500); /* the second turn, and it compares */
    TEST_ASSERT_EQUAL_INT(APP_DISC_COMPARES, angle.disc.state);
    const board_sample_t back = {.position_cnt = (uint16_t)((angle.before_cnt + 9U) % POSITIONS),
                                 .valid        = true};
    app_angle_update(&angle, &back, &r);
    TEST_ASSERT_TRUE(app_angle_edge(&angle, &r) == -1.0f);
    shaft_cnt += 9.0;
    const double before = (double)angle.disc.plain_cnt;
    (void)turn_shaft(&shaft_cnt, 61234.5, 0, 10);
    TEST_ASSERT_TRUE((double)angle.disc.plain_cnt - before < 4.0); /* 10 edges, each 0.25 */

    setUp();
    app_disc_take(&angle.disc, map);
    board_sample_t raw = {.position_cnt = 1990U, .valid = true};
    app_angle_update(&angle, &raw, &r);
    raw.position_cnt = 3U;
    raw.index_seen   = true;
    app_angle_update(&angle, &raw, &r); /* in both directions: edge_seen is false */
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, angle.reference);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NO_INDEX, angle.disc.state);
}

static void test_lost_counts_take_the_map_out_of_force(void)
{
    double shaft_cnt = 0.3;
    app_disc_take(&angle.disc, map);
    (void)turn_shaft(&shaft_cnt, 61234.5, 0, 3000);
    TEST_ASSERT_EQUAL_INT(APP_DISC_IN_FORCE, angle.disc.state);
    app_angle_t kept = angle;

    app_angle_drop(&angle);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NO_INDEX, angle.disc.state);

    angle                       = kept;
    const uint16_t      far_off = (uint16_t)in_turn((long)shaft_cnt + 900);
    board_sample_t      raw     = {.position_cnt = far_off, .valid = true};
    app_angle_reading_t r;
    app_angle_update(&angle, &raw, &r); /* a jump */
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, angle.reference);
    TEST_ASSERT_EQUAL_INT(APP_DISC_NO_INDEX, angle.disc.state);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_only_a_map_of_this_number_of_positions_is_one);
    RUN_TEST(test_each_edge_has_its_octet);
    RUN_TEST(test_a_damaged_zero_reads_nothing_beyond_the_map);
    RUN_TEST(test_the_map_of_this_disc_comes_into_force);
    RUN_TEST(test_a_map_with_errors_of_its_own_comes_into_force);
    RUN_TEST(test_sums_are_those_of_edges_that_follow_one_another);
    RUN_TEST(test_no_map_and_no_index_change_nothing);
    RUN_TEST(test_the_map_of_another_disc_does_not);
    RUN_TEST(test_a_rough_shaft_decides_nothing);
    RUN_TEST(test_rare_edges_are_not_compared);
    RUN_TEST(test_angle_and_speed_are_those_of_the_shaft);
    RUN_TEST(test_an_index_turning_backward_places_no_map);
    RUN_TEST(test_a_shaft_that_turns_back_compares_nothing_and_places_nothing);
    RUN_TEST(test_lost_counts_take_the_map_out_of_force);
    return UNITY_END();
}
